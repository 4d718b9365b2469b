"""The feature edges of a model, drawn thin over its faces.

In: a staged scene and, each frame, where it is seen from. Out: lines beside the scene, translucent,
so that outputs other than the colour show the faces below them.

The lines are drawn a little nearer along the lines of sight, which looks the same, so that their
own faces do not hide them, while faces in front of them do.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TypeAlias

import numpy as np

from ..._native.scene_graph import SHOWN
from ...base import linalg
from ...base.dirty_tracking import Watch
from ...model.geometry.derived import derived
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material, states_nothing
from ...model.motion.posed_mesh import PosedMesh
from ...model.scene.instances import InstancedMesh, instance_matrices
from ...model.scene.node_arrays import NodeArrays
from ...model.scene.nodes import Node
from ...model.scene.shown import as_shown, placing_poses
from ...model.scene.staged_scene import StagedScene
from ...rendering.draw_list.closed_meshes import holes_of
from ..views.viewpoint import Sphere

#: Of a node that shows: slot, object, anchor, and the version of its pose.
State: TypeAlias = tuple[int, int, int, int]
#: Dark, and translucent: r, g, b, alpha, 0 to 255.
COLOR = (24, 26, 30, 150)
#: How much nearer the lines are drawn, as a fraction of their distance from the eye.
NEARER = 1 / 1500
#: The distance of the eye in radii of the model, where lines of sight are parallel.
_AWAY = 3.5
#: More edges would cover a model with lines, and take time.
MOST_EDGES, MOST_PARTS = 60_000, 5_000


class FeatureLines:
    """The feature edges of what a scene shows; found anew when it changes or moves.

    Parameters
    ----------
    staged : StagedScene
        The lines are added beside it.
    of_all : bool
        Whether to draw those of all meshes, instead of those of faceted meshes that state no
        material.
    of_model : bool
        Whether the visible edges of meshes are those of a model of CAD, and all are drawn.
    """

    def __init__(self, staged: StagedScene, of_all: bool, of_model: bool = False) -> None:
        self._staged = staged
        self._of_all, self._of_model = of_all, of_model
        self._node: Node | None = None
        # The edges of objects by number, None if none are drawn, and what they were found in.
        self._edges: dict[int, _Edges | None] = {}
        self._edges_of_what: Any = None
        self._watch = Watch()
        # The ends of edges that each node draws, and when they were found.
        self._placed: dict[State, np.ndarray] = {}
        self._found_in: Any = None

    def show(self, shown: bool) -> None:
        """Show or hide the lines, if there are any."""
        if self._node is not None and self._node.visible != shown:
            self._node.visible = shown

    def follow(self, eye: np.ndarray, bounds: Sphere, only_closed: bool) -> None:
        """Show the lines as seen from an eye: the viewer's position and 1, or the direction and 0.

        Parameters
        ----------
        eye : (4,) ndarray of float64
        bounds : Sphere
            The scene's.
        only_closed : bool
            Whether to draw only those of closed meshes, because backs of faces are left out: there
            may be no face where an open mesh has a line.
        """
        self._find(only_closed)
        if self._node is None:
            return
        pose, away = np.eye(4), NEARER if eye[3] else NEARER * _AWAY * bounds.radius
        pose[:3, 3] = eye[:3] * away
        if eye[3]:
            pose[:3, :3] *= 1.0 - NEARER
        if not np.array_equal(self._node.pose, pose):
            self._node.pose = pose
        self.show(True)

    def _find(self, only_closed: bool) -> None:
        """Make the lines anew, perhaps of closed meshes only, unless nothing has changed."""
        data = self._staged.data
        data.own.update()
        posing = None if data.posing is None else data.posing.moment
        of = data.own.arrays, data.own.objects.version, posing, only_closed
        if of != self._edges_of_what or self._watch.found():
            self._edges_of_what, self._watch = of, Watch(_things(data.own.objects.objects))
            self._edges, self._placed = {}, {}
            self._found_in = None
        state = data.own.arrays.updated, data.hidden
        if state == self._found_in:
            return
        self._found_in = state
        if self._node is not None:
            self._staged.beside.remove(self._node)
            self._node = None
        ends = self._ends(only_closed)
        if ends:
            material = Material(color=COLOR, alpha_mode="blend", unlit=True)
            made = np.concatenate(ends)
            lines = np.arange(len(made), dtype=np.int32).reshape(-1, 2)
            mesh = Mesh(made, lines=lines, materials=[material])
            self._node = self._staged.beside.add(mesh, name="edges", cast_shadows=False)
            self._node.receive_shadows = False

    def _ends(self, only_closed: bool) -> list[np.ndarray]:
        """Return the ends of edges, arrays of (2 E, 3) in world space; none if there are too many.

        Those of a node are kept until it moves.
        """
        arrays = self._staged.data.own.arrays
        drawn, count, parts = [], 0, 0
        for state in self._shown():
            edges = self._edges_at(state[1], only_closed)
            if edges is None:
                continue
            drawn.append((state, edges))
            count, parts = count + edges.count, parts + edges.parts
            if count > MOST_EDGES or parts > MOST_PARTS:
                return []
        before, self._placed = self._placed, {}
        for state, edges in drawn:
            ends = before.get(state)
            self._placed[state] = edges.placed(arrays, state[0]) if ends is None else ends
        return [ends for ends in self._placed.values() if len(ends)]

    def _shown(self) -> Iterator[State]:
        """Return the states of the nodes that show, object by object."""
        own = self._staged.data.own
        columns = {name: column[: own.arrays.count] for name, column in own.arrays.columns.items()}
        shows = (columns["flags"] & SHOWN != 0) & (columns["object"] >= 0)
        hidden = own.slots_of(self._staged.data.hidden)
        shows[hidden[hidden >= 0]] = False
        slots = np.flatnonzero(shows)
        slots = slots[np.argsort(columns["object"][slots], kind="stable")]
        anchors = columns["anchor"][slots]
        placing = np.where(anchors < 0, slots, anchors)
        rows = slots, columns["object"][slots], anchors, columns["world_version"][placing]
        return zip(*(row.tolist() for row in rows), strict=True)

    def _edges_at(self, number: int, only_closed: bool) -> _Edges | None:
        """Return the edges of an object that are drawn; None if none are."""
        if number not in self._edges:
            obj = self._staged.data.own.objects.objects[number]
            edges = None if obj is None else self._edges_of(obj)
            found = None if edges is None else _Edges(as_shown(obj), edges)
            if found is None or not found.count or (only_closed and not _is_closed(obj)):
                found = None
            self._edges[number] = found
        return self._edges[number]

    def _edges_of(self, obj: Any) -> np.ndarray | None:
        """Return the edges of an object's mesh that are drawn, (E, 2); None if none are."""
        mesh: Mesh = getattr(obj, "mesh", obj)
        if self._of_model:
            return mesh.edges()
        if self._of_all:
            return derived(mesh, "feature_edges")
        is_tinted = mesh.colors is not None or getattr(obj, "colors", None) is not None
        if is_tinted or not all(map(states_nothing, mesh.materials)):
            return None
        return derived(mesh, "faceted_edges")


class _Edges:
    """The edges of an object that are drawn.

    Attributes
    ----------
    parts : int
        At how many places a node draws them.
    count : int
        How many edges these are together.
    """

    def __init__(self, shape: Any, edges: np.ndarray) -> None:
        self._shape, self._edges = shape, edges
        self.parts = len(shape) if isinstance(shape, InstancedMesh) else 1
        self.count = self.parts * len(edges)

    def placed(self, arrays: NodeArrays, slot: int) -> np.ndarray:
        """Return the ends (2 E, 3) of what a node draws, of edges both of whose ends are finite."""
        mesh: Mesh = getattr(self._shape, "mesh", self._shape)
        poses = placing_poses(arrays, np.array([slot], np.int32))
        if isinstance(self._shape, InstancedMesh):
            poses = linalg.multiply(poses[0], instance_matrices(self._shape.poses))
        ends = mesh.positions[self._edges.reshape(-1)]
        with np.errstate(over="ignore", invalid="ignore"):
            placed = [linalg.transform_points(pose, ends) for pose in poses]
        return _finite(np.concatenate(placed))


def _is_closed(obj: Any) -> bool:
    """Return whether fronts hide all backs of an object's mesh."""
    holes = None if isinstance(obj, PosedMesh) else holes_of(getattr(obj, "mesh", obj))
    return holes is not None and not len(holes.ends)


def _finite(ends: np.ndarray) -> np.ndarray:
    """Return the ends, (2 E, 3), of lines both of whose ends are finite."""
    with np.errstate(over="ignore"):
        ends = ends.astype(np.float32)
    if np.isfinite(ends).all():
        return ends
    kept = np.isfinite(ends.reshape(-1, 6)).all(axis=1)
    return ends.reshape(-1, 2, 3)[kept].reshape(-1, 3)


def _things(objects: Iterable[Any]) -> dict[Any, None]:
    """Return the meshes, instances and materials of a scene's objects."""
    things: dict[Any, None] = {}
    for obj in objects:
        if isinstance(obj, InstancedMesh):
            things[obj] = None
        mesh = getattr(obj, "mesh", obj)
        if mesh is not None:
            things[mesh] = None
            things.update(dict.fromkeys(mesh.materials))
    return things

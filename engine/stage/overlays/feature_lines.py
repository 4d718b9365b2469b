"""The feature edges of a model, drawn thin over its faces.

In: a staged scene and, each frame, where it is seen from. Out: lines beside the scene, translucent,
so that outputs other than the colour show the faces below them.

The lines are drawn a little nearer along the lines of sight, which looks the same, so that their
own faces do not hide them, while faces in front of them do.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

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
    """

    def __init__(self, staged: StagedScene, of_all: bool) -> None:
        self._staged = staged
        self._of_all = of_all
        self._node: Node | None = None
        # The edges of objects by number, and what they were found in.
        self._edges: dict[int, _Edges] = {}
        self._edges_of_what: Any = None
        self._watch = Watch()
        # The ends of edges by slot, object, anchor and version of the pose; when they were found.
        self._placed: dict[tuple[int, int, int, int], np.ndarray] = {}
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
            objects = data.own.objects.objects
            self._edges_of_what, self._watch = of, Watch(_things(objects))
            self._edges = self._edges_of_all(objects, only_closed)
            self._placed.clear()
            self._found_in = None
        state = data.own.arrays.updated, data.hidden
        if state == self._found_in:
            return
        self._found_in = state
        if self._node is not None:
            self._staged.beside.remove(self._node)
            self._node = None
        ends = self._ends()
        if ends:
            material = Material(color=COLOR, alpha_mode="blend", unlit=True)
            made = np.concatenate(ends)
            lines = np.arange(len(made), dtype=np.int32).reshape(-1, 2)
            mesh = Mesh(made, lines=lines, materials=[material])
            self._node = self._staged.beside.add(mesh, name="edges", cast_shadows=False)
            self._node.receive_shadows = False

    def _ends(self) -> list[np.ndarray]:
        """Return the ends of edges, arrays of (2 E, 3) in world space; none if there are too many.

        Those of a node are kept until it moves.
        """
        data = self._staged.data
        arrays = data.own.arrays
        columns = {name: column[: arrays.count] for name, column in arrays.columns.items()}
        shows = columns["flags"] & SHOWN != 0
        hidden = data.own.slots_of(data.hidden)
        shows[hidden[hidden >= 0]] = False
        edged = np.zeros(len(data.own.objects.objects) + 1, bool)  # the last one: of no object
        edged[list(self._edges)] = True
        slots = np.flatnonzero(shows & edged[columns["object"]])
        slots = slots[np.argsort(columns["object"][slots], kind="stable")].astype(np.int32)
        numbers = columns["object"][slots].tolist()
        if sum(self._edges[number].count for number in numbers) > MOST_EDGES:
            return []
        if sum(self._edges[number].parts for number in numbers) > MOST_PARTS:
            return []
        anchors = columns["anchor"][slots]
        placed = zip(
            slots.tolist(),
            numbers,
            anchors.tolist(),
            columns["world_version"][np.where(anchors < 0, slots, anchors)].tolist(),
            strict=True,
        )
        before, self._placed = self._placed, {}
        for state in placed:
            ends = before.get(state)
            if ends is None:
                ends = self._edges[state[1]].placed(arrays, state[0])
            self._placed[state] = ends
        return [ends for ends in self._placed.values() if len(ends)]

    def _edges_of_all(self, objects: Sequence[Any], only_closed: bool) -> dict[int, _Edges]:
        """Return the edges of objects that are drawn, by number."""
        found = {}
        for number, obj in enumerate(objects):
            edges = None if obj is None else self._edges_of(obj)
            if edges is not None and len(edges) and not (only_closed and not _is_closed(obj)):
                found[number] = _Edges(as_shown(obj), edges.reshape(-1))
        return found

    def _edges_of(self, obj: Any) -> np.ndarray | None:
        """Return the edges of an object's mesh that are drawn, (E, 2); None if none are."""
        mesh: Mesh = getattr(obj, "mesh", obj)
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

    def __init__(self, shape: Any, corners: np.ndarray) -> None:
        mesh: Mesh = getattr(shape, "mesh", shape)
        self._ends = mesh.positions[corners]
        is_many = isinstance(shape, InstancedMesh)
        self._instances = instance_matrices(shape.poses) if is_many else None
        self.parts = 1 if self._instances is None else len(self._instances)
        self.count = self.parts * (len(corners) // 2)

    def placed(self, arrays: NodeArrays, slot: int) -> np.ndarray:
        """Return the ends (2 E, 3) of what a node draws, of edges both of whose ends are finite."""
        pose = placing_poses(arrays, np.array([slot], np.int32))
        if self._instances is not None:
            pose = linalg.multiply(pose[0], self._instances)
        with np.errstate(over="ignore", invalid="ignore"):
            placed = [linalg.transform_points(one, self._ends) for one in pose]
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

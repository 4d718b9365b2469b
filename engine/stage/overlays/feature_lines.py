"""The feature edges of a model, drawn thin over its faces.

In: a staged scene and, each frame, where it is seen from. Out: lines beside the scene, translucent,
so that outputs other than the colour show the faces below them.

The lines are drawn a little nearer along the lines of sight, which looks the same, so that their
own faces do not hide them, while faces in front of them do.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
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
        self._found_in: Any = None
        self._watch = Watch()

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
        state = data.own.arrays.updated, data.own.objects.version, posing, data.hidden, only_closed
        if state == self._found_in and not self._watch.found():
            return
        self._found_in, self._watch = state, Watch(_things(data.own.objects.objects))
        if self._node is not None:
            self._staged.beside.remove(self._node)
            self._node = None
        ends = list(itertools.islice(self._ends(only_closed), MOST_PARTS + 1))
        count = sum(map(len, ends))
        if 0 < count <= 2 * MOST_EDGES and len(ends) <= MOST_PARTS:
            material = Material(color=COLOR, alpha_mode="blend", unlit=True)
            lines = np.arange(count, dtype=np.int32).reshape(-1, 2)
            made = Mesh(np.concatenate(ends), lines=lines, materials=[material])
            self._node = self._staged.beside.add(made, name="edges", cast_shadows=False)
            self._node.receive_shadows = False

    def _ends(self, only_closed: bool) -> Iterator[np.ndarray]:
        """Yield the ends of edges, (2 E, 3) in world space, until there are too many."""
        data, count = self._staged.data, 0
        arrays, objects = data.own.arrays, data.own.objects.objects
        flags = arrays.columns["flags"][: arrays.count].copy()
        hidden = data.own.slots_of(data.hidden)
        flags[hidden[hidden >= 0]] = 0
        numbers = arrays.columns["object"][: arrays.count]
        for number, obj in enumerate(objects):
            edges = None if obj is None else self._edges_of(obj)
            if edges is None or not len(edges) or (only_closed and not _is_closed(obj)):
                continue
            slots = np.flatnonzero((numbers == number) & (flags & SHOWN != 0)).astype(np.int32)
            shape: Any = as_shown(obj)
            for pose in _poses(shape, placing_poses(arrays, slots)):
                mesh = getattr(shape, "mesh", shape)
                with np.errstate(over="ignore", invalid="ignore"):
                    placed = linalg.transform_points(pose, mesh.positions[edges.reshape(-1)])
                yield _finite(placed)
                count += len(edges)
                if count > MOST_EDGES:
                    return

    def _edges_of(self, obj: Any) -> np.ndarray | None:
        """Return the edges of an object's mesh that are drawn, (E, 2); None if none are."""
        mesh: Mesh = getattr(obj, "mesh", obj)
        if self._of_all:
            return derived(mesh, "feature_edges")
        is_tinted = mesh.colors is not None or getattr(obj, "colors", None) is not None
        if is_tinted or not all(map(states_nothing, mesh.materials)):
            return None
        return derived(mesh, "faceted_edges")


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


def _poses(shape: Any, poses: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the world poses, (4, 4), at which a mesh is drawn by nodes at given poses."""
    if not isinstance(shape, InstancedMesh):
        yield from poses
        return
    instances = instance_matrices(shape.poses)
    for pose in poses:
        yield from linalg.multiply(pose, instances)


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

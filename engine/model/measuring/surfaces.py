"""The triangles of anything drawable, in world space, joined where they meet.

In: a mesh, instances, a node with its subtree, a scene. Out: a `Surface`. Vertices at exactly the
same place are one point, so that seams of textures and normals part nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..scene.instances import InstancedMesh, instance_matrices
from ..scene.nodes import Node
from ..scene.scene import Scene
from ..scene.shown import placing_pose, shown_object


class Surface(NamedTuple):
    """Triangles over points that each occur once.

    Attributes
    ----------
    points : (V, 3) ndarray of float64
        World space.
    faces : (F, 3) ndarray of int64
    numbers : (F,) ndarray of int64
        Where a face was among all faces given, of which those with corners that are not finite are
        left out.
    given : int
        How many faces were given.
    """

    points: NDArray[np.float64]
    faces: NDArray[np.int64]
    numbers: NDArray[np.int64]
    given: int

    @property
    def corners(self) -> NDArray[np.float64]:
        """The corners of the faces, (F, 3, 3)."""
        return self.points[self.faces]

    @property
    def box(self) -> NDArray[np.float64]:
        """Smallest and largest corner of the points, (2, 3); zeros without any."""
        if not len(self.points):
            return np.zeros((2, 3))
        return np.stack([self.points.min(axis=0), self.points.max(axis=0)])


def surface_of(thing: Any, what: str = "the thing") -> Surface:
    """Return the surface of a thing: of nodes what they show, at their current poses.

    Parameters
    ----------
    thing : Mesh, InstancedMesh, Node, Scene, or an iterable of these
    what : str
        What errors call it.

    Raises
    ------
    InvalidArgumentError
    """
    meshes = [mesh for one in _each(thing) for mesh in _placed_meshes(one, what)]
    points = [np.zeros((0, 3)), *(placed for placed, _ in meshes)]
    first = np.cumsum([0, *map(len, points)])
    faces = [np.zeros((0, 3), np.int64)]
    for (_, mesh), number in zip(meshes, first[1:-1], strict=True):
        faces.append(mesh.faces.astype(np.int64) + number)
    return _joined(np.concatenate(points), np.concatenate(faces))


def _each(thing: Any) -> Iterable[Any]:
    """Return the things of an iterable, or the only one."""
    if isinstance(thing, Iterable) and not isinstance(thing, (str, bytes, np.ndarray)):
        return thing
    return (thing,)


def _placed_meshes(thing: Any, what: str) -> Iterator[tuple[NDArray[np.float64], Mesh]]:
    """Yield each mesh of a thing, with its vertices in world space."""
    if isinstance(thing, (Mesh, InstancedMesh)):
        yield from _at_pose(thing, np.eye(4))
    elif isinstance(thing, Scene):
        thing.data.update()
        for node in thing.nodes:
            if node.shown:
                yield from _at_pose(shown_object(node), placing_pose(node))
    elif isinstance(thing, Node):
        if thing.scene is not None:
            thing.scene.data.update()
        waiting = [thing]
        while waiting:  # iterative, because trees may be deep
            node = waiting.pop()
            if node.visible:
                yield from _at_pose(shown_object(node), placing_pose(node))
                waiting += reversed(node.children)
    else:
        raise InvalidArgumentError(
            f"{what} must be a mesh, instances, a node or a scene, not {shown(thing)}"
        )


@np.errstate(all="ignore")
def _at_pose(thing: Any, pose: NDArray[np.float64]) -> Iterator[tuple[NDArray[np.float64], Mesh]]:
    if isinstance(thing, Mesh):
        points = thing.positions.astype(np.float64)
        yield (
            (points if (pose == np.eye(4)).all() else linalg.transform_points(pose, points)),
            thing,
        )
    elif isinstance(thing, InstancedMesh):
        for own in instance_matrices(thing.poses):
            placed = linalg.multiply(pose, own)
            yield linalg.transform_points(placed, thing.mesh.positions), thing.mesh


def _joined(points: NDArray[np.float64], faces: NDArray[np.int64]) -> Surface:
    """Return a surface of points of which several may be at one place."""
    finite = np.isfinite(points).all(axis=1)[faces].all(axis=1)
    given, faces = len(faces), faces[finite]
    used, corners = np.unique(faces, return_inverse=True)
    points = points[used] + 0.0  # -0.0 and 0.0 are one place
    order = np.lexsort(points.T)
    new = np.ones(len(order), bool)
    new[1:] = (points[order][1:] != points[order][:-1]).any(axis=1)
    place = np.empty(len(order), np.int64)
    place[order] = np.cumsum(new) - 1
    return Surface(points[order[new]], place[corners].reshape(-1, 3), np.flatnonzero(finite), given)

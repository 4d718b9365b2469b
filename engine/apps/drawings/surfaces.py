"""The surfaces and lines of a scene, in the world.

In: a scene. Out: the triangles of all that it shows, and their edges, part by part. A part is a
node or one of its instances. What cannot be drawn is named.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from operator import is_
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..._native import drawing as native
from ...base import linalg
from ...model.geometry.derived import arrays_of
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh, instance_matrices
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.shown import placing_pose, shown_object
from .line_kinds import INTERSECTION, LINE
from .mesh_edges import MeshEdges, face_normals, mesh_edges, thickness_of
from .model_lines import Lines, lines_of


class Surfaces:
    """Triangles and edges in the world, prepared for any number of views.

    Parameters
    ----------
    placed : list of (MeshEdges, (4, 4) float64)
        Each part's triangles and edges, and its pose.
    names : list of str
        Of the parts.

    Attributes
    ----------
    places : (V, 3) float64
    faces : (F, 3) int32
    parts : (F,) int32
        The part of each triangle.
    edges : native.Edges
        Those of the triangles.
    lines : Lines
        The model's own lines.
    bounds : (2, 3) float64
        The box of all places.
    thickness : float
        World units: what is so near a triangle's plane lies on it.
    names : list of str
    """

    def __init__(
        self, placed: list[tuple[MeshEdges, NDArray[np.float64]]], names: list[str]
    ) -> None:
        self.names = names
        joined = _joined(placed)
        self.places, self.faces, self.parts, enclosing, *edges, lines, line_parts = joined
        normals, _ = face_normals(self.places, self.faces)
        self.edges = native.Edges(self.places, self.faces, normals, self.parts, enclosing, *edges)
        self.lines = lines_of(self.places[lines], LINE, line_parts)
        self.bounds = np.zeros((2, 3))
        if len(self.places):
            self.bounds = np.stack([self.places.min(axis=0), self.places.max(axis=0)])
        self.thickness = thickness_of(self.bounds)
        self._crossings: Lines | None = None

    def intersections(self, threads: int) -> Lines:
        """Return the lines in which bodies cross; each belongs to the part of its first triangle.

        Bodies are parts, or what hangs together within one.
        """
        if self._crossings is None:
            bodies = native.find_bodies(self.faces, len(self.places))
            ends, faces = np.zeros((0, 2, 3)), np.zeros(0, np.int32)
            if len(bodies) and (bodies != bodies[0]).any():
                found = native.cross_surfaces(
                    self.places, self.faces, bodies, self.thickness, threads
                )
                ends = np.ascontiguousarray(found["ends"]).reshape(-1, 2, 3)
                faces = found["faces"][:, 0]
            self._crossings = lines_of(ends, INTERSECTION, self.parts[faces])
        return self._crossings


#: The surfaces that were made last of what begins with a mesh, and what they were made of.
_known: WeakKeyDictionary[Mesh, tuple[list[Any], Surfaces]] = WeakKeyDictionary()


def surfaces_of(scene: Scene, crease_angle: float) -> tuple[Surfaces, list[str]]:
    """Return what a scene shows, and a sentence for each node that is left out in part.

    Surfaces are kept as long as their first mesh, and made again once anything has changed.
    """
    scene.data.update()
    meshes: list[tuple[Mesh, dict[str, Any], NDArray[np.float64]]] = []
    names: list[str] = []
    omitted: list[str] = []
    for node in scene.nodes:
        thing: Any = shown_object(node) if node.shown else None
        mesh = thing.mesh if isinstance(thing, InstancedMesh) else thing
        if not isinstance(mesh, Mesh):
            continue
        if mesh.points is not None and len(mesh.points):
            omitted.append(f"{node.name or 'a node'}: a line drawing has no points")
        arrays = arrays_of(mesh)
        poses = list(enumerate(_poses(node, thing)))
        finite = [(number, pose) for number, pose in poses if _is_finite(pose)]
        if len(finite) < len(poses):
            lost = len(poses) - len(finite)
            omitted.append(f"{node.name or 'a node'}: {lost} of its poses are not finite")
        for number, pose in finite:
            meshes.append((mesh, arrays, pose))
            names.append(node.name if mesh is thing else f"{node.name} {number}")
    if not meshes:
        return Surfaces([], []), omitted
    first = meshes[0][0]
    made_of = [crease_angle, names, *((arrays, pose.tolist()) for _, arrays, pose in meshes)]
    kept, surfaces = _known.get(first, ([], None))
    if surfaces is None or not _is_same(kept, made_of):
        surfaces = _surfaces(meshes, names, crease_angle)
        _known[first] = made_of, surfaces
    return surfaces, omitted


def _is_same(one: list[Any], other: list[Any]) -> bool:
    """Return whether surfaces are made of the same arrays, at the same poses."""
    if len(one) != len(other) or one[:2] != other[:2]:
        return False
    return all(
        pose == other_pose and a.keys() == b.keys() and all(map(is_, a.values(), map(b.get, a)))
        for (a, pose), (b, other_pose) in zip(one[2:], other[2:], strict=True)
    )


@np.errstate(all="ignore")
def _surfaces(
    meshes: list[tuple[Mesh, dict[str, Any], NDArray[np.float64]]],
    names: list[str],
    crease_angle: float,
) -> Surfaces:
    known: dict[int, MeshEdges] = {}
    for mesh, arrays, _ in meshes:
        if id(mesh) not in known:
            known[id(mesh)] = mesh_edges(arrays, crease_angle)
    return Surfaces([(known[id(mesh)], pose) for mesh, _, pose in meshes], names)


def _is_finite(pose: NDArray[np.float64]) -> bool:
    return all(map(math.isfinite, pose.ravel().tolist()))


def _poses(node: Node, thing: Any) -> Iterator[NDArray[np.float64]]:
    pose = placing_pose(node)
    if isinstance(thing, InstancedMesh):
        for own in instance_matrices(thing.poses):
            yield linalg.multiply(pose, own)
    else:
        yield pose


def _joined(placed: list[tuple[MeshEdges, NDArray[np.float64]]]) -> list[NDArray[Any]]:
    """Return the arrays of all parts as one each, in the world."""
    rows = [_NOTHING]
    vertices = faces = 0
    for part, (edges, pose) in enumerate(placed):
        rows.append(
            (
                linalg.transform_points(pose, edges.positions),
                edges.faces + np.int32(vertices),
                np.full(len(edges.faces), part, np.int32),
                edges.enclosing * _winding(pose),
                edges.ends + np.int32(vertices),
                np.where(edges.beside >= 0, edges.beside + np.int32(faces), np.int32(-1)),
                edges.turned,
                edges.kinds,
                edges.lines + np.int32(vertices),
                np.full(len(edges.lines), part, np.int32),
            )
        )
        vertices, faces = vertices + len(edges.positions), faces + len(edges.faces)
    return list(map(_together, zip(*rows, strict=True)))


def _winding(pose: NDArray[np.float64]) -> np.int8:
    """Return -1 for a pose that mirrors, 0 for one that makes all flat, else 1."""
    x, y, z = pose[:3, :3]
    return np.int8(np.sign(linalg.dot(x, linalg.cross(y, z))))


def _together(rows: tuple[NDArray[Any], ...]) -> NDArray[Any]:
    return np.ascontiguousarray(rows[1] if len(rows) == 2 else np.concatenate(rows))


#: The columns of no part at all.
_NONE, _NO_PAIRS = np.zeros(0, np.int32), np.zeros((0, 2), np.int32)
_NOTHING: tuple[NDArray[Any], ...] = (
    np.zeros((0, 3)),
    np.zeros((0, 3), np.int32),
    *(_NONE, np.zeros(0, np.int8), _NO_PAIRS, _NO_PAIRS),
    *(np.zeros(0, np.uint8), np.zeros(0, np.int8), _NO_PAIRS, _NONE),
)

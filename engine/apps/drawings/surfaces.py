"""The surfaces and lines of a scene, in the world.

In: a scene. Out: the triangles of all that it shows, and their edges, part by part. A part is a
node or one of its instances. What cannot be drawn is named.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh, instance_matrices
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.shown import placing_pose, shown_object
from .mesh_edges import MeshEdges, mesh_edges


class Surfaces(NamedTuple):
    """Triangles and edges in the world.

    Attributes
    ----------
    places : (V, 3) float64
    faces : (F, 3) int32
    parts : (F,) int32
        The part of each triangle.
    ends, beside : (E, 2) int32
        The vertices of each edge, and the triangles at its sides, -1 for none.
    turned, creases, borders : (E,) bool
        As in `MeshEdges`.
    lines : (L, 2) int32
    line_parts : (L,) int32
    names : list of str
        Of the parts.
    """

    places: NDArray[np.float64]
    faces: NDArray[np.int32]
    parts: NDArray[np.int32]
    ends: NDArray[np.int32]
    beside: NDArray[np.int32]
    turned: NDArray[np.bool_]
    creases: NDArray[np.bool_]
    borders: NDArray[np.bool_]
    lines: NDArray[np.int32]
    line_parts: NDArray[np.int32]
    names: list[str]


def surfaces_of(scene: Scene, crease_angle: float) -> tuple[Surfaces, list[str]]:
    """Return what a scene shows, and a sentence for each node that is left out in part."""
    scene.data.update()
    known: dict[int, MeshEdges] = {}
    placed: list[tuple[MeshEdges, NDArray[np.float64]]] = []
    names: list[str] = []
    omitted: list[str] = []
    for node in scene.nodes:
        thing: Any = shown_object(node) if node.shown else None
        mesh = thing.mesh if isinstance(thing, InstancedMesh) else thing
        if not isinstance(mesh, Mesh):
            continue
        if mesh.points is not None and len(mesh.points):
            omitted.append(f"{node.name or 'a node'}: a line drawing has no points")
        if id(mesh) not in known:
            known[id(mesh)] = mesh_edges(mesh, crease_angle)
        for number, pose in enumerate(_poses(node, thing)):
            placed.append((known[id(mesh)], pose))
            names.append(node.name if mesh is thing else f"{node.name} {number}")
    return _joined(placed, names), omitted


def _poses(node: Node, thing: Any) -> Iterator[NDArray[np.float64]]:
    pose = placing_pose(node)
    if isinstance(thing, InstancedMesh):
        for own in instance_matrices(thing.poses):
            yield linalg.multiply(pose, own)
    else:
        yield pose


def _joined(placed: list[tuple[MeshEdges, NDArray[np.float64]]], names: list[str]) -> Surfaces:
    rows = [_NOTHING]
    vertices = faces = 0
    for part, (edges, pose) in enumerate(placed):
        rows.append(
            (
                linalg.transform_points(pose, edges.positions),
                edges.faces + np.int32(vertices),
                np.full(len(edges.faces), part, np.int32),
                edges.ends + np.int32(vertices),
                np.where(edges.beside >= 0, edges.beside + np.int32(faces), np.int32(-1)),
                edges.turned,
                edges.creases,
                edges.borders,
                edges.lines + np.int32(vertices),
                np.full(len(edges.lines), part, np.int32),
            )
        )
        vertices, faces = vertices + len(edges.positions), faces + len(edges.faces)
    return Surfaces(*map(_together, zip(*rows, strict=True)), names)


def _together(rows: tuple[NDArray[Any], ...]) -> NDArray[Any]:
    return np.ascontiguousarray(rows[1] if len(rows) == 2 else np.concatenate(rows))


#: The columns of no part at all.
_NONE, _NO_PAIRS = np.zeros(0, np.int32), np.zeros((0, 2), np.int32)
_FLAGS = np.zeros(0, bool)
_NOTHING: tuple[NDArray[Any], ...] = (
    np.zeros((0, 3)),
    np.zeros((0, 3), np.int32),
    *(_NONE, _NO_PAIRS, _NO_PAIRS, _FLAGS, _FLAGS, _FLAGS, _NO_PAIRS, _NONE),
)

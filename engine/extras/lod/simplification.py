"""Mesh simplification by quadric edge collapses, with the package fast-simplification.

In: a mesh and the share of its triangles to keep. Out: a mesh with the same materials, and how far
the old surface may lie from it. Each material is simplified by itself and borders stay where they
are, so parts meet without cracks; vertices split for texture coordinates, colours or normals are
borders as well.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base import linalg
from ...base.calls import checks_types
from ...base.optional_packages import needed
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.geometry.values import put_values, taken_rows
from ...model.geometry.vertex_attributes import attributes_of, vertex_attributes
from ...model.materials.linear_colors import floats_are_linear

_ATTRIBUTES = ("normals", *vertex_attributes(Mesh))


@checks_types
def simplify(mesh: Mesh, ratio: float) -> tuple[Mesh, float]:
    """Return a mesh with fewer triangles, and its distance from the original.

    Needs the package fast-simplification: ``pip install engine3d[detail]``. Its results may differ
    between machines and versions.

    Parameters
    ----------
    mesh : Mesh
        The mesh; lines and points are dropped.
    ratio : float
        The share of the triangles to keep, more than 0 and at most 1. Borders and seams may keep
        more.

    Returns
    -------
    coarse : Mesh
        With the same materials; its vertices have attributes and ``values`` of old ones near by.
        Values of faces and points are dropped.
    error : float
        The farthest that a vertex of ``mesh`` is from the triangles that took its place, in its own
        units.

    Raises
    ------
    InvalidArgumentError
    ImportError
        There is no fast-simplification.
    """
    if not isinstance(mesh, Mesh):
        raise InvalidArgumentError(f"mesh must be a Mesh, not {type(mesh).__name__}")
    if not 0.0 < ratio <= 1.0:
        raise InvalidArgumentError(f"ratio must be more than 0 and at most 1, not {ratio!r}")
    vertex_of, first = _equal_vertices(mesh)
    parts, error = [], 0.0
    for material in np.unique(mesh.material_ids).tolist():
        faces = vertex_of[mesh.faces[mesh.material_ids == material]]
        distinct = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
        finite = np.isfinite(mesh.positions[first][faces]).all(axis=(1, 2))
        if (distinct & finite).any():
            positions, faces, sources, part_error = _simplified(
                mesh.positions[first], faces[distinct & finite], ratio
            )
            parts.append((positions, faces, first[sources], material))
            error = max(error, part_error)
    return _joined(mesh, parts), error


def _equal_vertices(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return a number for each vertex, the same for equal vertices, and the first of each."""
    columns = [mesh.positions]
    columns += [mesh.normals] if mesh.has_normals else []
    columns += attributes_of(mesh).values()
    rows = np.concatenate([column.astype(np.float32) for column in columns], axis=1)
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return number.reshape(-1), first


def _simplified(
    positions: np.ndarray, faces: np.ndarray, ratio: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Return positions and faces of one part, the old vertex of each new one, and the error."""
    try:
        import fast_simplification
    except ImportError as error:
        message = needed("simplify needs", "fast-simplification", "detail")
        raise ImportError(message, name=error.name) from error

    used, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3).astype(np.int32)
    old = positions[used].astype(np.float64)
    count = max(1, round(ratio * len(faces)))
    _, _, collapses = fast_simplification.simplify(
        old, faces, target_count=count, return_collapses=True, preserve_border=True
    )
    new, new_faces, becomes = fast_simplification.replay_simplification(old, faces, collapses)
    new, new_faces = np.asarray(new, np.float64), np.asarray(new_faces, np.int32)
    offsets = old - new[becomes]
    order = np.lexsort((linalg.dot(offsets, offsets), becomes))
    ends, nearest = np.unique(becomes[order], return_index=True)
    sources = np.zeros(len(new), np.intp)
    sources[ends] = order[nearest]
    return new, new_faces, used[sources], _error(old, new, new_faces, becomes)


def _error(old: np.ndarray, new: np.ndarray, faces: np.ndarray, becomes: np.ndarray) -> float:
    """Return the largest distance of old vertices from the triangles near their new vertices."""
    edges = np.unique(faces[:, [0, 1, 1, 2, 2, 0, 1, 0, 2, 1, 0, 2]].reshape(-1, 2), axis=0)
    edges = np.concatenate([edges, np.repeat(np.arange(len(new)), 2).reshape(-1, 2)])
    vertex, near = _expanded(np.arange(len(old)), becomes, edges[:, 0], edges[:, 1], len(new))
    triangles = np.repeat(np.arange(len(faces)), 3)
    vertex, triangle = _expanded(vertex, near, faces.reshape(-1), triangles, len(new))
    distance = _distances(old[vertex], *(new[faces[triangle, k]] for k in range(3)))
    nearest = np.full(len(old), np.inf)
    np.minimum.at(nearest, vertex, distance)
    return float(nearest[np.isfinite(nearest)].max(initial=0.0))


def _expanded(
    owner: np.ndarray, key: np.ndarray, keys: np.ndarray, values: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return each owner with every value that has its key; keys are below ``count``."""
    order = np.argsort(keys, kind="stable")
    starts = np.searchsorted(keys[order], np.arange(count + 1))
    sizes = np.diff(starts)[key]
    step = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return np.repeat(owner, sizes), values[order[np.repeat(starts[key], sizes) + step]]


def _distances(points: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return distances of points from triangles, (N,): to the plane if inside, else to an edge."""
    edges = [_to_segments(points, p, q) for p, q in ((a, b), (b, c), (c, a))]
    normal = linalg.normalize(linalg.cross(b - a, c - a))
    height = np.abs(linalg.dot(points - a, normal))
    inside = np.ones(len(points), bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= linalg.dot(linalg.cross(q - p, points - p), normal) >= 0.0
    return np.where(inside & normal.any(axis=1), height, np.minimum.reduce(edges))


def _to_segments(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    way = b - a
    square = linalg.dot(way, way)
    along = linalg.dot(points - a, way) / np.where(square > 0.0, square, 1.0)
    return linalg.length(points - (a + way * np.clip(along, 0.0, 1.0)[:, np.newaxis]))


def _joined(mesh: Mesh, parts: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray, int]]) -> Mesh:
    """Return one mesh of all parts, with the old mesh's attributes."""
    if not parts:
        return Mesh(np.zeros((0, 3), np.float32), materials=mesh.materials, name=mesh.name)
    positions, faces, sources, ids = zip(*parts, strict=True)
    starts = np.cumsum([0] + [len(part) for part in positions[:-1]])
    source = np.concatenate(sources)
    attributes = {
        name: getattr(mesh, name)[source]
        for name in _ATTRIBUTES
        if (mesh.has_normals if name == "normals" else getattr(mesh, name) is not None)
    }
    with floats_are_linear():
        coarse = Mesh(
            np.concatenate(positions),
            np.concatenate([part + start for part, start in zip(faces, starts, strict=True)]),
            materials=mesh.materials,
            material_ids=np.repeat(ids, [len(part) for part in faces]),
            crease_angle=mesh.crease_angle,
            name=mesh.name,
            **attributes,
        )
    put_values(coarse, taken_rows(mesh.values, vertices=source))
    return coarse

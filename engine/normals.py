"""Normals of vertices and faces, computed from positions and faces.

In: positions (V, 3) in object space and faces (F, 3), counter-clockwise seen from outside. Out:
unit normals, float32. Everything runs in float64, element by element and in the order of the faces,
and is rounded once at the end, so that the result is the same on every processor.

Vertex normals are weighted by angle (Thuermer and Wuethrich, "Computing Vertex Normals from
Polygonal Facets", 1998): they do not depend on how polygons were cut into triangles. A vertex
without a face of non-zero area gets (0, 0, 0), never NaN.
"""

from __future__ import annotations

import numpy as np

# A group of triangles whose area vectors cancel by more than half is no polygon but a curved patch.
_PLANARITY = 0.5

# acos(x) = sqrt(1 - x) * polynomial(x) for 0 <= x <= 1 to 2e-8 (Abramowitz and Stegun, 4.4.46).
# The library's arc cosine differs from processor to processor; these operations don't.
_ARC_COSINE = (
    1.5707963050,
    -0.2145988016,
    0.0889789874,
    -0.0501743046,
    0.0308918810,
    -0.0170881256,
    0.0066700901,
    -0.0012624911,
)
# Faces worked on at a time, which bounds the memory for intermediate results.
_BLOCK = 1 << 16
_PI = 3.141592653589793


@np.errstate(all="ignore")
def face_area_vectors(positions: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return the cross product of each face's edges: twice its area, along its normal.

    Parameters
    ----------
    positions : (V, 3) float
    faces : (F, 3) int

    Returns
    -------
    area_vectors : (F, 3) float64
        Zero for faces with a vertex that is not finite.
    """
    corners = positions.astype(np.float64)[faces]
    ab = corners[:, 1] - corners[:, 0]
    ac = corners[:, 2] - corners[:, 0]
    vectors = np.empty((len(faces), 3), np.float64)
    vectors[:, 0] = ab[:, 1] * ac[:, 2] - ab[:, 2] * ac[:, 1]
    vectors[:, 1] = ab[:, 2] * ac[:, 0] - ab[:, 0] * ac[:, 2]
    vectors[:, 2] = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    vectors[~np.isfinite(vectors).all(axis=1)] = 0
    return vectors


@np.errstate(all="ignore")
def corner_angles(positions: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return the inner angle at each corner of each face.

    Parameters
    ----------
    positions : (V, 3) float
    faces : (F, 3) int

    Returns
    -------
    angles : (F, 3) float64, radians
        Zero where an edge has no length or is not finite.
    """
    corners = positions.astype(np.float64)[faces]
    angles = np.empty(faces.shape, np.float64)
    edges = np.roll(corners, -1, axis=1) - corners
    lengths = _lengths(edges)
    for corner in range(3):
        onward, back = edges[:, corner], edges[:, corner - 1]
        dots = onward[:, 0] * back[:, 0] + onward[:, 1] * back[:, 1] + onward[:, 2] * back[:, 2]
        cosine = -dots / (lengths[:, corner] * lengths[:, corner - 1])
        angles[:, corner] = _arc_cosine(cosine)
    angles[~np.isfinite(angles)] = 0
    return angles


def corner_vectors(positions: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return what each corner of each face adds to the normal of its vertex.

    Returns
    -------
    vectors : (F, 3, 3) float64
        The unit normal of the face times the angle at the corner; zero for faces without area.
    """
    normals = unit_vectors(face_area_vectors(positions, faces))
    return corner_angles(positions, faces)[:, :, np.newaxis] * normals[:, np.newaxis, :]


def smooth_sums(
    positions: np.ndarray, faces: np.ndarray, groups: np.ndarray, count: int
) -> np.ndarray:
    """Add up the `corner_vectors` of all corners by group.

    Parameters
    ----------
    positions : (V, 3) float
    faces : (F, 3) int
    groups : (F, 3) int
        The group of each corner, in 0..count-1.
    count : int
        Number of groups.

    Returns
    -------
    sums : (count, 3) float64
        Not normalised. Added up in the order of the faces, block by block.
    """
    sums = np.zeros((count, 3), np.float64)
    for start in range(0, len(faces), _BLOCK):
        block = slice(start, start + _BLOCK)
        vectors = corner_vectors(positions, faces[block]).reshape(-1, 3)
        sums += group_sums(vectors, groups[block].ravel(), count)
    return sums


def vertex_normals(
    positions: np.ndarray, faces: np.ndarray, position_ids: np.ndarray | None = None
) -> np.ndarray:
    """Return angle-weighted vertex normals.

    Parameters
    ----------
    positions : (V, 3) float
    faces : (F, 3) int
    position_ids : (V,) int, optional
        Vertices with the same number are one point of the surface, split only for another
        attribute (a seam of texture coordinates); they get the same normal.

    Returns
    -------
    normals : (V, 3) float32, unit length, or zero where no face tells a direction
    """
    if position_ids is None:
        sums = smooth_sums(positions, faces, faces, len(positions))
        return unit_vectors(sums).astype(np.float32)
    points = int(position_ids.max(initial=-1)) + 1
    sums = smooth_sums(positions, faces, position_ids[faces], points)
    return unit_vectors(sums).astype(np.float32)[position_ids]


def group_sums(vectors: np.ndarray, groups: np.ndarray, count: int) -> np.ndarray:
    """Add up vectors by group.

    Parameters
    ----------
    vectors : (N, 3) float64
    groups : (N,) int
        The group of each vector, in 0..count-1.
    count : int
        Number of groups.

    Returns
    -------
    sums : (count, 3) float64, added up in the order of the vectors
    """
    sums = np.empty((count, 3), np.float64)
    for axis in range(3):
        sums[:, axis] = np.bincount(groups, weights=vectors[:, axis], minlength=count)
    return sums


def face_normals(
    positions: np.ndarray, faces: np.ndarray, polygon_ids: np.ndarray | None = None
) -> np.ndarray:
    """Return one normal a face, the same for all triangles of a polygon.

    The normal of a polygon is that of the sum of its triangles' area vectors (Newell's normal).

    Parameters
    ----------
    positions : (V, 3) float
    faces : (F, 3) int
    polygon_ids : (F,) int, optional
        The polygon of each face, as `engine3d.topology.polygon_ids` gives it.

    Returns
    -------
    normals : (F, 3) float32, unit length, or zero for faces without area
    """
    own = face_area_vectors(positions, faces)
    if polygon_ids is None or len(faces) == 0:
        return unit_vectors(own).astype(np.float32)
    count = int(polygon_ids.max()) + 1
    sums = group_sums(own, polygon_ids, count)
    total = np.bincount(polygon_ids, weights=_lengths(own), minlength=count)
    planar = _lengths(sums) >= _PLANARITY * total
    chosen = np.where(planar[polygon_ids, np.newaxis], sums[polygon_ids], own)
    return unit_vectors(chosen).astype(np.float32)


@np.errstate(over="ignore", invalid="ignore")
def _lengths(vectors: np.ndarray) -> np.ndarray:
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.sqrt(x * x + y * y + z * z)


def unit_vectors(vectors: np.ndarray) -> np.ndarray:
    """Scale (N, 3) vectors to length one; zero stays zero, and what is too long becomes zero."""
    length = _lengths(vectors)
    length[length == 0] = 1
    long = ~np.isfinite(length)
    if long.any():
        vectors = np.where(long[:, np.newaxis], 0, vectors)
        length[long] = 1
    return vectors / length[:, np.newaxis]


def _arc_cosine(x: np.ndarray) -> np.ndarray:
    """The angle in 0..pi with cosine ``x``, which is clamped to -1..1."""
    size = np.minimum(np.abs(x), 1.0)
    polynomial = np.full_like(size, _ARC_COSINE[-1])
    for coefficient in _ARC_COSINE[-2::-1]:
        polynomial = polynomial * size + coefficient
    angle = np.sqrt(1.0 - size) * polynomial
    return np.where(x < 0, _PI - angle, angle)

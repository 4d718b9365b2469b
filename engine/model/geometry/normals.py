"""Normals of vertices and faces, computed from positions and faces.

In: positions (V, 3) in object space and faces (F, 3), counter-clockwise seen from outside. Out:
unit normals, float32. All arithmetic is float64, element by element in the order of the faces, and
rounded once at the end, so that every processor gives the same result.

Vertex normals are weighted by angle (Thuermer and Wuethrich, "Computing Vertex Normals from
Polygonal Facets", 1998): they do not depend on how polygons were cut into triangles. A vertex
without a face of non-zero area gets (0, 0, 0), never NaN.
"""

from __future__ import annotations

import numpy as np

from ..._native import loaders as native

# If a group of triangles has area vectors that cancel by more than half, it is a curved patch, not
# a polygon.
_PLANARITY = 0.5

# Faces summed at a time; it affects the last bits of the sums.
_BLOCK = 1 << 16


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


def smooth_sums(
    positions: np.ndarray, faces: np.ndarray, groups: np.ndarray, count: int
) -> np.ndarray:
    """Sum, by group, the contribution of each face corner to the normal of its vertex.

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
        Not normalised: the sum of each face's unit normal times its angle at the corner, zero for
        faces without area or with a non-finite vertex. Summed in the order of the faces, block by
        block.
    """
    if positions.dtype != np.float32:
        positions = positions.astype(np.float64, copy=False)
    positions = np.ascontiguousarray(positions)
    faces, groups = (np.ascontiguousarray(indices, np.int32) for indices in (faces, groups))
    return native.smooth_sums(positions, faces, groups, count, _BLOCK)


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
    normals : (V, 3) float32, unit length, or zero without a face of nonzero area
    """
    if position_ids is None:
        sums = smooth_sums(positions, faces, faces, len(positions))
        return unit_vectors(sums).astype(np.float32)
    points = int(position_ids.max(initial=-1)) + 1
    sums = smooth_sums(positions, faces, position_ids[faces], points)
    return unit_vectors(sums).astype(np.float32)[position_ids]


def group_sums(vectors: np.ndarray, groups: np.ndarray, count: int) -> np.ndarray:
    """Sum vectors by group.

    Parameters
    ----------
    vectors : (N, 3) float64
    groups : (N,) int
        The group of each vector, in 0..count-1.
    count : int
        Number of groups.

    Returns
    -------
    sums : (count, 3) float64, summed in the order of the vectors
    """
    sums = np.empty((count, 3), np.float64)
    for axis in range(3):
        sums[:, axis] = np.bincount(groups, weights=vectors[:, axis], minlength=count)
    return sums


def face_normals(
    positions: np.ndarray, faces: np.ndarray, polygon_ids: np.ndarray | None = None
) -> np.ndarray:
    """Return one normal per face, the same for all triangles of a polygon.

    The normal of a polygon is the direction of the sum of its triangles' area vectors (Newell's
    normal).

    Parameters
    ----------
    positions : (V, 3) float
    faces : (F, 3) int
    polygon_ids : (F,) int, optional
        The polygon of each face, as `engine3d.model.geometry.topology.polygon_ids` gives it.

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
    """Scale (N, 3) vectors to unit length; zero stays zero, and overflowing lengths give zero."""
    length = _lengths(vectors)
    length[length == 0] = 1
    long = ~np.isfinite(length)
    if long.any():
        vectors = np.where(long[:, np.newaxis], 0, vectors)
        length[long] = 1
    return vectors / length[:, np.newaxis]

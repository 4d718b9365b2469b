"""Computes normals that a file omits, by its smoothing groups.

In: triangles with indices of positions and normals, -1 for none, and their smoothing groups. Out:
the same with every corner's normal filled in. Corners of one position in one group share an
angle-weighted normal; a triangle without a group is flat: all corners of its polygon share one
normal.
"""

from __future__ import annotations

import functools
from typing import TypeAlias

import numpy as np

from ..._native import loaders as native
from ...model.geometry.creases import SMOOTH, find_creases
from ...model.geometry.mesh import Mesh
from ...model.geometry.normals import face_normals, smooth_sums, unit_vectors
from .welding import number_rows, rows_repeat

FLAT = 0
# Surface parts that meet at less than 30 degrees were smooth before they were cut.
_SEAM_COSINE = 0.8660254
_MAX_MASKS = 64

# A table of normals (N, 3), and each corner's row in it (T, 3).
_Normals: TypeAlias = tuple[np.ndarray, np.ndarray]


def fill_normals(
    positions: np.ndarray,
    corners: np.ndarray,
    normal_indices: np.ndarray | None,
    normals: np.ndarray,
    groups: np.ndarray,
    polygons: np.ndarray,
    *,
    are_masks: bool = False,
    crease_angle: float = SMOOTH,
) -> tuple[np.ndarray, np.ndarray] | None:
    """Fill in missing normals of corners.

    Parameters
    ----------
    positions : (V, 3) float64
    corners : (T, 3) int32
        Position indices of each triangle's corners.
    normal_indices : (T, 3) int32 or None
        Indices into ``normals``, -1 for none; None if no corner has any.
    normals : (N, 3) float64
        The file's normals.
    groups : (T,) int64
        Smoothing group of each triangle, 0 for flat.
    polygons : (T,) int32
        The polygon of each triangle.
    are_masks : bool
        Whether each bit of ``groups`` is a group, so that a triangle may be in several.
    crease_angle : float
        Radians, for triangles in one group because the file has no groups.

    Returns
    -------
    (normal_indices, normals) or None
        None if no corner has a normal and all are in one group: the mesh computes the same itself.
    """
    is_flat = groups == FLAT
    if normal_indices is None:
        if not is_flat.any() and (groups == groups[:1]).all():
            return None
        normal_indices = np.full(corners.shape, -1, np.int32)
    missing = normal_indices < 0
    if not missing.any():
        return normal_indices, normals
    filled = normal_indices.copy()
    grouped = _grouped_normals
    if crease_angle < SMOOTH:
        grouped = functools.partial(_creased_normals, crease_angle=crease_angle)
    tables = [np.asarray(normals, np.float32).reshape(-1, 3)]
    for chosen, compute in (
        (missing & ~is_flat[:, np.newaxis], _masked_normals if are_masks else grouped),
        (missing & is_flat[:, np.newaxis], _flat_normals),
    ):
        if chosen.any():
            by = polygons if compute is _flat_normals else groups
            table, indices = compute(positions, corners, by)
            filled[chosen] = indices[chosen] + sum(map(len, tables))
            tables.append(table)
    return filled, np.concatenate(tables)


def _grouped_normals(positions: np.ndarray, corners: np.ndarray, groups: np.ndarray) -> _Normals:
    """Return one normal for each position and group, and each corner's index."""
    _, group = np.unique(groups, return_inverse=True)
    of_corner = np.repeat(group.astype(np.int32), 3)
    corners = np.ascontiguousarray(corners, np.int32)
    shared, places, *_ = native.weld_corners(corners.ravel(), of_corner, None, len(positions))
    shared = shared.reshape(corners.shape)
    sums = smooth_sums(positions, corners, shared, len(places))
    return unit_vectors(sums).astype(np.float32), shared


def _creased_normals(
    positions: np.ndarray, corners: np.ndarray, groups: np.ndarray, *, crease_angle: float
) -> _Normals:
    """Return a normal for each position and side of a crease, and each corner's index."""
    arrays = {
        "positions": np.ascontiguousarray(positions, np.float32),
        "faces": np.ascontiguousarray(corners, np.int32),
        "edge_visible": None,
    }
    made = find_creases(arrays, crease_angle)
    return made.normals, made.faces


def _masked_normals(positions: np.ndarray, corners: np.ndarray, masks: np.ndarray) -> _Normals:
    """Return one normal for each position and mask, summed over triangles that share a group."""
    distinct, mask = np.unique(masks, return_inverse=True)
    if len(distinct) > _MAX_MASKS:
        # No real model needs more; using only the lowest group bounds the work.
        return _grouped_normals(positions, corners, masks & -masks)
    count = len(positions)
    tables = []
    for value in distinct:
        near = corners[(masks & value) != 0]
        sums = smooth_sums(positions, near, near, count)
        tables.append(unit_vectors(sums).astype(np.float32))
    return np.concatenate(tables), corners + mask.reshape(-1, 1) * count


def _flat_normals(positions: np.ndarray, corners: np.ndarray, polygons: np.ndarray) -> _Normals:
    """Return one normal for each polygon, and each corner's index."""
    # Polygons are in order.
    is_first = np.r_[True, polygons[1:] != polygons[:-1]]
    polygon = np.cumsum(is_first) - 1
    table = face_normals(positions, corners, polygon)[is_first]
    return table, np.repeat(polygon.reshape(-1, 1), 3, axis=1)


def join_seams(mesh: Mesh) -> None:
    """Merge vertices of equal coordinates into one point where the surface is smooth.

    Many files duplicate the points along the border of two patches, which would show as a crease.
    Vertices whose normals differ by 30 degrees or more from the merged normal stay separate: they
    are on an edge of the model.

    Parameters
    ----------
    mesh : Mesh
        A mesh without given normals; its ``position_ids`` may change.
    """
    positions, given = mesh.positions, mesh.position_ids
    if given is None and not rows_repeat(positions):
        return
    group, first = number_rows(positions)
    ids = np.arange(len(positions)) if given is None else given
    differs = ids != ids[first[group]]
    if not differs.any():
        return
    is_apart = np.bincount(group, weights=differs)[group] > 0
    faces = mesh.faces[is_apart[mesh.faces].any(axis=1)]
    together, own = (
        unit_vectors(smooth_sums(positions, faces, by[faces], int(by.max()) + 1))[by]
        for by in (group, ids)
    )
    x, y, z = own[:, 0] * together[:, 0], own[:, 1] * together[:, 1], own[:, 2] * together[:, 2]
    joined = is_apart & (x + y + z > _SEAM_COSINE)
    _, mesh.position_ids = np.unique(
        np.where(joined, group, int(group.max()) + 1 + ids), return_inverse=True
    )

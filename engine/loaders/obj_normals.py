"""The normals that an OBJ file leaves out, by its smoothing groups.

In: triangles with indices of positions and normals, -1 where there is none, and the smoothing group
of each. Out: the same with every corner's normal filled in. Corners of one position and one group
share an angle-weighted normal; group 0 is flat: each polygon has its own normal.
"""

from __future__ import annotations

import numpy as np

from ..normals import corner_vectors, face_normals, group_sums, unit_vectors

# Group of all faces of a file without any smoothing statement.
UNGROUPED = 1


def fill_normals(
    positions: np.ndarray,
    corners: np.ndarray,
    normal_indices: np.ndarray,
    normals: np.ndarray,
    groups: np.ndarray,
    polygons: np.ndarray,
) -> tuple[np.ndarray, np.ndarray] | None:
    """Give every corner a normal.

    Parameters
    ----------
    positions : (V, 3) float64
    corners : (T, 3) int64
        Position index of each triangle's corners.
    normal_indices : (T, 3) int64
        Their normals in ``normals``, -1 for none.
    normals : (N, 3) float64
        The file's normals.
    groups : (T,) int64
        Smoothing group of each triangle, 0 for flat.
    polygons : (T,) int64
        The polygon that each triangle is part of.

    Returns
    -------
    (normal_indices, normals) or None
        None if no corner has a normal and all are in one group: then the mesh computes the same
        by itself.
    """
    missing = normal_indices < 0
    if not missing.any():
        return normal_indices, normals
    is_flat = groups == 0
    if missing.all() and not is_flat.any() and (groups == groups[0]).all():
        return None
    filled = normal_indices.copy()
    smooth = missing & ~is_flat[:, np.newaxis]
    flat = missing & is_flat[:, np.newaxis]
    tables = [np.asarray(normals, np.float32).reshape(-1, 3)]
    if smooth.any():
        table, indices = _smooth_normals(positions, corners, groups)
        filled[smooth] = indices[smooth] + sum(map(len, tables))
        tables.append(table)
    if flat.any():
        table, indices = _flat_normals(positions, corners, polygons)
        filled[flat] = indices[flat] + sum(map(len, tables))
        tables.append(table)
    return filled, np.concatenate(tables)


def _smooth_normals(positions, corners, groups):
    """One normal for each position in each group, and the one of every corner."""
    _, group = np.unique(groups, return_inverse=True)
    keys = corners * (int(group.max()) + 1) + group.reshape(-1, 1)
    _, shared = np.unique(keys, return_inverse=True)
    shared = shared.reshape(-1)
    vectors = corner_vectors(positions, corners).reshape(-1, 3)
    sums = group_sums(vectors, shared, int(shared.max()) + 1)
    return unit_vectors(sums).astype(np.float32), shared.reshape(corners.shape)


def _flat_normals(positions, corners, polygons):
    """One normal for each polygon, and the one of every corner."""
    numbers, first, polygon = np.unique(polygons, return_index=True, return_inverse=True)
    table = face_normals(positions, corners, polygon.reshape(-1))[first]
    return table, np.repeat(polygon.reshape(-1, 1), 3, axis=1)

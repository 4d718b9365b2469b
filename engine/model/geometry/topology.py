"""Edges and polygons of a triangle mesh, from its faces and their edge flags.

In: faces (F, 3), the visibility of their edges (F, 3), and position IDs. Out: each edge of the
wireframe once, and the polygon that each triangle was cut from. Entry k of a face's flags is the
edge from its vertex k to its vertex (k + 1) % 3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._native.loaders import find_edges


def visible_edges(
    faces: np.ndarray,
    edge_visible: np.ndarray | None = None,
    position_ids: np.ndarray | None = None,
) -> np.ndarray:
    """Return each edge that is visible in at least one face once.

    Parameters
    ----------
    faces : (F, 3) int
    edge_visible : (F, 3) bool, optional
        None means that all are visible.
    position_ids : (V,) int, optional
        Vertices with the same number are one point, so their edges coincide.

    Returns
    -------
    edges : (E, 2) int32
        Vertex indices from the first face that shows the edge, in order of appearance. Edges from a
        point to itself are left out.
    """
    faces = np.ascontiguousarray(faces, np.int32)
    if position_ids is None:
        count = int(faces.max(initial=-1)) + 1
    else:
        position_ids = np.ascontiguousarray(position_ids, np.int32)
        count = int(position_ids.max(initial=-1)) + 1
    wanted = None if edge_visible is None else np.ascontiguousarray(edge_visible, bool)
    wanted = None if wanted is None else wanted.reshape(-1).view(np.uint8)
    sides = np.flatnonzero(find_edges(faces, position_ids, wanted, count))
    corners = faces.reshape(-1)
    behind = sides + np.where(sides % 3 == 2, -2, 1)
    return np.stack([corners[sides], corners[behind]], axis=1)


def polygon_ids(
    faces: np.ndarray,
    edge_visible: np.ndarray | None = None,
    position_ids: np.ndarray | None = None,
) -> np.ndarray:
    """Return the number of the polygon that each face belongs to.

    Consecutive triangles joined by shared edges hidden in both are one polygon. Polygons are
    numbered in the order of their first faces.

    Parameters
    ----------
    faces, edge_visible, position_ids
        As in `visible_edges`.

    Returns
    -------
    polygons : (F,) int32, starting at 0, never decreasing
    """
    count = len(faces)
    if edge_visible is None or edge_visible.all():
        return np.arange(count, dtype=np.int32)
    first, second = _hidden_edge_pairs(faces, edge_visible, position_ids)
    label = components(count, first, second)
    # If the faces of a component are not consecutive (files may flag any edge), split it into its
    # runs.
    joined = np.zeros(count, bool)
    size = np.bincount(label, minlength=count)
    last = np.zeros(count, np.int64)
    np.maximum.at(last, label, np.arange(count))
    together = (last - np.arange(count) + 1 == size)[label]
    joined[1:] = together[1:] & (label[1:] == label[:-1])
    neighbours = second == first + 1
    joined[second[neighbours]] = True
    return (np.cumsum(~joined) - 1).astype(np.int32)


def half_edges(faces: np.ndarray) -> np.ndarray:
    """Return the three directed edges of each face, in order: (3F, 2)."""
    return np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)


def _edge_keys(edges: np.ndarray, position_ids: np.ndarray | None) -> Any:
    """Return a key for each undirected edge, and whether the edge joins two different points."""
    ends = edges if position_ids is None else position_ids[edges]
    ends = ends.astype(np.int64)
    low, high = ends.min(axis=1), ends.max(axis=1)
    return low * (high.max(initial=0) + 1) + high, low != high


def _hidden_edge_pairs(
    faces: np.ndarray, edge_visible: np.ndarray, position_ids: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return pairs of faces, first < second, that share an edge hidden in exactly these two."""
    hidden = np.flatnonzero(~edge_visible.ravel())
    keys, proper = _edge_keys(half_edges(faces)[hidden], position_ids)
    hidden, keys = hidden[proper], keys[proper]
    order = np.argsort(keys, kind="stable")
    keys, owner = keys[order], hidden[order] // 3
    starts = np.flatnonzero(np.r_[True, keys[1:] != keys[:-1]]) if len(keys) else keys
    run = np.diff(np.r_[starts, len(keys)])
    starts = starts[run == 2]
    first, second = owner[starts], owner[starts + 1]
    different = first != second
    return first[different], second[different]


def components(count: int, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Label connected faces with the smallest face of their component (hook and compress)."""
    label = np.arange(count)
    while True:
        a, b = label[first], label[second]
        apart = a != b
        if not apart.any():
            return label
        low, high = np.minimum(a, b)[apart], np.maximum(a, b)[apart]
        np.minimum.at(label, high, low)
        while True:
            shorter = label[label]
            if np.array_equal(shorter, label):
                break
            label = shorter

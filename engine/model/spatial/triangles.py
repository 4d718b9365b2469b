"""Intersection tests of triangles with boxes and spheres, many at once.

In: corners (N, 3, 3) float64. Out: (N,) bool. Sources: Akenine-Moeller 2001 (thirteen separating
axes), Ericson 2005 (closest point).
"""

from __future__ import annotations

import numpy as np

from ...base import linalg


def triangles_meet_box(corners: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return which triangles intersect a box; touching counts."""
    half = (high - low) * 0.5
    v = corners - (low + high) * 0.5
    edges = np.roll(v, -1, axis=1) - v
    meets = (v.min(axis=1) <= half).all(axis=1) & (v.max(axis=1) >= -half).all(axis=1)
    normal = linalg.cross(edges[:, 0], edges[:, 1])
    meets &= np.abs(linalg.dot(normal, v[:, 0])) <= linalg.dot(np.abs(normal), half)
    for edge in range(3):
        for axis in np.eye(3):
            across = linalg.cross(axis, edges[:, edge])
            shadow = linalg.dot(across[:, np.newaxis], v)
            reach = linalg.dot(np.abs(across), half)
            meets &= (shadow.min(axis=1) <= reach) & (shadow.max(axis=1) >= -reach)
    return meets


def sphere_meets_triangles(corners: np.ndarray, center: np.ndarray, radius: float) -> np.ndarray:
    """Return which triangles intersect a ball; touching counts."""
    nearest = closest_points(corners, center) - center
    return linalg.dot(nearest, nearest) <= radius * radius


def closest_points(corners: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return the point of each triangle that is closest to a given point, (N, 3).

    Inside the triangle's prism it is the projection onto the plane, elsewhere the closest point of
    the three edges.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = linalg.cross(b - a, c - a)
    square = linalg.dot(normal, normal)
    safe = np.where(square > 0.0, square, 1.0)
    height = linalg.dot(point - a, normal) / safe
    foot = point - normal * height[:, np.newaxis]
    inside = square > 0.0
    for start, end in ((a, b), (b, c), (c, a)):
        inside &= linalg.dot(linalg.cross(end - start, foot - start), normal) >= 0.0
    best = np.where(inside[:, np.newaxis], foot, a)
    least = np.where(inside, linalg.dot(foot - point, foot - point), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        way = end - start
        long = linalg.dot(way, way)
        share = linalg.dot(point - start, way) / np.where(long > 0.0, long, 1.0)
        on_edge = start + way * np.clip(share, 0.0, 1.0)[:, np.newaxis]
        apart = linalg.dot(on_edge - point, on_edge - point)
        best = np.where((apart < least)[:, np.newaxis], on_edge, best)
        least = np.minimum(least, apart)
    return best

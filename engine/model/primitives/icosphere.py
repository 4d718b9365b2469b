"""A sphere of nearly equal triangles, by subdivision of the icosahedron.

In: a radius and a number of subdivisions. Out: a mesh with smooth normals and a map's texture
coordinates: vertices on the seam and at the poles are there once for each side and wedge.
"""

from __future__ import annotations

import functools
import math

import numpy as np
import numpy.typing as npt

from ...base import linalg
from ..geometry.mesh import Mesh
from .arguments import integer, names_itself, positive

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.intp]

# 20 * 4**9 triangles are 5 million.
MAX_SUBDIVISIONS = 9
_MOST_KEPT = 5  # subdivisions of unit spheres that are computed once


@names_itself
def icosphere(radius: float = 0.5, subdivisions: int = 3) -> Mesh:
    """Return a sphere made from an icosahedron whose triangles are cut in four again and again.

    The texture is a map as on `uv_sphere`: its middle faces +Z, v grows from the south pole (-Y)
    to the north pole. On triangles across the seam u exceeds 1, for textures that repeat.

    Parameters
    ----------
    radius : float
    subdivisions : int
        From 0, the icosahedron, to 9.

    Returns
    -------
    Mesh
        ``20 * 4**subdivisions`` triangles, over ``10 * 4**subdivisions + 2`` different positions.

    Raises
    ------
    InvalidArgumentError
        If the radius isn't finite and greater than 0, or `subdivisions` is out of range.
    """
    radius = positive("radius", radius)
    count = integer("subdivisions", subdivisions, 0, MAX_SUBDIVISIONS)
    normals, faces, uvs, point_ids = (_kept_sphere if count <= _MOST_KEPT else _sphere)(count)
    return Mesh(
        normals * radius,
        faces,
        normals=normals,
        uvs=uvs,
        position_ids=point_ids,
        name="icosphere",
    )


def _sphere(
    subdivisions: int,
) -> tuple[FloatArray, npt.NDArray[np.int32], FloatArray, IntArray]:
    """Return the vertices of the unit sphere, its faces, texture coordinates, and point IDs."""
    points, faces = _icosahedron()
    for _ in range(subdivisions):
        points, faces = _subdivide(points, faces)
    corner_uvs = _corner_uvs(points, faces)
    # A vertex is a point together with its texture coordinates.
    corners = np.column_stack((faces.ravel(), corner_uvs.reshape(-1, 2)))
    vertices, index = np.unique(corners, axis=0, return_inverse=True)
    point_ids = vertices[:, 0].astype(np.intp)
    normals = points[point_ids]
    return (
        normals,
        index.reshape(-1, 3).astype(np.int32),
        vertices[:, 1:].astype(np.float64),
        point_ids,
    )


_kept_sphere = functools.cache(_sphere)


def _icosahedron() -> tuple[FloatArray, IntArray]:
    """Return its 12 unit points, two of them the poles, and its 20 faces."""
    height, distance = math.sqrt(0.2), math.sqrt(0.8)
    x, y = linalg.unit_circle(10)
    rings = np.stack((-y * distance, np.full(10, height), -x * distance), axis=1)
    rings[1::2, 1] = -height  # even corners of a decagon make the upper ring, odd ones the lower
    points = np.vstack(([(0.0, 1.0, 0.0)], rings, [(0.0, -1.0, 0.0)])) + 0.0
    faces = []
    for k in range(0, 10, 2):
        a, b, c, d = (1 + (k + offset) % 10 for offset in range(4))
        faces += [(0, a, c), (a, b, c), (b, d, c), (11, d, b)]
    return points, np.array(faces, np.intp)


def _subdivide(points: FloatArray, faces: IntArray) -> tuple[FloatArray, IntArray]:
    """Cut each triangle in four at the middles of its edges, and move those onto the sphere."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends, index = np.unique(edges, axis=0, return_inverse=True)
    middles = linalg.normalize(points[ends[:, 0]] + points[ends[:, 1]])
    ab, bc, ca = (len(points) + index.reshape(-1, 3)).T
    a, b, c = faces.T
    quarters = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    faces = np.stack([np.stack(corners, axis=1) for corners in quarters], axis=1)
    return np.vstack((points, middles)), faces.reshape(-1, 3)


def _corner_uvs(points: FloatArray, faces: IntArray) -> FloatArray:
    """Return the map coordinates of each corner of each face, shape (F, 3, 2)."""
    # From +Z eastward; the seam at -Z is u = 0 and u = 1.
    u = 0.5 + linalg.atan2(points[:, 0], points[:, 2]) / (2.0 * math.pi)
    beside_axis = np.sqrt(points[:, 0] * points[:, 0] + points[:, 2] * points[:, 2])
    v = 0.5 + linalg.atan2(points[:, 1], beside_axis) / math.pi
    u, v = u[faces], v[faces]
    pole = beside_axis[faces] == 0.0
    # A triangle spans less than half a turn: where it seems to span more it crosses the seam.
    largest = np.max(np.where(pole, 0.0, u), axis=1, keepdims=True)
    u = np.where(u < largest - 0.5, u + 1.0, u)
    others = np.sum(np.where(pole, 0.0, u), axis=1, keepdims=True)
    u = np.where(pole, 0.5 * others, u)
    return np.stack((u, v), axis=-1)

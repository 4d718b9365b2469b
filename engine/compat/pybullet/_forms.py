"""The shapes that TinyRenderer makes of spheres, boxes, cylinders, capsules and planes.

In: a kind and its sizes. Out: meshes, as Bullet's `btShapeHull` makes them: hulls of the points
that a shape has farthest in 42 directions, with normals that point away from the centre. So spheres
have 80 faces, and cylinders are a little slanted. Source: Bullet 3.2.7, btShapeHull.cpp and
TinyRendererVisualShapeConverter.cpp.
"""

from __future__ import annotations

import functools
import itertools

import numpy as np

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.textures import Texture
from ._files import plain_mesh, scaled_mesh, turned_texture

SPHERE, BOX, CYLINDER, MESH, PLANE, CAPSULE = 2, 3, 4, 5, 6, 7
#: Kinds that need no file.
MADE = (SPHERE, BOX, CYLINDER, PLANE, CAPSULE)
_SIDES = 32
# Bullet's collision margin, which the points of cylinders and capsules are moved outwards by.
_MARGIN = 0.001
# Of the extent of points: how far apart they still lie in one plane.
_FLAT = 1e-5
_HALF_PLANE = 128.0
# Of each side of a box: its axis and direction, and texture coordinates in quarters, of the corners
# (-, -), (+, -), (+, +), (-, +) of the two axes that follow.
_BOX_SIDES = (
    (2, 1, ((3, 1), (4, 1), (4, 0), (3, 0))),
    (2, -1, ((2, 1), (1, 1), (1, 0), (2, 0))),
    (0, -1, ((2, 0), (3, 0), (3, 1), (2, 1))),
    (0, 1, ((1, 2), (1, 1), (0, 1), (0, 2))),
    (1, -1, ((1, 2), (1, 1), (2, 1), (2, 2))),
    (1, 1, ((0, 0), (0, 1), (1, 1), (1, 0))),
)
_BLUE, _WHITE = (173, 199, 255, 255), (255, 255, 255, 255)


def made_form(kind: int, sizes: tuple[float, ...]) -> Mesh:
    """Return the mesh of a shape in its own coordinates, without a material.

    Parameters
    ----------
    kind : int
        One of `MADE`.
    sizes : tuple of 3 float
        As in pybullet's visual shape data: of a box its edges, of a sphere its radius, of others
        length and radius.
    """
    if kind == PLANE:
        return _plane()
    return scaled_mesh(_box(), sizes) if kind == BOX else _hull(kind, sizes)


@functools.cache
def _box() -> Mesh:
    """Return the box of size 1 that shows a texture as a net of its sides."""
    corners, normals, uvs = [], [], []
    for axis, side, turns in _BOX_SIDES:
        ring = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        for (across, along), uv in zip(ring, turns, strict=True):
            corner = np.empty(3)
            corner[axis], corner[axis - 2], corner[axis - 1] = side, across, along
            corners.append(0.5 * corner)
            normals.append(np.eye(3)[axis] * side)
            uvs.append(np.array(uv) / 4.0)
    faces = []
    for first, (_, side, _) in zip(range(0, 24, 4), _BOX_SIDES, strict=True):
        quad = [first, first + 1, first + 2, first + 3][::side]
        faces += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return plain_mesh(corners, faces, normals, uvs)


@functools.lru_cache(maxsize=256)
def _hull(kind: int, sizes: tuple[float, ...]) -> Mesh:
    ways = _directions()
    if kind == SPHERE:
        points = ways * sizes[0]
    else:
        rim = _rim(kind, *sizes[:2])
        far = (ways[:, np.newaxis] * rim).sum(axis=2).argmax(axis=1)
        points = rim[far] + ways * _MARGIN
    faces = hull_faces(points)
    normals = points / np.maximum(linalg.length(points), 1e-30)[:, np.newaxis]
    around = linalg.atan2(normals[:, 0], normals[:, 2]) / (2.0 * np.pi) + 0.5
    uvs = np.stack([around, normals[:, 1] * 0.5 + 0.5], axis=1)
    return plain_mesh(points, faces, normals, uvs)


def _rim(kind: int, length: float, radius: float) -> np.ndarray:
    """Return the corners of a cylinder or capsule about z, (N, 3)."""
    cos, sin = linalg.unit_circle(_SIDES)
    ends = np.repeat([[0.5 * length, -0.5 * length]], _SIDES, axis=0)
    ring = np.stack([np.repeat(radius * sin, 2), np.repeat(radius * cos, 2), ends.ravel()], axis=1)
    if kind == CYLINDER:
        return ring
    pole = 0.5 * length + radius
    return np.vstack([ring, [(0.0, 0.0, pole), (0.0, 0.0, -pole)]])


@functools.cache
def _directions() -> np.ndarray:
    """Return the corners of an icosahedron about z and the middles of its edges, (42, 3)."""
    cos, sin = linalg.unit_circle(10)
    height = 1.0 / np.sqrt(5.0)
    upper = np.stack([2.0 * height * cos[::2], 2.0 * height * sin[::2], np.full(5, height)], axis=1)
    poles = np.array([(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)])
    corners = np.vstack([poles, upper, -upper])
    near = [
        first + second
        for first, second in itertools.combinations(corners, 2)
        if linalg.dot(first, second) > 0.0
    ]
    return np.vstack([corners, linalg.normalize(np.array(near))])


def hull_faces(points: np.ndarray) -> np.ndarray:
    """Return the triangles of the convex hull of a few points, (N, 3) int, outsides
    counter-clockwise.

    Each plane through three points that has all others on one side is a face; the points in it,
    in the order around it, are cut into a fan.
    """
    size = float((points.max(axis=0) - points.min(axis=0)).max()) or 1.0
    triples = np.array(list(itertools.combinations(range(len(points)), 3)))
    first, second, third = (points[triples[:, k]] / size for k in range(3))
    normals = linalg.cross(second - first, third - first)
    sound = linalg.length(normals) > 1e-9
    normals, first = linalg.normalize(normals[sound]), first[sound]
    heights = _dots(normals, points / size) - linalg.dot(normals, first)[:, np.newaxis]
    outside = np.where((heights <= _FLAT).all(axis=1), 1.0, 0.0)
    outside -= (heights >= -_FLAT).all(axis=1) & (outside == 0.0)
    kept = outside != 0.0
    flat = np.abs(heights[kept]) <= _FLAT
    _, chosen = np.unique(flat, axis=0, return_index=True)
    normals = (normals[kept] * outside[kept][:, np.newaxis])[chosen]
    faces = []
    for inside, normal in zip(flat[chosen], normals, strict=True):
        ring = _around(np.flatnonzero(inside), points, normal)
        faces += [(ring[0], one, two) for one, two in itertools.pairwise(ring[1:])]
    return np.array(faces, np.int32).reshape(-1, 3)


def _dots(normals: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the product of each normal with each point, (N, M)."""
    total = normals[:, :1] * points[:, 0]
    for axis in (1, 2):
        total = total + normals[:, axis : axis + 1] * points[:, axis]
    return total


def _around(numbers: np.ndarray, points: np.ndarray, normal: np.ndarray) -> list[int]:
    """Return the points of a plane in the order around it, seen from outside."""
    away = points[numbers] - points[numbers].mean(axis=0)
    across = away[0]
    along = linalg.cross(normal, across)
    angles = linalg.atan2(linalg.dot(away, along), linalg.dot(away, across))
    return numbers[np.argsort(angles, kind="stable")].tolist()


@functools.cache
def _plane() -> Mesh:
    """Return the square that TinyRenderer draws for a plane, whatever its normal."""
    far = _HALF_PLANE
    corners = [(far, -far, 0.0), (far, far, 0.0), (-far, far, 0.0), (-far, -far, 0.0)]
    uvs = [(far, far), (0.0, far), (0.0, 0.0), (far, 0.0)]
    return plain_mesh(corners, [(0, 1, 2), (0, 2, 3)], [(0.0, 0.0, 1.0)] * 4, uvs)


@functools.cache
def checks() -> Texture:
    """Return the texture of planes: two by two checks for each unit of texture coordinates."""
    pixels = np.array([[_BLUE, _WHITE], [_WHITE, _BLUE]], np.uint8)
    return turned_texture(pixels)

"""Pieces of surface from which the models are put together.

In: grids of points, profiles, outlines. Out: `Surface`: polygons over vertices with normals and
texture coordinates, counter-clockwise seen from outside. A grid's columns run to the right and its
rows upwards as seen from outside.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from engine3d import linalg


@dataclass
class Surface:
    """Polygons with their vertices: positions (N, 3), normals (N, 3), uvs (N, 2)."""

    positions: np.ndarray
    uvs: np.ndarray
    polygons: list
    normals: np.ndarray = None
    material: str = ""
    name: str = ""

    def __post_init__(self):
        self.positions = np.asarray(self.positions, np.float64)
        self.uvs = np.asarray(self.uvs, np.float64)
        if self.normals is None:
            self.normals = smooth_normals(self.positions, self.polygons)

    def moved(self, matrix):
        """Return the surface under an affine matrix; a reflection turns the polygons round."""
        mirrored = linalg.dot(linalg.cross(matrix[:3, 0], matrix[:3, 1]), matrix[:3, 2]) < 0.0
        normals = linalg.normalize(
            linalg.transform_directions(_square(linalg.normal_matrix(matrix)), self.normals)
        )
        return Surface(
            linalg.transform_points(matrix, self.positions),
            self.uvs,
            [p[::-1] for p in self.polygons] if mirrored else self.polygons,
            normals,
            self.material,
            self.name,
        )

    def labelled(self, material, name=""):
        """Return the same surface with a material, and a name if one is given."""
        return Surface(
            self.positions, self.uvs, self.polygons, self.normals, material, name or self.name
        )

    def without(self, vertices):
        """Return the surface without the polygons all of whose corners are in a mask."""
        kept = [p for p in self.polygons if not all(vertices[k] for k in p)]
        return _compact(self.positions, self.uvs, kept, self.normals)

    def creased(self):
        """Return the surface with normals that are smooth along rows only, for turned profiles.

        Each row of quads gets its own vertices, so that the edges of the profile show.
        """
        rows = {}
        for polygon in self.polygons:
            heights = tuple(
                sorted({tuple(np.round(_level(self.positions[k]), 5)) for k in polygon})
            )
            rows.setdefault(heights, []).append(polygon)
        positions, uvs, polygons, normals = [], [], [], []
        for row in rows.values():
            part = _compact(self.positions, self.uvs, row, None)
            polygons += [tuple(k + len(positions) for k in polygon) for polygon in part.polygons]
            positions.extend(part.positions)
            uvs.extend(part.uvs)
            normals.extend(part.normals)
        return Surface(
            np.array(positions),
            np.array(uvs),
            polygons,
            np.array(normals),
            self.material,
            self.name,
        )

    def flat(self):
        """Return the surface with one normal a polygon."""
        positions, uvs, normals, polygons = [], [], [], []
        for polygon in self.polygons:
            corners = self.positions[list(polygon)]
            normal = _polygon_normal(corners)
            polygons.append(tuple(range(len(positions), len(positions) + len(corners))))
            positions.extend(corners)
            uvs.extend(self.uvs[list(polygon)])
            normals.extend([linalg.normalize(normal)] * len(corners))
        return Surface(
            np.array(positions),
            np.array(uvs),
            polygons,
            np.array(normals),
            self.material,
            self.name,
        )


def _level(point):
    """Radius and height of a point about the Y axis, rounded."""
    radius = math.sqrt(point[0] * point[0] + point[2] * point[2])
    return round(radius, 5), round(float(point[1]), 5)


def _square(matrix):
    result = np.eye(4)
    result[:3, :3] = matrix
    return result


def _polygon_normal(corners):
    """Return the vector area of a polygon (Newell's formula)."""
    area = np.zeros(3)
    for k in range(len(corners)):
        area = area + linalg.cross(corners[k - 1], corners[k])
    return 0.5 * area


def smooth_normals(positions, polygons):
    """Average the polygons' vector areas at each position; seams of the texture don't show."""
    _, group = np.unique(np.round(positions, 7), axis=0, return_inverse=True)
    group = group.reshape(-1)
    total = np.zeros((len(positions), 3))
    for polygon in polygons:
        area = _polygon_normal(positions[list(polygon)])
        for vertex in polygon:
            total[group[vertex]] += area
    return linalg.normalize(total[group])


def grid(points, uvs, normals=None):
    """Return the quads of a grid of points, shape (rows, columns, 3).

    Where two neighbours coincide, as at a pole, the quad becomes a triangle whose vertex there gets
    the mean of their texture coordinates.
    """
    points = np.asarray(points, np.float64)
    rows, columns = points.shape[:2]
    positions = list(points.reshape(-1, 3))
    coordinates = list(np.broadcast_to(uvs, (rows, columns, 2)).reshape(-1, 2))
    directions = None if normals is None else list(np.asarray(normals).reshape(-1, 3))
    same = np.all(np.abs(points[:, 1:] - points[:, :-1]) < 1e-9, axis=2)
    polygons = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a = i * columns + j
            corners = [a, a + 1, a + columns + 1, a + columns]
            for row, pair in ((i, (0, 1)), (i + 1, (2, 3))):
                if not same[row, j]:
                    continue
                first, second = corners[pair[0]], corners[pair[1]]
                positions.append(positions[first])
                coordinates.append(0.5 * (coordinates[first] + coordinates[second]))
                if directions is not None:
                    directions.append(directions[first])
                corners[pair[0]] = len(positions) - 1
                corners[pair[1]] = None
            corners = [corner for corner in corners if corner is not None]
            if len(corners) > 2:
                polygons.append(tuple(corners))
    return _compact(positions, coordinates, polygons, directions)


def _compact(positions, uvs, polygons, normals):
    """Drop the vertices that no polygon uses."""
    used = sorted({vertex for polygon in polygons for vertex in polygon})
    renamed = {vertex: k for k, vertex in enumerate(used)}
    return Surface(
        np.array(positions)[used],
        np.array(uvs)[used],
        [tuple(renamed[vertex] for vertex in polygon) for polygon in polygons],
        None if normals is None else np.array(normals)[used],
    )


def closed_circle(count):
    """Return sines and cosines of `count` + 1 directions, the last equal to the first."""
    x, y = linalg.unit_circle(count)
    return np.append(x, x[0]), np.append(y, y[0])


def lathe(profile, columns, uv_box=(0.0, 0.0, 1.0, 1.0)):
    """Turn a profile, points (radius, y) from bottom to top, about the Y axis.

    `uv_box` is (u0, v0, u1, v1); v follows the length of the profile.
    """
    profile = np.asarray(profile, np.float64)
    x, y = closed_circle(columns)
    radius, height = profile[:, :1], profile[:, 1:]
    # Eastward seen from above, starting at the back.
    points = np.stack((-radius * y, height + 0.0 * x, -radius * x), axis=-1)
    u0, v0, u1, v1 = uv_box
    u = u0 + (u1 - u0) * np.arange(columns + 1) / columns
    v = v0 + (v1 - v0) * arc_parameters(profile)
    return grid(points, np.stack(np.broadcast_arrays(u, v[:, np.newaxis]), axis=-1))


def arc_parameters(points):
    """Return the running length along a polyline, from 0 to 1."""
    steps = points[1:] - points[:-1]
    lengths = [math.sqrt(sum(x * x for x in step)) for step in steps.tolist()]
    running = np.array([0.0, *itertools.accumulate(lengths)])
    return running / running[-1]


def box(size, centre=(0.0, 0.0, 0.0), uv_box=(0.0, 0.0, 1.0, 1.0)):
    """Return a box with the same part of the texture on all of its sides."""
    u0, v0, u1, v1 = uv_box
    corner = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * 0.5
    positions, normals, uvs, polygons = [], [], [], []
    for axis in range(3):
        for sign in (1.0, -1.0):
            first, second = ((axis + 1) % 3, (axis + 2) % 3)
            start = len(positions)
            for a, b in corner if sign > 0.0 else corner[::-1]:
                point = np.zeros(3)
                point[axis], point[first], point[second] = 0.5 * sign, a, b
                positions.append(point * size + centre)
                normals.append(np.eye(3)[axis] * sign)
                uvs.append((u0 + (u1 - u0) * (a + 0.5), v0 + (v1 - v0) * (b + 0.5)))
            polygons.append(tuple(range(start, start + 4)))
    return Surface(np.array(positions), np.array(uvs), polygons, np.array(normals))

"""Triangles in 64 bits, and the raster kernels' view of them.

In:  snapped corners in 1/256 sample, the viewport's size, the tile's first sample. Out: what a
     triangle covers by R10 and R12, its `PIECE` in a tile, and what its `RECORD` says.
"""

import numpy as np
from kernels import layouts
from kernels.layouts import PIECE, TILE


class Triangle:
    """A snapped triangle of positive area, its edge functions (R12) and its sample box (R10)."""

    def __init__(self, x, y, width, height):
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        order = [0, 1, 2] if area > 0 else [0, 2, 1]
        self.area = abs(area)
        self.x, self.y = x[order], y[order]
        next_one, last = [1, 2, 0], [2, 0, 1]
        self.a = self.y[next_one] - self.y[last]
        self.b = self.x[last] - self.x[next_one]
        self.top_left = (self.a > 0) | ((self.a == 0) & (self.b > 0))
        self.left, self.right = self._range(self.x, width)
        self.top, self.bottom = self._range(self.y, height)

    @staticmethod
    def _range(values, size):
        first = max(-((128 - int(values.min())) // 256), 0)
        return first, min((int(values.max()) - 128) // 256, size - 1)

    @property
    def empty(self):
        return self.area == 0 or self.left > self.right or self.top > self.bottom

    def edges_at(self, column, row):
        """(3, …) int64: edge functions at the centres of samples."""
        shape = (3,) + (1,) * np.ndim(column)
        corners = [1, 2, 0]
        x, y = (256 * np.asarray(v, np.int64) + 128 for v in (column, row))
        a, b = self.a.reshape(shape), self.b.reshape(shape)
        return a * (x - self.x[corners].reshape(shape)) + b * (y - self.y[corners].reshape(shape))

    def covers(self, column, row):
        edges = self.edges_at(column, row)
        rule = self.top_left.reshape((3,) + (1,) * np.ndim(column))
        return ((edges > 0) | ((edges == 0) & rule)).all(axis=0)


def piece_of(triangle, tile_x, tile_y):
    """The kernel's view of a triangle in a tile, or None where an edge rejects the tile."""
    piece = np.zeros(1, PIECE)
    first = triangle.edges_at(tile_x, tile_y) - ~triangle.top_left
    span = TILE - 1
    for k in range(3):
        e, a, b = int(first[k]) >> 8, int(triangle.a[k]), int(triangle.b[k])
        if e + span * (max(a, 0) + max(b, 0)) < 0:
            return None
        if e + span * (min(a, 0) + min(b, 0)) < 0:
            piece["e"][0, k], piece["a"][0, k], piece["b"][0, k] = e, a, b
    piece["x0"], piece["x1"] = np.clip([triangle.left - tile_x, triangle.right - tile_x], 0, span)
    piece["y0"], piece["y1"] = np.clip([triangle.top - tile_y, triangle.bottom - tile_y], 0, span)
    piece["base_x"], piece["base_y"] = triangle.left - tile_x, triangle.top - tile_y
    return piece


def plane_through(triangle, zn):
    """R13 of depths at the corners: z0, gx, gy."""
    x, y, zn = triangle.x.astype(float), triangle.y.astype(float), zn.astype(float)
    ax, ay, cx, cy = x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]
    d1, d2, r = zn[1] - zn[0], zn[2] - zn[0], 256 / float(triangle.area)
    gx, gy = (d1 * cy - d2 * ay) * r, (d2 * ax - d1 * cx) * r
    ex, ey = (
        (256 * first + 128 - v) / 256 for first, v in ((triangle.left, x[0]), (triangle.top, y[0]))
    )
    return (zn[0] + ex * gx) + ey * gy, gx, gy


def meta_of(triangle):
    """The flags of a face's record, with the cover of a tiny one; None where it has no cover."""
    meta = layouts.RECORD_FACE
    if triangle.right - triangle.left > 1 or triangle.bottom - triangle.top > 1:
        return meta
    cover = 0
    for row in range(triangle.top, triangle.bottom + 1):
        for column in range(triangle.left, triangle.right + 1):
            bit = 2 * (row - triangle.top) + column - triangle.left
            cover |= int(triangle.covers(column, row)) << bit
    sides = max(np.ptp(triangle.x), np.ptp(triangle.y))
    if sides > 32767:
        return meta
    return meta | layouts.RECORD_TINY | cover << layouts.RECORD_SHIFT if cover else None

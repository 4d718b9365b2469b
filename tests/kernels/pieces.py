"""Triangles in 64 bits, and the raster kernels' view of them in a tile.

In:  snapped corners in 1/256 sample, the viewport's size, the tile's first sample. Out: what a
     triangle covers by R10 and R12, and its `PIECE`, prepared as the pipeline does.
"""

import numpy as np
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

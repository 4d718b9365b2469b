"""From data to pixels and depth, by mplot3d's own matrix.

In: axes, and the pixels that the picture takes. Out: places on the screen: x and y in pixels from
the picture's top left corner, and a depth between -1 (near) and 1 (far), which is linear on the
screen. The matrix is multiplied out element by element, so that no library for linear algebra
decides on bits.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

_SHOWN = 0.9  # depths of data lie within: what is drawn nearer than data has room, too
_LEAST_W = 1e-3  # of the greatest: what is nearer to the eye is left out
_BITS = 40.0  # that are kept of the matrix: what processors compute differently is below


class Region(NamedTuple):
    """Pixels of the canvas, counted from its lower left corner."""

    left: int
    bottom: int
    width: int
    height: int


class View:
    """How axes look at their data."""

    def __init__(self, axes, region: Region, low: np.ndarray, high: np.ndarray) -> None:
        self.region = region
        self.points_to_pixels = axes.get_figure(root=True).dpi / 72.0
        self._axes = axes
        matrix = _steady(axes.get_proj())
        origin, right, up = axes.transData.transform([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
        x = (right[0] - origin[0]) * matrix[0] + (origin[0] - region.left) * matrix[3]
        y = (up[1] - origin[1]) * matrix[1] + (origin[1] - region.bottom) * matrix[3]
        self._rows = _steady(np.array([x, region.height * matrix[3] - y, matrix[2], matrix[3]]))
        self._fit_depths(low, high)

    def _fit_depths(self, low: np.ndarray, high: np.ndarray) -> None:
        """Choose how depths are counted from the box of the data."""
        ends = np.array([low, high])
        corners = np.array(
            [[ends[i, 0], ends[j, 1], ends[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        )
        _, _, z, w = self._multiply(self._scaled(corners))
        self._least_w = max(float(np.max(w)), 1e-300) * _LEAST_W
        # Of what lies behind the eye, nothing is seen.
        depths = np.where(w > self._least_w, z, z[np.argmax(w)]) / np.maximum(w, self._least_w)
        near, far = float(depths.min()), float(depths.max())
        span = far - near if far > near else max(abs(far), 1.0) * 1e-6
        self._scale = 2.0 * _SHOWN / span
        self._middle = 0.5 * (near + far)
        self.span = 2.0 * _SHOWN

    def _scaled(self, points: np.ndarray) -> list[np.ndarray]:
        """Return the coordinates after the axes' scales, such as logarithms."""
        scaled = []
        for k, axis in enumerate((self._axes.xaxis, self._axes.yaxis, self._axes.zaxis)):
            values = points[..., k]
            if axis.get_scale() != "linear":
                with np.errstate(all="ignore"):
                    values = axis.get_transform().transform(values.ravel()).reshape(values.shape)
            scaled.append(values)
        return scaled

    def _multiply(self, xyz: list[np.ndarray]) -> list[np.ndarray]:
        x, y, z = xyz
        return [row[0] * x + row[1] * y + row[2] * z + row[3] for row in self._rows]

    def screen(self, points: np.ndarray) -> np.ndarray:
        """Return places on the screen.

        Parameters
        ----------
        points : (..., 3) float
            In data coordinates.

        Returns
        -------
        places : (..., 3) float64
            Not a number for what is not finite or not before the eye.
        """
        x, y, z, w = self._multiply(self._scaled(points))
        with np.errstate(all="ignore"):
            w[~(w > self._least_w)] = np.nan
            out = np.empty((*x.shape, 3))
            np.divide(x, w, out=out[..., 0])
            np.divide(y, w, out=out[..., 1])
            z /= w
            z -= self._middle
            np.multiply(z, self._scale, out=out[..., 2])
        return out

    def clip(self, places: np.ndarray, out: np.ndarray, nearer: float) -> None:
        """Write clip coordinates, (N, 4), of places on the screen, (N, 3), by so much nearer."""
        with np.errstate(over="ignore", invalid="ignore"):
            out[:, 0] = places[:, 0] * (2.0 / self.region.width) - 1.0
            out[:, 1] = 1.0 - places[:, 1] * (2.0 / self.region.height)
            out[:, 2] = places[:, 2] - nearer
        out[:, 3] = 1.0


def _steady(matrix: np.ndarray) -> np.ndarray:
    """Return the matrix with fewer bits: sines and products of NumPy differ between processors."""
    mantissas, exponents = np.frexp(matrix)
    return np.ldexp(np.rint(np.ldexp(mantissas, int(_BITS))), exponents - int(_BITS))

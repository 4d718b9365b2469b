"""The unified and the double-sphere camera model, in closed form both ways.

In: a direction. Out: its pixel: the direction is projected to a sphere, from there to a second one,
and from there to the picture. Source: Usenko, Demmel and Cremers 2018, "The double sphere camera
model", equations 40 to 51; with xi = 0 it is the unified model of Mei and Rives in the form of
Khomutenko.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ....base.validation import CheckedAttribute, NumberAttribute, finite, fraction
from .lens_camera import CalibratedCamera

Floats = NDArray[np.float64]


class DoubleSphereCamera(CalibratedCamera):
    """A wide camera after the double-sphere model, as calibrated by Basalt and Kalibr.

    Parameters
    ----------
    fx, fy, cx, cy : float
        In pixels; the centre of the top left pixel is (0.5, 0.5).
    xi : float
        The distance of the two spheres, from -1 to 1; 0 is the unified model.
    alpha : float
        The share of the second sphere, from 0 to 1; with 0 the camera is a pinhole camera.
    znear, zfar : float
        As for `PerspectiveCamera`, but along the axes of the cube around the camera.

    Attributes
    ----------
    depth_along : "ray"
        ``frame.depth`` is the distance from the camera.

    Raises
    ------
    InvalidArgumentError
    """

    depth_along: ClassVar = "ray"

    def __init__(
        self,
        fx: float,
        fy: float,
        cx: float,
        cy: float,
        xi: float = 0.0,
        alpha: float = 0.5,
        *,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self._set_pixels(fx, fy, cx, cy)
        self.xi, self.alpha = xi, alpha
        self._set_range(znear, zfar)

    xi: NumberAttribute = CheckedAttribute(lambda value, what: _within_one(value, what))
    alpha: NumberAttribute = CheckedAttribute(fraction)

    def _pinhole(self, size: tuple[int, int]) -> tuple[float, float, float, float]:
        scale = 1.0 / (self.alpha * abs(1.0 + self.xi) + (1.0 - self.alpha) * (1.0 + self.xi))
        return self.fx * scale, self.fy * scale, self.cx, self.cy

    def _pixels_of(self, x: Floats, y: Floats, z: Floats, size: tuple[int, int]) -> object:
        alpha, xi = self.alpha, self.xi
        first = np.sqrt(x * x + y * y + z * z)
        ahead = xi * first + z
        second = np.sqrt(x * x + y * y + ahead * ahead)
        below = alpha * second + (1.0 - alpha) * ahead
        seen = (z > -_widest(alpha, xi) * first) & (below > 0.0)
        scale = np.where(seen, 1.0 / below, np.nan)
        return self.fx * (x * scale) + self.cx, self.fy * (y * scale) + self.cy

    def _directions_of(self, u: Floats, v: Floats, size: tuple[int, int]) -> object:
        alpha, xi = self.alpha, self.xi
        x, y = self._normalized(u, v)
        t = x * x + y * y
        root = 1.0 - (2.0 * alpha - 1.0) * t
        z = (1.0 - alpha * alpha * t) / (alpha * np.sqrt(root) + (1.0 - alpha))
        scale = (z * xi + np.sqrt(z * z + (1.0 - xi * xi) * t)) / (z * z + t)
        ahead = scale * z - xi
        seen = ahead > -_widest(alpha, xi)
        return x * scale, y * scale, np.where(seen, ahead, np.nan)


def _widest(alpha: float, xi: float) -> float:
    share = alpha / (1.0 - alpha) if alpha <= 0.5 else (1.0 - alpha) / alpha
    return float((share + xi) / np.sqrt(2.0 * share * xi + xi * xi + 1.0))


def _within_one(value: float, what: str) -> float:
    from ....base.numbers import shown
    from ....errors import InvalidArgumentError

    if not -1.0 < finite(value, what) < 1.0:
        raise InvalidArgumentError(f"{what} must be between -1 and 1, not {shown(value)}")
    return float(value)

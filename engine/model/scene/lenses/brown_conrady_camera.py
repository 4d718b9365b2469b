"""Pinhole cameras with the distortion of Brown and Conrady, as OpenCV's ``calibrateCamera`` has it.

In: a point on the plane z = 1. Out: the point that the lens makes of it: a rational polynomial of
the radius, decentering, and a thin prism. Sources: Brown 1966, "Decentering distortion of lenses";
Claus and Fitzgibbon 2005 (rational); the order of coefficients is OpenCV's.
"""

from __future__ import annotations

import functools
import math
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base import linalg
from ....base.validation import CheckedAttribute
from .lens_camera import CalibratedCamera, coefficients, of_matrix
from .radial_curves import RisingCurve

Floats = NDArray[np.float64]
_GRID = 4096
_WIDEST = math.radians(89.0)  # from the axis: farther out, no plane shows what a lens sees
_STEPS = 8
_CLOSE = 1e-12
_coefficients = coefficients((4, 5, 8, 12))


class BrownConradyCamera(CalibratedCamera):
    """A pinhole camera whose lens distorts, as calibrated by ``cv2.calibrateCamera``.

    Parameters
    ----------
    fx, fy : float
        Focal lengths in pixels.
    cx, cy : float
        Principal point in pixels from the picture's left and top edges. The centre of the top left
        pixel is (0.5, 0.5): add 0.5 to values from OpenCV, or use `from_opencv`.
    distortion : (4,), (5,), (8,) or (12,) sequence of float
        The coefficients in OpenCV's order: k1, k2, p1, p2, then k3, then k4, k5, k6 (the rational
        model), then s1 to s4 (the thin prism).
    znear, zfar : float
        As for `PerspectiveCamera`.

    Attributes
    ----------
    depth_along : "axis"
        ``frame.depth`` is the distance along the axis, as with a pinhole camera.

    Raises
    ------
    InvalidArgumentError
    """

    depth_along: ClassVar = "axis"

    def __init__(
        self,
        fx: float,
        fy: float,
        cx: float,
        cy: float,
        distortion: ArrayLike = (0.0, 0.0, 0.0, 0.0, 0.0),
        *,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self._set_pixels(fx, fy, cx, cy)
        self.distortion = distortion
        self._set_range(znear, zfar)

    distortion: CheckedAttribute[ArrayLike, tuple[float, ...]] = CheckedAttribute(_coefficients)

    @classmethod
    def from_opencv(
        cls,
        K: ArrayLike,
        D: ArrayLike = (0.0, 0.0, 0.0, 0.0, 0.0),
        *,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> BrownConradyCamera:
        """Return the camera of OpenCV's matrix K and distortion coefficients D.

        Parameters
        ----------
        K : (3, 3) float
            Its pixel centres are whole numbers, as OpenCV's are.
        D : (4,), (5,), (8,) or (12,) float
        znear, zfar : float

        Raises
        ------
        InvalidArgumentError
            K has skew, D has the 14 coefficients of a tilted sensor, or a number is wrong.
        """
        return cls(*of_matrix(K), distortion=_coefficients(D, "D"), znear=znear, zfar=zfar)

    def _all(self) -> tuple[float, ...]:
        return (*self.distortion, *(0.0,) * (12 - len(self.distortion)))

    def _pixels_of(self, x: Floats, y: Floats, z: Floats, size: tuple[int, int]) -> object:
        before, d = z > 0.0, self._all()
        a, b = x / z, y / z
        seen = before & (np.sqrt(a * a + b * b) <= _curve_of(d).end)
        (ux, uy), (vx, vy) = _slopes(a, b, d)
        seen &= ux * vy - uy * vx > 0.0
        u, v = _distorted(a, b, d)
        return np.where(seen, self.fx * u + self.cx, np.nan), np.where(
            seen, self.fy * v + self.cy, np.nan
        )

    def _directions_of(self, u: Floats, v: Floats, size: tuple[int, int]) -> object:
        x, y = _undistorted(*self._normalized(u, v), self._all())
        return x, y, np.where(np.isfinite(x), 1.0, np.nan)

    def _limit(self, size: tuple[int, int]) -> str:
        curve = _curve_of(self._all())
        if not curve.turns:
            return ""
        angle, radius = math.degrees(math.atan(curve.end)), self.fx * curve.top
        return f"its radius turns back at {angle:.4g} degrees from the axis ({radius:.4g} pixels)"


def _radial(t: Floats, d: tuple[float, ...]) -> tuple[Floats, Floats]:
    """Return the factor of the radius at its square t, and the factor's derivative by t."""
    k1, k2, _, _, k3, k4, k5, k6 = d[:8]
    above = 1.0 + t * (k1 + t * (k2 + t * k3))
    below = 1.0 + t * (k4 + t * (k5 + t * k6))
    factor = above / np.where(below > 0.0, below, np.nan)
    rise = (k1 + t * (2.0 * k2 + t * (3.0 * k3))) - factor * (k4 + t * (2.0 * k5 + t * (3.0 * k6)))
    return factor, rise / below


def _distorted(x: Floats, y: Floats, d: tuple[float, ...]) -> tuple[Floats, Floats]:
    _, _, p1, p2, *_, s1, s2, s3, s4 = d
    t, xy = x * x + y * y, 2.0 * x * y
    factor, _ = _radial(t, d)
    u = x * factor + p1 * xy + p2 * (t + 2.0 * x * x) + t * (s1 + t * s2)
    v = y * factor + p1 * (t + 2.0 * y * y) + p2 * xy + t * (s3 + t * s4)
    return u, v


def _slopes(x: Floats, y: Floats, d: tuple[float, ...]) -> Any:
    """Return the derivatives of both distorted coordinates by x and y."""
    _, _, p1, p2, *_, s1, s2, s3, s4 = d
    t = x * x + y * y
    factor, rise = _radial(t, d)
    prism_u, prism_v = 2.0 * (s1 + 2.0 * s2 * t), 2.0 * (s3 + 2.0 * s4 * t)
    both = 2.0 * x * y * rise + 2.0 * p1 * x + 2.0 * p2 * y
    ux = factor + 2.0 * x * x * rise + 2.0 * p1 * y + 6.0 * p2 * x + prism_u * x
    vy = factor + 2.0 * y * y * rise + 6.0 * p1 * y + 2.0 * p2 * x + prism_v * y
    return (ux, both + prism_u * y), (both + prism_v * x, vy)


def _undistorted(u: Floats, v: Floats, d: tuple[float, ...]) -> tuple[Floats, Floats]:
    """Return the points that the lens distorts to (u, v), by Newton's method; NaN for none."""
    curve, radius = _curve_of(d), np.sqrt(u * u + v * v)
    start = curve.inverse(np.minimum(radius, curve.top))
    scale = np.where(radius > 0.0, start / np.where(radius > 0.0, radius, 1.0), 1.0)
    x, y = u * scale, v * scale
    for _ in range(_STEPS):
        at_u, at_v = _distorted(x, y, d)
        (ux, uy), (vx, vy) = _slopes(x, y, d)
        determinant, left, down = ux * vy - uy * vx, at_u - u, at_v - v
        x = x - (left * vy - down * uy) / determinant
        y = y - (down * ux - left * vx) / determinant
    at_u, at_v = _distorted(x, y, d)
    miss = np.abs(at_u - u) + np.abs(at_v - v)
    good = (miss <= _CLOSE * (1.0 + radius)) & (np.sqrt(x * x + y * y) <= curve.end)
    good &= determinant > 0.0
    return np.where(good, x, np.nan), np.where(good, y, np.nan)


@functools.lru_cache(64)
def _curve_of(d: tuple[float, ...]) -> RisingCurve:
    def value(radius: Floats) -> Floats:
        return radius * _radial(radius * radius, d)[0]

    def slope(radius: Floats) -> Floats:
        t = radius * radius
        factor, rise = _radial(t, d)
        return factor + 2.0 * t * rise

    return RisingCurve(value, slope, linalg.tan(np.arange(_GRID + 1) * (_WIDEST / _GRID)))

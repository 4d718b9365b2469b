"""Fisheyes after Kannala and Brandt, as OpenCV's module ``fisheye`` has them.

In: an angle from the axis. Out: the radius in the picture, an odd polynomial of the angle. Source:
Kannala and Brandt 2006, "A generic camera model and calibration method for conventional,
wide-angle, and fish-eye lenses", with the four coefficients of ``cv2.fisheye``.
"""

from __future__ import annotations

import functools
import math
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base import linalg
from ....base.validation import CheckedAttribute
from .lens_camera import CalibratedCamera, angle_up_to, coefficients, of_matrix
from .radial_curves import RisingCurve

Floats = NDArray[np.float64]
_GRID = 4096
_four = coefficients((4,))


class FisheyeCamera(CalibratedCamera):
    """A fisheye camera after Kannala and Brandt, as calibrated by ``cv2.fisheye``.

    A ray at the angle t from the axis meets the picture at the radius
    ``t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8)``, times the focal length. Without coefficients, the
    lens is equidistant. It may see more than half of all directions.

    Parameters
    ----------
    fx, fy : float
        Pixels per radian at the middle.
    cx, cy : float
        Principal point in pixels from the picture's left and top edges. The centre of the top left
        pixel is (0.5, 0.5): add 0.5 to values from OpenCV, or use `from_opencv`.
    k : (4,) sequence of float
        The coefficients k1 to k4.
    max_angle : float
        The greatest angle from the axis that the lens sees, in radians, up to pi: half of its field
        of view.
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
        k: ArrayLike = (0.0, 0.0, 0.0, 0.0),
        *,
        max_angle: float = math.pi,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self._set_pixels(fx, fy, cx, cy)
        self.k = k
        self.max_angle = max_angle
        self._set_range(znear, zfar)

    k: CheckedAttribute[ArrayLike, tuple[float, ...]] = CheckedAttribute(_four)
    max_angle: CheckedAttribute[float, float] = CheckedAttribute(angle_up_to(math.pi, "pi"))

    @classmethod
    def from_opencv(
        cls,
        K: ArrayLike,
        D: ArrayLike = (0.0, 0.0, 0.0, 0.0),
        *,
        max_angle: float = math.pi,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> FisheyeCamera:
        """Return the camera of a matrix K and coefficients D of ``cv2.fisheye``.

        Parameters
        ----------
        K : (3, 3) float
            Its pixel centres are whole numbers, as OpenCV's are.
        D : (4,) float
        max_angle, znear, zfar : float
            As for the class.

        Raises
        ------
        InvalidArgumentError
            K has skew, or a number is wrong.
        """
        k = _four(D, "D")
        return cls(*of_matrix(K), k=k, max_angle=max_angle, znear=znear, zfar=zfar)

    def _curve(self) -> RisingCurve:
        return _curve_of(self.k, self.max_angle)

    def _pixels_of(self, x: Floats, y: Floats, z: Floats, size: tuple[int, int]) -> object:
        across = np.sqrt(x * x + y * y)
        angle, curve = linalg.atan2(across, z), self._curve()
        radius = np.where(angle <= curve.end, _radius(angle, self.k), np.nan)
        scale = radius / np.where(across > 0.0, across, 1.0)
        return self.fx * (x * scale) + self.cx, self.fy * (y * scale) + self.cy

    def _directions_of(self, u: Floats, v: Floats, size: tuple[int, int]) -> object:
        x, y = self._normalized(u, v)
        radius = np.sqrt(x * x + y * y)
        angle = self._curve().inverse(radius)
        scale = linalg.sin(angle) / np.where(radius > 0.0, radius, 1.0)
        return x * scale, y * scale, linalg.cos(angle)

    def _limit(self, size: tuple[int, int]) -> str:
        curve = self._curve()
        if not curve.turns:
            return ""
        angle, radius = math.degrees(curve.end), self.fx * curve.top
        return f"its radius turns back at {angle:.4g} degrees from the axis ({radius:.4g} pixels)"


def _radius(angle: Floats, k: tuple[float, ...]) -> Floats:
    t = angle * angle
    return angle * (1.0 + t * (k[0] + t * (k[1] + t * (k[2] + t * k[3]))))


@functools.lru_cache(64)
def _curve_of(k: tuple[float, ...], most: float) -> RisingCurve:
    def slope(angle: Floats) -> Floats:
        t = angle * angle
        inner = 5.0 * k[1] + t * (7.0 * k[2] + t * (9.0 * k[3]))
        return 1.0 + t * (3.0 * k[0] + t * inner)

    return RisingCurve(
        lambda angle: _radius(angle, k), slope, np.arange(_GRID + 1.0) * (most / _GRID)
    )

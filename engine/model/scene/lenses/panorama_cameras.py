"""Panoramas: pictures whose columns are equal angles around the camera.

In: a direction. Out: its pixel: the column is the azimuth; the row is the elevation
(equirectangular), or its tangent (cylindrical). Source: Snyder 1987, "Map projections", pages 90
and 76.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....base.validation import CheckedAttribute, NumberAttribute
from .lens_camera import LensCamera, angle_up_to

Floats = NDArray[np.float64]
_FULL = 2.0 * math.pi
_STEEPEST = math.pi * (1.0 - 2.0**-20)  # tangents of more are no use


class PanoramaCamera(LensCamera):
    """A camera that sees all around its up axis, or a part of that."""

    depth_along: ClassVar = "ray"
    xfov: NumberAttribute = CheckedAttribute(angle_up_to(_FULL, "2 pi"))
    yfov: NumberAttribute

    def _columns_of(self, x: Floats, z: Floats, width: int) -> Floats:
        azimuth = linalg.atan2(x, z)
        inside = np.abs(azimuth) <= 0.5 * self.xfov * (1.0 + 1e-12)
        return np.where(inside, 0.5 * width + azimuth * (width / self.xfov), np.nan)

    def _azimuths_of(self, u: Floats, width: int) -> Floats:
        inside = (u >= 0.0) & (u <= width)
        return np.where(inside, (u - 0.5 * width) * (self.xfov / width), np.nan)

    def _parameters(self) -> str:
        return f"xfov={self.xfov:g}, yfov={self.yfov:g}"


class EquirectangularCamera(PanoramaCamera):
    """A camera for panoramas in longitude and latitude, whole or in part.

    The middle of the picture is straight ahead; columns are equal angles around the camera's up
    axis, rows equal angles of elevation.

    Parameters
    ----------
    xfov, yfov : float
        The angles from left to right and from top to bottom, in radians, at most 2 pi and pi. By
        default, the picture shows all directions; it should then be twice as wide as high.
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

    def __init__(
        self,
        *,
        xfov: float = 2.0 * math.pi,
        yfov: float = math.pi,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self.xfov, self.yfov = xfov, yfov
        self._set_range(znear, zfar)

    yfov: NumberAttribute = CheckedAttribute(angle_up_to(math.pi, "pi"))

    def _pinhole(self, size: tuple[int, int]) -> tuple[float, float, float, float]:
        width, height = size
        return width / self.xfov, height / self.yfov, 0.5 * width, 0.5 * height

    def _pixels_of(self, x: Floats, y: Floats, z: Floats, size: tuple[int, int]) -> object:
        width, height = size
        down = linalg.atan2(y, np.sqrt(x * x + z * z))
        inside = np.abs(down) <= 0.5 * self.yfov * (1.0 + 1e-12)
        rows = np.where(inside, 0.5 * height + down * (height / self.yfov), np.nan)
        columns = self._columns_of(x, z, width)
        return np.where(inside, columns, np.nan), np.where(np.isnan(columns), np.nan, rows)

    def _directions_of(self, u: Floats, v: Floats, size: tuple[int, int]) -> object:
        width, height = size
        azimuth = self._azimuths_of(u, width)
        inside = (v >= 0.0) & (v <= height)
        down = np.where(inside, (v - 0.5 * height) * (self.yfov / height), np.nan)
        flat = linalg.cos(down)
        return flat * linalg.sin(azimuth), linalg.sin(down), flat * linalg.cos(azimuth)


class CylindricalCamera(PanoramaCamera):
    """A camera for panoramas on a cylinder: upright lines stay straight.

    Columns are equal angles around the camera's up axis, as of a camera that turns, or of a line
    scan; each column is a pinhole picture.

    Parameters
    ----------
    xfov : float
        The angle from left to right, in radians, at most 2 pi.
    yfov : float
        The angle from top to bottom, less than pi.
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

    def __init__(
        self,
        *,
        xfov: float = 2.0 * math.pi,
        yfov: float = 1.2,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self.xfov, self.yfov = xfov, yfov
        self._set_range(znear, zfar)

    yfov: NumberAttribute = CheckedAttribute(angle_up_to(_STEEPEST, "less than pi"))

    def _pinhole(self, size: tuple[int, int]) -> tuple[float, float, float, float]:
        width, height = size
        return width / self.xfov, self._focal(height), 0.5 * width, 0.5 * height

    def _focal(self, height: int) -> float:
        return 0.5 * height / linalg.tan(0.5 * self.yfov)

    def _pixels_of(self, x: Floats, y: Floats, z: Floats, size: tuple[int, int]) -> object:
        width, height = size
        rows = 0.5 * height + y / np.sqrt(x * x + z * z) * self._focal(height)
        inside = (rows >= -1e-9 * height) & (rows <= height * (1.0 + 1e-9))
        columns = self._columns_of(x, z, width)
        return np.where(inside, columns, np.nan), np.where(
            inside & np.isfinite(columns), rows, np.nan
        )

    def _directions_of(self, u: Floats, v: Floats, size: tuple[int, int]) -> object:
        width, height = size
        azimuth = self._azimuths_of(u, width)
        inside = (v >= 0.0) & (v <= height)
        down = np.where(inside, (v - 0.5 * height) / self._focal(height), np.nan)
        return linalg.sin(azimuth), down, linalg.cos(azimuth)

"""The base of cameras whose pictures no projection matrix describes.

In: directions in camera space, or pixels. Out: the other. A lens has one centre, through which all
rays pass. Lens models are written in the axes of computer vision (x right, y down, z ahead); this
class turns them into ours (x right, y up, z back). All arithmetic is float64 in single operations,
so that a picture has the same bits on every machine (docs/exactness, R199).
"""

from __future__ import annotations

import math
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base import linalg
from ....base.calls import hinted
from ....base.image_size import check_size
from ....base.linalg.vectors import as_vectors
from ....base.numbers import floats, real, shown
from ....base.validation import CheckedAttribute, NumberAttribute, finite, positive
from ....errors import InvalidArgumentError
from ..cameras import PICTURE, Camera, check_range, far_distance

Floats = NDArray[np.float64]
#: Narrower lenses have no pixels that differ.
LEAST_ANGLE = 1e-6


class LensCamera(Camera):
    """A camera with a lens: the base of all cameras but pinholes and parallel projections.

    `render` draws the pinhole pictures around the lens that cover what it sees, and looks the
    pixels up in them. docs/cameras.md has the formulas of each kind.

    Attributes
    ----------
    version : int
        Grows with every assignment.
    depth_along : {"ray", "axis"}
        What ``frame.depth`` measures: the distance from the camera, or along its axis.
    """

    depth_along: ClassVar[Literal["ray", "axis"]] = "ray"

    znear: NumberAttribute = CheckedAttribute(positive)
    zfar: CheckedAttribute[float | None, float] = CheckedAttribute(far_distance)

    def _set_range(self, znear: float, zfar: float) -> None:
        self.znear, self.zfar = znear, zfar
        check_range(self)

    # What each kind defines: arrays (N,) in and out, and NaN for what is not seen.

    def _pixels_of(self, x: Floats, y: Floats, z: Floats, size: tuple[int, int]) -> Any:
        """Return the columns and rows of points before the lens, not all zero."""
        raise NotImplementedError

    def _directions_of(self, u: Floats, v: Floats, size: tuple[int, int]) -> Any:
        """Return x, y, z of the directions, of any length, in which pixels look."""
        raise NotImplementedError

    def _pinhole(self, size: tuple[int, int]) -> tuple[float, float, float, float]:
        """Return fx, fy, cx, cy of the pinhole camera that agrees at the middle."""
        raise NotImplementedError

    def _limit(self, size: tuple[int, int]) -> str:
        """Return why pixels may see nothing, if the model turns back; "" if it never does."""
        return ""

    @hinted
    def project(self, points: ArrayLike, size: tuple[int, int] = PICTURE) -> Floats:
        sized = check_size(size)
        given = as_vectors("points", points)
        x, y, z = linalg.normalize(np.where(np.isfinite(given), given, np.nan)).reshape(-1, 3).T
        seen = (np.abs(x) + np.abs(y) + np.abs(z)) > 0.0
        pixels = np.full((len(x), 2), np.nan)
        with np.errstate(all="ignore"):
            found = self._pixels_of(x[seen], -y[seen], -z[seen], sized)
        pixels[seen] = np.stack(found, axis=-1)
        return pixels.reshape(*given.shape[:-1], 2)

    @hinted
    def rays(self, pixels: ArrayLike, size: tuple[int, int] = PICTURE) -> Floats:
        sized = check_size(size)
        given = as_vectors("pixels", pixels, 2)
        flat = given.reshape(-1, 2)
        known = np.isfinite(flat).all(axis=1)
        directions = np.full((len(flat), 3), np.nan)
        with np.errstate(all="ignore"):
            u, v = flat[known].T
            x, y, z = self._directions_of(u, v, sized)
            directions[known] = linalg.normalize(np.stack((x, -y, -z), axis=-1))
        directions[~(np.abs(directions).sum(axis=1) > 0.0)] = np.nan
        return directions.reshape(*given.shape[:-1], 3)

    @hinted
    def mask(self, size: tuple[int, int]) -> NDArray[np.bool_]:
        """Return which pixels of a picture see something, by their centres, (H, W) bool.

        Others lie outside of the lens's image circle, or where its distortion has no inverse. They
        are drawn as nothing: black, or transparent without a background.

        Raises
        ------
        InvalidArgumentError
        """
        width, height = check_size(size)
        centers = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1)
        rays = self.rays(centers.reshape(-1, 2), (width, height))
        return np.isfinite(rays[:, 0]).reshape(height, width)

    @hinted
    def projection(self, size: tuple[int, int]) -> Floats:
        """Return clip_from_view of the pinhole camera that agrees at the middle, (4, 4) float64.

        Away from the middle, it is not what the lens shows: `project` is.
        """
        check_range(self)
        width, height = check_size(size)
        fx, fy, cx, cy = self._pinhole((width, height))
        matrix = linalg.perspective(1.0, 1.0, self.znear, self.zfar)
        matrix[0, 0], matrix[1, 1] = 2.0 * fx / width, 2.0 * fy / height
        matrix[0, 2], matrix[1, 2] = 1.0 - 2.0 * cx / width, 2.0 * cy / height - 1.0
        return matrix


def pinhole_of(camera: LensCamera, size: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return fx, fy, cx and cy of the pinhole camera that agrees with a lens at its middle."""
    return camera._pinhole(size)


def limit_of(camera: LensCamera, size: tuple[int, int]) -> str:
    """Return where a lens's model turns back, in words; "" if it does not."""
    return camera._limit(size)


class CalibratedCamera(LensCamera):
    """A lens given by focal lengths and a principal point in pixels, as calibration tools do."""

    fx: NumberAttribute = CheckedAttribute(positive)
    fy: NumberAttribute = CheckedAttribute(positive)
    cx: NumberAttribute = CheckedAttribute(finite)
    cy: NumberAttribute = CheckedAttribute(finite)

    def _set_pixels(self, fx: float, fy: float, cx: float, cy: float) -> None:
        self.fx, self.fy = fx, fy
        self.cx, self.cy = cx, cy

    def _pinhole(self, size: tuple[int, int]) -> tuple[float, float, float, float]:
        return self.fx, self.fy, self.cx, self.cy

    def _normalized(self, u: Floats, v: Floats) -> tuple[Floats, Floats]:
        return (u - self.cx) / self.fx, (v - self.cy) / self.fy

    def _parameters(self) -> str:
        return f"fx={self.fx:g}, fy={self.fy:g}, cx={self.cx:g}, cy={self.cy:g}"


def coefficients(counts: tuple[int, ...]) -> Any:
    """Return a check for distortion coefficients of one of several numbers."""

    def check(value: Any, what: str) -> tuple[float, ...]:
        array = floats(value, what).reshape(-1)
        if len(array) not in counts:
            known = ", ".join(map(str, counts[:-1])) + f" or {counts[-1]}"
            known = known if len(counts) > 1 else str(counts[0])
            raise InvalidArgumentError(f"{what} must be {known} numbers, not {len(array)}")
        if not np.isfinite(array).all():
            raise InvalidArgumentError(f"{what} must be finite numbers, not {shown(value)}")
        return tuple(array.tolist())

    return check


def of_matrix(matrix: ArrayLike) -> tuple[float, float, float, float]:
    """Return fx, fy, cx and cy of a matrix K whose pixel centres are whole numbers.

    Raises
    ------
    InvalidArgumentError
    """
    k = floats(matrix, "K")
    if k.shape != (3, 3) or not np.isfinite(k).all():
        raise InvalidArgumentError(f"K must be a finite 3x3 matrix, not {shown(matrix)}")
    if k[0, 1] or k[1, 0] or k[2].tolist() != [0.0, 0.0, 1.0]:
        raise InvalidArgumentError("K must be [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]: no skew")
    (fx, _, cx), (_, fy, cy) = k[:2].tolist()
    return fx, fy, cx + 0.5, cy + 0.5


def angle_up_to(most: float, words: str) -> Any:
    """Return a check for an angle of a lens, up to ``most`` radians."""

    def check(value: float, what: str) -> float:
        number = real(value)
        if not LEAST_ANGLE <= number <= most * (1.0 + 1e-12):
            beyond = "; degrees go through numpy.radians" if number > 2.0 * math.pi else ""
            raise InvalidArgumentError(
                f"{what} must be from {LEAST_ANGLE:g} to {words} radians, "
                f"not {shown(value)}{beyond}"
            )
        return min(number, most)

    return check

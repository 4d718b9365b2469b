"""Camera poses around a target, from angles.

In: a target, a distance, an azimuth, an elevation and an up direction (world space, radians). Out:
poses. They are computed from the angles, not by ``look_at``, so that straight up and down are no
special cases; sines are rounded to 14 decimals, which makes right angles exact. The same inputs
give the same bits on every machine.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.angles import angles
from ...base.calls import hinted
from ...base.numbers import floats
from ...base.validation import positive, vector3
from ...errors import InvalidArgumentError


@hinted
def orbit(
    target: ArrayLike,
    distance: float,
    azimuth: ArrayLike,
    elevation: ArrayLike = 0.0,
    *,
    up: ArrayLike = (0.0, 1.0, 0.0),
) -> NDArray[np.float64]:
    """Return the poses of cameras around a target that look at it.

    Parameters
    ----------
    target : (3,) float
        The point that the cameras look at, in world space.
    distance : float
        From the target to the cameras, in world units; greater than 0.
    azimuth : float or (N,) float
        Angles about ``up`` in radians, counter-clockwise seen from above. With +Y up, a camera at
        azimuth 0 stands on the target's +Z side and one at pi / 2 on its +X side; with +Z up, on
        its -Y and its +X side.
    elevation : float or (N,) float
        Angles above the horizon in radians, from -pi / 2 to pi / 2.
    up : (3,) float
        The world's up direction, of any nonzero length.

    Returns
    -------
    poses : (4, 4) or (N, 4, 4) float64
        world-from-camera; one pose if both angles are numbers.

    Raises
    ------
    InvalidArgumentError

    Examples
    --------
    >>> poses = orbit((0, 1, 0), 5.0, np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False), 0.3)
    """
    center, distance = vector3(target, "target"), positive(distance, "distance")
    up = vector3(up, "up")
    azimuths, elevations = _angles(azimuth, elevation)
    poses = np.zeros((*azimuths.shape, 4, 4))
    poses[..., 3, 3] = 1.0
    flat = poses.reshape(-1, 4, 4)
    for pose, turned, raised in zip(
        flat, azimuths.ravel().tolist(), elevations.ravel().tolist(), strict=True
    ):
        pose[:3, :3] = orbit_axes(up, turned, raised)
        pose[:3, 3] = center + pose[:3, 2] * distance
    return poses


def orbit_axes(up: ArrayLike, azimuth: float, elevation: float) -> NDArray[np.float64]:
    """Return a camera's axes in world space: (3, 3), columns right, up and back."""
    right, upward, front = home_axes(up)
    sin_a, cos_a = sine(azimuth), cosine(azimuth)
    sin_e, cos_e = sine(elevation), cosine(elevation)
    outward = right * sin_a + front * cos_a
    camera_right = right * cos_a - front * sin_a
    camera_up = upward * cos_e - outward * sin_e
    camera_back = outward * cos_e + upward * sin_e
    return np.stack([camera_right, camera_up, camera_back], axis=1)


def home_axes(up: ArrayLike) -> NDArray[np.float64]:
    """Return the axes from which azimuth and elevation are measured.

    Parameters
    ----------
    up : (3,) float
        The up direction in world space, of any nonzero length.

    Returns
    -------
    (3, 3) ndarray of float64
        Rows: right, up, and back, which is where the camera stands at azimuth zero. For +Y that is
        X, Y, Z; for +Z it is X, Z, -Y.
    """
    length = float(linalg.length(up))
    if not 0.0 < length < math.inf:
        raise InvalidArgumentError("an up direction must not be zero")
    up = np.asarray(up, dtype=np.float64) / length
    side = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.9 else np.array([0.0, 0.0, -up[0]])
    right = linalg.normalize(side - up * float(linalg.dot(side, up)))
    return np.array([right, up, linalg.cross(right, up)])


def sine(angle: float) -> float:
    """Return the sine, exact at right angles."""
    return round(linalg.sin(angle), 14)


def cosine(angle: float) -> float:
    """Return the cosine, exact at right angles."""
    return round(linalg.cos(angle), 14)


def _angles(azimuth: ArrayLike, elevation: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    azimuths, elevations = angles(azimuth, "azimuth"), floats(elevation, "elevation")
    try:
        azimuths, elevations = np.broadcast_arrays(azimuths, elevations)
    except ValueError as error:
        raise InvalidArgumentError(f"azimuth and elevation do not fit: {error}") from None
    if azimuths.ndim > 1:
        raise InvalidArgumentError(f"azimuth must be a number or (N,), not {azimuths.shape}")
    if not (np.isfinite(azimuths).all() and np.isfinite(elevations).all()):
        raise InvalidArgumentError("azimuth and elevation must be finite")
    if not (np.abs(elevations) <= math.pi / 2).all():
        raise InvalidArgumentError(
            "elevation must be from -pi / 2 to pi / 2 radians; degrees go through numpy.radians"
        )
    return azimuths, elevations

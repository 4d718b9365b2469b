"""Camera poses and projections to OpenGL's clip space.

In: positions in world space, angles in radians, distances in world units. Out: 4x4 float64.
Cameras look down -Z with +Y up; inside the frustum -w <= x, y, z <= w, and z grows with distance.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...errors import InvalidArgumentError
from ..angles import field_of_view
from ..calls import hinted
from ..numbers import real
from ..validation import finite, positive
from . import single
from .trigonometry import tan
from .vectors import as_vectors

_LEAST_SLOPE = 1e-30  # of the frustum's sides: smaller slopes overflow in float32

FloatArray = npt.NDArray[np.float64]

# Below this sine of the angle between the line of sight and `up`, another `up` is used.
_PARALLEL = 1e-9


@hinted
def look_at(
    eye: npt.ArrayLike, target: npt.ArrayLike, up: npt.ArrayLike = (0.0, 1.0, 0.0)
) -> FloatArray:
    """Return the pose (world-from-camera) of a camera at `eye` that looks at `target`.

    Parameters
    ----------
    eye, target : array_like, shape (3,)
        World positions.
    up : array_like, shape (3,)
        The direction that points up in the image. If it is parallel to the line of sight (looking
        straight down), the world axis most perpendicular to that line replaces it.

    Returns
    -------
    ndarray of float64, shape (4, 4)

    Raises
    ------
    InvalidArgumentError
        If eye and target coincide, or a position isn't finite.
    """
    eye, target, up = _position("eye", eye), _position("target", target), _position("up", up)
    offset = eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]
    if not any(offset) or not all(map(math.isfinite, offset)):
        raise InvalidArgumentError("eye and target must be two finite, different positions")
    backward = single.normalize(offset)
    right = single.cross(single.normalize(up), backward)
    if not single.length(right) > _PARALLEL:
        smallest = min(range(3), key=lambda axis: abs(backward[axis]))
        axis = float(smallest == 0), float(smallest == 1), float(smallest == 2)
        right = single.cross(axis, backward)
    right = single.normalize(right)
    upward = single.cross(backward, right)
    rows = [list(row) for row in zip(right, upward, backward, eye, strict=True)]
    return np.array([*rows, [0.0, 0.0, 0.0, 1.0]])


def _position(name: str, value: npt.ArrayLike) -> single.Vector:
    vector = as_vectors(name, value)
    if vector.ndim != 1:
        raise InvalidArgumentError(f"{name} must have shape (3,), not {vector.shape}")
    x, y, z = vector.tolist()
    return x, y, z


def perspective(yfov: float, aspect: float, znear: float, zfar: float | None = None) -> FloatArray:
    """Return a perspective projection.

    Parameters
    ----------
    yfov : float
        Vertical field of view in radians, between 0 and pi.
    aspect : float
        Width over height of the image.
    znear : float
        Distance of the near plane, greater than 0.
    zfar : float or None
        Distance of the far plane, greater than `znear`; None or infinity for none.

    Returns
    -------
    ndarray of float64, shape (4, 4)
        clip_from_view.

    Raises
    ------
    InvalidArgumentError
        If an argument is out of its range.
    """
    yfov = field_of_view(yfov)
    aspect, znear = real(aspect), real(znear)
    if not 0.0 < aspect < math.inf:
        raise InvalidArgumentError(f"aspect must be greater than 0, not {aspect}")
    if not 0.0 < znear < math.inf:
        raise InvalidArgumentError(f"znear must be greater than 0, not {znear}")
    zfar = math.inf if zfar is None else real(zfar)
    if not zfar > znear:
        raise InvalidArgumentError(f"zfar must be greater than znear ({znear}), not {zfar}")
    slope = tan(0.5 * yfov)
    if slope * aspect < _LEAST_SLOPE or slope < _LEAST_SLOPE:
        raise InvalidArgumentError(f"yfov {yfov} is too small to see anything, aspect {aspect}")
    focal = 1.0 / slope
    matrix = np.zeros((4, 4))
    matrix[0, 0] = focal / aspect
    matrix[1, 1] = focal
    matrix[3, 2] = -1.0
    if math.isinf(zfar):
        matrix[2, 2], matrix[2, 3] = -1.0, -2.0 * znear
    else:
        matrix[2, 2] = (zfar + znear) / (znear - zfar)
        matrix[2, 3] = 2.0 * zfar * znear / (znear - zfar)
    return matrix


def orthographic(xmag: float, ymag: float, znear: float, zfar: float) -> FloatArray:
    """Return a parallel projection.

    Parameters
    ----------
    xmag, ymag : float
        Half the width and half the height of the visible box, greater than 0.
    znear, zfar : float
        Distances of the near and far plane along the line of sight, `zfar` greater than `znear`; a
        negative `znear` lies behind the camera.

    Returns
    -------
    ndarray of float64, shape (4, 4)
        clip_from_view.

    Raises
    ------
    InvalidArgumentError
        If an argument is out of its range.
    """
    xmag, ymag = positive(xmag, "xmag"), positive(ymag, "ymag")
    znear, zfar = finite(znear, "znear"), finite(zfar, "zfar")
    if not znear < zfar:
        raise InvalidArgumentError(f"znear must be less than zfar, not {znear}, {zfar}")
    matrix = np.eye(4)
    matrix[0, 0] = 1.0 / xmag
    matrix[1, 1] = 1.0 / ymag
    matrix[2, 2] = 2.0 / (znear - zfar)
    matrix[2, 3] = (zfar + znear) / (znear - zfar)
    return matrix

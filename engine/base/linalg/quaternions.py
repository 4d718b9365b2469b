"""Rotations as quaternions x, y, z, w.

In: quaternions of any nonzero length (normalised where it matters), shape (4,) or, where
documented, stacks (..., 4). Out: float64 unit quaternions, or 4x4 rotation matrices. Sources:
Shoemake 1985 (products, conversion), Shepperd 1978 (matrix to quaternion).
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...choices import EulerOrder
from ...errors import InvalidArgumentError
from ..angles import angles as angles_of
from ..angles import finite_angle
from ..numbers import floats, shown
from ..validation import finite
from . import single
from .trigonometry import atan2, cos, sin
from .vectors import as_vectors, normalize

FloatArray = npt.NDArray[np.float64]

# Below this cosine of the second angle, the first and third turn about the same axis.
_GIMBAL_LOCK = 1e-9
_NO_LENGTH = "a quaternion must have a finite length greater than zero"


def _unit(q: FloatArray) -> FloatArray:
    """Return quaternions at unit length."""
    square = q[..., 0] * q[..., 0] + q[..., 1] * q[..., 1]
    square = square + q[..., 2] * q[..., 2] + q[..., 3] * q[..., 3]
    if not np.all((square > 0.0) & np.isfinite(square)):
        raise InvalidArgumentError(_NO_LENGTH)
    return q / np.sqrt(square)[..., np.newaxis]


def quaternion_from_axis_angle(axis: npt.ArrayLike, angle: float) -> FloatArray:
    """Return the quaternion of a rotation about an axis.

    Parameters
    ----------
    axis : array_like, shape (3,)
        Direction of the axis, of any nonzero length.
    angle : float
        Radians, counter-clockwise seen from the tip of the axis.

    Returns
    -------
    ndarray of float64, shape (4,)

    Raises
    ------
    InvalidArgumentError
        If the axis has length zero.
    """
    unit = normalize(as_vectors("axis", axis))
    if unit.shape != (3,) or not np.any(unit):
        raise InvalidArgumentError(f"axis must be one vector of shape (3,), not {shown(axis)}")
    return _turn(unit, finite_angle(angle, "angle"))


def _turn(unit: FloatArray, angle: float) -> FloatArray:
    half = 0.5 * angle
    return np.append(unit * sin(half), cos(half))


def quaternion_multiply(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """Return Hamilton's product ``a b``: the rotation `b` followed by the rotation `a`.

    Parameters
    ----------
    a, b : array_like, shape (..., 4)
        Quaternions that broadcast against each other; not normalised.

    Returns
    -------
    ndarray of float64, shape (..., 4)
    """
    a, b = as_vectors("a", a, 4), as_vectors("b", b, 4)
    ax, ay, az, aw = (a[..., k] for k in range(4))
    bx, by, bz, bw = (b[..., k] for k in range(4))
    return np.stack(
        (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ),
        axis=-1,
    )


def quaternion_conjugate(q: npt.ArrayLike) -> FloatArray:
    """Return the conjugates, which for unit quaternions are the inverse rotations."""
    return as_vectors("q", q, 4) * (-1.0, -1.0, -1.0, 1.0)


def quaternion_to_matrix(q: npt.ArrayLike) -> FloatArray:
    """Return the rotation matrices of quaternions.

    Parameters
    ----------
    q : array_like, shape (..., 4)
        Quaternions x, y, z, w of any nonzero length.

    Returns
    -------
    ndarray of float64, shape (..., 4, 4)

    Raises
    ------
    InvalidArgumentError
        If a quaternion is null or not finite.
    """
    q = as_vectors("q", q, 4)
    if q.ndim == 1:
        return _single_to_matrix(q.tolist())
    q = _unit(q)
    x, y, z, w = (q[..., k] for k in range(4))
    x2, y2, z2 = x + x, y + y, z + z
    matrix = np.zeros((*q.shape[:-1], 4, 4))
    matrix[..., 0, 0] = 1.0 - (y * y2 + z * z2)
    matrix[..., 0, 1] = x * y2 - w * z2
    matrix[..., 0, 2] = x * z2 + w * y2
    matrix[..., 1, 0] = x * y2 + w * z2
    matrix[..., 1, 1] = 1.0 - (x * x2 + z * z2)
    matrix[..., 1, 2] = y * z2 - w * x2
    matrix[..., 2, 0] = x * z2 - w * y2
    matrix[..., 2, 1] = y * z2 + w * x2
    matrix[..., 2, 2] = 1.0 - (x * x2 + y * y2)
    matrix[..., 3, 3] = 1.0
    return matrix


def _single_to_matrix(q: list[float]) -> FloatArray:
    rows = single.rotation(q)
    if rows is None:
        raise InvalidArgumentError(_NO_LENGTH)
    return np.array([[*row, 0.0] for row in rows] + [[0.0, 0.0, 0.0, 1.0]])


@np.errstate(all="ignore")  # overflow gives infinity or NaN
def matrix_to_quaternion(m: npt.ArrayLike) -> FloatArray:
    """Return the quaternion of a rotation matrix.

    Divides by the largest of the four components, so that no rotation loses precision.

    Parameters
    ----------
    m : array_like, shape (4, 4) or (3, 3)
        A rotation without scale or reflection; of a 4x4 the upper left 3x3 is read.

    Returns
    -------
    ndarray of float64, shape (4,)
        Unit quaternion with w >= 0.

    Raises
    ------
    InvalidArgumentError
        If the shape is wrong.
    """
    m = floats(m, "m")
    if m.shape not in ((3, 3), (4, 4)):
        raise InvalidArgumentError(f"m must have shape (4, 4) or (3, 3), not {m.shape}")
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    squares = [m[0, 0], m[1, 1], m[2, 2], trace]
    largest = int(np.argmax(squares))
    q = np.empty(4)
    if largest == 3:
        q[:] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1.0 + trace
    else:
        i, j, k = largest, (largest + 1) % 3, (largest + 2) % 3
        q[i] = 1.0 + m[i, i] - m[j, j] - m[k, k]
        q[j] = m[j, i] + m[i, j]
        q[k] = m[k, i] + m[i, k]
        q[3] = m[k, j] - m[j, k]
    q = _unit(q)
    return -q + 0.0 if q[3] < 0.0 else q + 0.0


def euler_to_quaternion(angles: npt.ArrayLike, order: EulerOrder = "XYZ") -> FloatArray:
    """Return the quaternion of three rotations about the object's own axes.

    ``"XYZ"`` rotates about x, then about the new y, then about the newest z: three.js's ``Euler``.

    Parameters
    ----------
    angles : array_like, shape (3,)
        Radians about x, y and z, regardless of the order of application.
    order : str
        A permutation of ``"XYZ"``.

    Returns
    -------
    ndarray of float64, shape (4,)

    Raises
    ------
    InvalidArgumentError
        If the order isn't a permutation of XYZ or the shape is wrong.
    """
    checked = as_vectors("angles", angles_of(angles, "angles"))
    if checked.shape != (3,):
        raise InvalidArgumentError(f"angles must have shape (3,), not {checked.shape}")
    return quaternion_of_turns(checked, order)


def quaternion_of_turns(angles: FloatArray, order: EulerOrder = "XYZ") -> FloatArray:
    """Return the quaternion of checked angles; see `euler_to_quaternion`."""
    result = np.array((0.0, 0.0, 0.0, 1.0))
    for axis in _axes_of(order):
        turn = _turn(np.eye(3)[axis], finite(float(angles[axis]), "angles"))
        result = quaternion_multiply(result, turn)
    return result


def quaternion_to_euler(q: npt.ArrayLike, order: EulerOrder = "XYZ") -> FloatArray:
    """Return the three rotations about the object's own axes that give a quaternion's rotation.

    It is the inverse of `euler_to_quaternion`: the second angle is between -pi/2 and pi/2; at these
    limits, the third is 0.

    Parameters
    ----------
    q : array_like, shape (4,)
        Quaternion x, y, z, w of any nonzero length.
    order : str
        A permutation of ``"XYZ"``.

    Returns
    -------
    ndarray of float64, shape (3,)
        Radians about x, y and z, regardless of the order of application.

    Raises
    ------
    InvalidArgumentError
        If the order isn't a permutation of XYZ, or the quaternion is null or of a wrong shape.
    """
    i, j, k = _axes_of(order)
    m = quaternion_to_matrix(q)
    if m.ndim != 2:
        raise InvalidArgumentError(f"q must have shape (4,), not {m.shape[:-2] + (4,)}")
    m = m.tolist()
    sign = 1.0 if (i + 1) % 3 == j else -1.0
    cosine = math.sqrt(m[i][i] * m[i][i] + m[i][j] * m[i][j])
    angles = np.zeros(3)
    angles[j] = atan2(sign * m[i][k], cosine)
    if cosine > _GIMBAL_LOCK:
        angles[i] = atan2(-sign * m[j][k], m[k][k])
        angles[k] = atan2(-sign * m[i][j], m[i][i])
    else:
        angles[i] = atan2(sign * m[k][j], m[j][j])
    return angles


def _axes_of(order: str) -> list[int]:
    if not isinstance(order, str) or sorted(order) != ["X", "Y", "Z"]:
        raise InvalidArgumentError(f"order must be a permutation of 'XYZ', not {shown(order)}")
    return ["XYZ".index(name) for name in order]

"""4x4 affine and projective matrices: construction, products, inverses, transforms.

In: float-like arrays; matrices are row-major arrays that act on column vectors from the left, and
functions that take matrices take stacks of them, shape (..., 4, 4). Out: float64.
Products sum over the inner index in ascending order, one rounding per operation.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..._native.scene_graph import invert
from ...errors import InvalidArgumentError
from ..angles import finite_angle
from ..numbers import floats
from . import single
from .quaternions import matrix_to_quaternion, quaternion_from_axis_angle, quaternion_to_matrix
from .trigonometry import cos, sin
from .vectors import as_vectors, cross, dot, length

FloatArray = npt.NDArray[np.float64]

_SINGULAR = "the matrix has no inverse: it is singular or not finite"


def as_matrices(name: str, values: npt.ArrayLike) -> FloatArray:
    """Return `values` as float64 of shape (..., 4, 4), or say which argument isn't."""
    if type(values) is np.ndarray and values.dtype == np.float64:
        matrices = values
    else:
        matrices = floats(values, name)
    if matrices.shape[-2:] != (4, 4):
        raise InvalidArgumentError(f"{name} must have shape (..., 4, 4), not {matrices.shape}")
    return matrices


def translation(offset: npt.ArrayLike) -> FloatArray:
    """Return the matrix that moves points by `offset`, shape (3,)."""
    matrix = np.eye(4)
    matrix[:3, 3] = _three("offset", offset)
    return matrix


def scaling(factors: npt.ArrayLike) -> FloatArray:
    """Return the matrix that scales by one factor, or by three along x, y and z."""
    matrix = np.eye(4)
    matrix[[0, 1, 2], [0, 1, 2]] = _three_factors("factors", factors)
    return matrix


def _three_factors(name: str, factors: npt.ArrayLike) -> FloatArray:
    factors = floats(factors, name)
    return _three(name, np.broadcast_to(factors, (3,)) if factors.ndim == 0 else factors)


def _three(name: str, values: npt.ArrayLike) -> FloatArray:
    """Return one vector, checked."""
    vector = as_vectors(name, values)
    if vector.shape != (3,):
        raise InvalidArgumentError(f"{name} must have shape (3,), not {vector.shape}")
    return vector


def _plane_rotation(first: int, second: int, angle: float) -> FloatArray:
    """Return the rotation of the axis `first` towards the axis `second`."""
    matrix = np.eye(4)
    angle = finite_angle(angle, "angle")
    c, s = cos(angle), sin(angle)
    matrix[first, first] = matrix[second, second] = c
    matrix[first, second], matrix[second, first] = -s, s
    return matrix


def rotation_x(angle: float) -> FloatArray:
    """Return the rotation about +X by `angle` radians, counter-clockwise seen from +X."""
    return _plane_rotation(1, 2, angle)


def rotation_y(angle: float) -> FloatArray:
    """Return the rotation about +Y by `angle` radians, counter-clockwise seen from +Y."""
    return _plane_rotation(2, 0, angle)


def rotation_z(angle: float) -> FloatArray:
    """Return the rotation about +Z by `angle` radians, counter-clockwise seen from +Z."""
    return _plane_rotation(0, 1, angle)


def rotation_axis(axis: npt.ArrayLike, angle: float) -> FloatArray:
    """Return the rotation about any axis through the origin.

    Parameters
    ----------
    axis : array_like, shape (3,)
        Direction of the axis, of any nonzero length.
    angle : float
        Radians, counter-clockwise seen from the tip of the axis.

    Returns
    -------
    ndarray of float64, shape (4, 4)

    Raises
    ------
    InvalidArgumentError
        If the axis has length zero.
    """
    return quaternion_to_matrix(quaternion_from_axis_angle(axis, angle))


def multiply(a: npt.ArrayLike, b: npt.ArrayLike, *more: npt.ArrayLike) -> FloatArray:
    """Return the matrix product ``a b ...``, which applies the last factor first.

    Parameters
    ----------
    a, b, *more : array_like, shape (..., 4, 4)
        Matrices or stacks that broadcast against each other.

    Returns
    -------
    ndarray of float64, shape (..., 4, 4)

    Raises
    ------
    InvalidArgumentError
        If an argument isn't 4x4.
    """
    product = as_matrices("a", a)
    for factor in (b, *more):
        factor = as_matrices("b", factor)
        if product.ndim == factor.ndim == 2:
            product = np.array(single.multiply(product.tolist(), factor.tolist()))
            continue
        left = product
        product = left[..., :, 0:1] * factor[..., 0:1, :]
        for k in range(1, 4):
            product = product + left[..., :, k : k + 1] * factor[..., k : k + 1, :]
    return product


def _pair_determinants(m: FloatArray, row: int) -> dict[tuple[int, int], FloatArray]:
    """Return the 2x2 determinants of rows `row` and `row + 1`, by pair of columns."""
    upper, lower = m[..., row, :], m[..., row + 1, :]
    return {
        (i, j): upper[..., i] * lower[..., j] - upper[..., j] * lower[..., i]
        for i in range(4)
        for j in range(i + 1, 4)
    }


def inverse(m: npt.ArrayLike) -> FloatArray:
    """Return the inverses of matrices, by Laplace's expansion in 2x2 determinants.

    Parameters
    ----------
    m : array_like, shape (..., 4, 4)

    Returns
    -------
    ndarray of float64, shape (..., 4, 4)
        The last row of an affine matrix's inverse is exactly ``0 0 0 1``.

    Raises
    ------
    InvalidArgumentError
        If a matrix is singular or not finite.
    """
    m = as_matrices("m", m)
    if m.ndim == 2:
        result = np.empty((4, 4))
        if not invert(np.ascontiguousarray(m), result):
            raise InvalidArgumentError(_SINGULAR)
        return result
    with np.errstate(all="ignore"):  # overflow is reported below
        top, bottom = _pair_determinants(m, 0), _pair_determinants(m, 2)
        adjugate = np.empty_like(m)
        for column in range(4):
            # Entry (column, row) of the adjugate is a signed 3x3 minor without that row and column:
            # the paired row's entries, times the other pair's determinants.
            others = [k for k in range(4) if k != column]
            for row in range(4):
                partner = m[..., row ^ 1, :]
                pairs = bottom if row < 2 else top
                i, j, k = others
                minor = partner[..., i] * pairs[j, k] - partner[..., j] * pairs[i, k]
                minor = minor + partner[..., k] * pairs[i, j]
                adjugate[..., column, row] = -minor if (row + column) % 2 else minor
        # Expanded along the last row, this is an affine matrix's own 3x3 determinant, to the bit.
        determinant = m[..., 3, 0] * adjugate[..., 0, 3]
        for k in range(1, 4):
            determinant = determinant + m[..., 3, k] * adjugate[..., k, 3]
        result = adjugate / determinant[..., np.newaxis, np.newaxis] + 0.0
    if not np.all(np.isfinite(result)):
        raise InvalidArgumentError(_SINGULAR)
    return result


@np.errstate(all="ignore")  # overflow gives infinity or NaN
def transform_points(m: npt.ArrayLike, points: npt.ArrayLike) -> FloatArray:
    """Apply a matrix to points, dividing by w if the matrix is projective.

    Parameters
    ----------
    m : array_like, shape (4, 4)
    points : array_like, shape (..., 3)

    Returns
    -------
    ndarray of float64, shape (..., 3)

    Raises
    ------
    InvalidArgumentError
        If a shape is wrong.
    """
    m, p = _single_matrix(m), as_vectors("points", points)
    result = transform_directions(m, p) + m[:3, 3]
    if m[3].tolist() == [0.0, 0.0, 0.0, 1.0]:
        return result
    w = p[..., 0] * m[3, 0] + p[..., 1] * m[3, 1] + p[..., 2] * m[3, 2] + m[3, 3]
    return result / w[..., np.newaxis]


@np.errstate(all="ignore")  # overflow gives infinity or NaN
def transform_directions(m: npt.ArrayLike, directions: npt.ArrayLike) -> FloatArray:
    """Apply a matrix without its translation to direction vectors, shape (..., 3).

    For normals, use `normal_matrix` instead unless the scale is uniform.
    """
    m, d = _single_matrix(m), as_vectors("directions", directions)
    x, y, z = (d[..., k, np.newaxis] for k in range(3))
    return x * m[:3, 0] + y * m[:3, 1] + z * m[:3, 2]


def _single_matrix(m: npt.ArrayLike) -> FloatArray:
    m = as_matrices("m", m)
    if m.ndim != 2:
        raise InvalidArgumentError(f"m must have shape (4, 4), not {m.shape}")
    return m


def normal_matrix(m: npt.ArrayLike) -> FloatArray:
    """Return the inverse transpose of the upper left 3x3, which transforms normals.

    If that is singular (an object scaled to zero along an axis), the cofactor matrix replaces it:
    it gives the same directions as far as they exist.

    Parameters
    ----------
    m : array_like, shape (..., 4, 4)

    Returns
    -------
    ndarray of float64, shape (..., 3, 3)
        Transformed normals generally don't have unit length.
    """
    m = as_matrices("m", m)
    x, y, z = (m[..., :3, k] for k in range(3))
    cofactors = np.stack((cross(y, z), cross(z, x), cross(x, y)), axis=-1)
    determinant = np.asarray(dot(x, cofactors[..., 0]))[..., np.newaxis, np.newaxis]
    with np.errstate(all="ignore"):
        result = cofactors / determinant + 0.0
    return np.where(np.all(np.isfinite(result), axis=(-2, -1), keepdims=True), result, cofactors)


@np.errstate(all="ignore")  # overflow gives infinity or NaN
def compose(
    offset: npt.ArrayLike = (0.0, 0.0, 0.0),
    rotation: npt.ArrayLike = (0.0, 0.0, 0.0, 1.0),
    scale: npt.ArrayLike = 1.0,
) -> FloatArray:
    """Return the pose that scales, then rotates, then translates.

    Parameters
    ----------
    offset : array_like, shape (3,)
    rotation : array_like, shape (4,)
        Quaternion x, y, z, w, of any nonzero length.
    scale : float or array_like of shape (3,)

    Returns
    -------
    ndarray of float64, shape (4, 4)

    Raises
    ------
    InvalidArgumentError
        If a shape is wrong or the quaternion is null.
    """
    matrix = quaternion_to_matrix(as_vectors("rotation", rotation, 4))
    matrix[:3, :3] = matrix[:3, :3] * _three_factors("scale", scale)
    matrix[:3, 3] = _three("offset", offset)
    return matrix


@np.errstate(all="ignore")  # overflow gives infinity or NaN
def decompose(m: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Split a pose into translation, quaternion and scale, the inverse of `compose`.

    A reflection becomes a negative scale along x, as in three.js. Shear is lost.

    Parameters
    ----------
    m : array_like, shape (4, 4)

    Returns
    -------
    offset : ndarray of float64, shape (3,)
    rotation : ndarray of float64, shape (4,)
        Unit quaternion x, y, z, w.
    scale : ndarray of float64, shape (3,)
    """
    m = _single_matrix(m)
    axes = m[:3, :3].T
    scale = np.array([length(axis) for axis in axes])
    if dot(cross(axes[0], axes[1]), axes[2]) < 0.0:
        scale[0] = -scale[0]
    rotation = np.eye(4)
    rotation[:3, :3] = m[:3, :3] / np.where(scale == 0.0, 1.0, scale)
    return m[:3, 3].copy(), matrix_to_quaternion(rotation), scale

"""Products, lengths and unit vectors of arrays of 3-D vectors.

In: arrays whose last axis has length 3, which broadcast against each other. Out: float64.
Sums run in the order x, y, z, so that the result does not depend on NumPy's summation.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import InvalidArgumentError
from ..numbers import floats
from . import single

FloatArray = npt.NDArray[np.float64]


def as_vectors(name: str, values: npt.ArrayLike, size: int = 3) -> FloatArray:
    """Return `values` as float64 whose last axis has length `size`, or say which argument isn't."""
    if type(values) is np.ndarray and values.dtype == np.float64:
        vectors = values
    else:
        vectors = floats(values, name)
    if vectors.ndim == 0 or vectors.shape[-1] != size:
        raise InvalidArgumentError(f"{name} must have shape (..., {size}), not {vectors.shape}")
    return vectors


@np.errstate(over="ignore", invalid="ignore")  # overflow gives infinity
def dot(a: npt.ArrayLike, b: npt.ArrayLike) -> Any:
    """Return the scalar products of vectors.

    Parameters
    ----------
    a, b : array_like, shape (..., 3)
        Vectors that broadcast against each other.

    Returns
    -------
    ndarray of float64, shape (...)

    Raises
    ------
    InvalidArgumentError
        If the last axis of an argument isn't 3 long.
    """
    a, b = as_vectors("a", a), as_vectors("b", b)
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


@np.errstate(over="ignore", invalid="ignore")  # overflow gives infinity
def cross(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """Return the right-handed vector products ``a x b``.

    Parameters
    ----------
    a, b : array_like, shape (..., 3)
        Vectors that broadcast against each other.

    Returns
    -------
    ndarray of float64, shape (..., 3)

    Raises
    ------
    InvalidArgumentError
        If the last axis of an argument isn't 3 long.
    """
    a, b = as_vectors("a", a), as_vectors("b", b)
    return np.stack(
        (
            a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1],
            a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2],
            a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0],
        ),
        axis=-1,
    )


def length(v: npt.ArrayLike) -> Any:
    """Return the Euclidean lengths of vectors, shape (..., 3) to shape (...)."""
    v = as_vectors("v", v)
    return np.sqrt(dot(v, v))


@np.errstate(over="ignore", invalid="ignore")  # overflow gives infinity
def normalize(v: npt.ArrayLike) -> FloatArray:
    """Return vectors scaled to length 1; null vectors stay null.

    Vectors are first divided by their largest component, so that no finite vector overflows or
    underflows.

    Parameters
    ----------
    v : array_like, shape (..., 3)

    Returns
    -------
    ndarray of float64, shape (..., 3)

    Raises
    ------
    InvalidArgumentError
        If the last axis isn't 3 long.
    """
    v = as_vectors("v", v)
    if v.ndim == 1 and math.isfinite(sum(v.tolist())):
        return np.array(single.normalize(v.tolist()))
    largest = np.max(np.abs(v), axis=-1, keepdims=True)
    scaled = v / np.where(largest == 0.0, 1.0, largest)
    norm = length(scaled)[..., np.newaxis]
    return scaled / np.where(norm == 0.0, 1.0, norm)

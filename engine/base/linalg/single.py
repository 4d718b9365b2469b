"""Linear algebra for one matrix, vector, quaternion or angle in plain Python floats.

In: floats; vectors as tuples, matrices as sequences of rows. Out: the same. Each function does the
operations of its array counterpart in the same order, so that both give the same bits; for a single
small value, NumPy's call overhead is ten times the arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

Vector = tuple[float, float, float]
Rows = Sequence[Sequence[float]]


def multiply(a: Rows, b: Rows) -> list[tuple[float, ...]]:
    """Return the product of two 4x4 matrices."""
    (b00, b01, b02, b03), (b10, b11, b12, b13), (b20, b21, b22, b23), (b30, b31, b32, b33) = b
    return [
        (
            x * b00 + y * b10 + z * b20 + w * b30,
            x * b01 + y * b11 + z * b21 + w * b31,
            x * b02 + y * b12 + z * b22 + w * b32,
            x * b03 + y * b13 + z * b23 + w * b33,
        )
        for x, y, z, w in a
    ]


def dot(a: Iterable[float], b: Iterable[float]) -> float:
    """Return the scalar product."""
    ax, ay, az = a
    bx, by, bz = b
    return ax * bx + ay * by + az * bz


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    ax, ay, az = a
    bx, by, bz = b
    return (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


def length(v: Iterable[float]) -> float:
    """Return the Euclidean length."""
    x, y, z = v
    return math.sqrt(x * x + y * y + z * z)


def normalize(v: Iterable[float]) -> Vector:
    """Return a finite vector at length 1; the null vector stays null."""
    x, y, z = v
    largest = max(abs(x), abs(y), abs(z)) or 1.0
    x, y, z = x / largest, y / largest, z / largest
    norm = math.sqrt(x * x + y * y + z * z) or 1.0
    return (x / norm, y / norm, z / norm)


def rotation(q: Sequence[float]) -> tuple[Vector, Vector, Vector] | None:
    """Return the 3x3 matrix of a quaternion; None if its length is zero or not finite."""
    x, y, z, w = q
    square = x * x + y * y
    square = square + z * z + w * w
    if not 0.0 < square < math.inf:
        return None
    norm = math.sqrt(square)
    x, y, z, w = x / norm, y / norm, z / norm, w / norm
    x2, y2, z2 = x + x, y + y, z + z
    return (
        (1.0 - (y * y2 + z * z2), x * y2 - w * z2, x * z2 + w * y2),
        (x * y2 + w * z2, 1.0 - (x * x2 + z * z2), y * z2 - w * x2),
        (x * z2 - w * y2, y * z2 + w * x2, 1.0 - (x * x2 + y * y2)),
    )

"""One matrix, vector, quaternion or angle in plain Python floats.

In: floats; vectors as tuples, matrices as sequences of rows. Out: the same. Each function does the
operations of its array counterpart in the same order, so that both give the same bits; on one small
thing NumPy spends ten times as long on calls as on numbers.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

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


def inverse(m: Rows) -> list[list[float]] | None:
    """Return the inverse of a 4x4 matrix, or None if it has none."""
    a, b, c, d = m
    top, bottom = _pair_determinants(a, b), _pair_determinants(c, d)
    a0, a1, a2, a3 = _minors(b, bottom)
    b0, b1, b2, b3 = _minors(a, bottom)
    c0, c1, c2, c3 = _minors(d, top)
    d0, d1, d2, d3 = _minors(c, top)
    determinant = d[0] * -d0 + d[1] * d1 + d[2] * -d2 + d[3] * d3
    adjugate = (
        (a0, -b0, c0, -d0),
        (-a1, b1, -c1, d1),
        (a2, -b2, c2, -d2),
        (-a3, b3, -c3, d3),
    )
    if determinant == 0.0:
        return None
    result = [[entry / determinant + 0.0 for entry in row] for row in adjugate]
    return result if all(map(math.isfinite, itertools.chain(*result))) else None


def _pair_determinants(upper, lower) -> tuple[float, ...]:
    """The 2x2 determinants of two rows, by columns 01, 02, 03, 12, 13, 23."""
    u0, u1, u2, u3 = upper
    v0, v1, v2, v3 = lower
    return (
        u0 * v1 - u1 * v0,
        u0 * v2 - u2 * v0,
        u0 * v3 - u3 * v0,
        u1 * v2 - u2 * v1,
        u1 * v3 - u3 * v1,
        u2 * v3 - u3 * v2,
    )


def _minors(row, pairs) -> tuple[float, float, float, float]:
    """The 3x3 determinants of a row and a pair of others, without each of the columns."""
    r0, r1, r2, r3 = row
    p01, p02, p03, p12, p13, p23 = pairs
    return (
        r1 * p23 - r2 * p13 + r3 * p12,
        r0 * p23 - r2 * p03 + r3 * p02,
        r0 * p13 - r1 * p03 + r3 * p01,
        r0 * p12 - r1 * p02 + r2 * p01,
    )


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    ax, ay, az = a
    bx, by, bz = b
    return (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


def length(v: Vector) -> float:
    """Return the Euclidean length."""
    x, y, z = v
    return math.sqrt(x * x + y * y + z * z)


def normalize(v: Vector) -> Vector:
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

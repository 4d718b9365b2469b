"""The words of docs/exactness on NumPy arrays of float32: one IEEE operation each, in order.

NumPy rounds every operation by itself, so that an expression written here gives what the rules say.
"""

import numpy as np

ZERO, ONE = np.float32(0), np.float32(1)
UNORM8 = np.float32(float.fromhex("0x1.010102p-8"))
UNORM15 = np.float32(float.fromhex("0x1.0002p-15"))
UNORM15_BLENDED = UNORM15 * np.float32(2.0**-8)
UNORM8_BLENDED = np.float32(float.fromhex("0x1.03060ap-24"))


def _hexadecimal(text):
    return [np.float32(float.fromhex(word)) for word in text.split()]


LOG2 = _hexadecimal(
    "0x1.c5507p-2 -0x1.1d270ep-2 0x1.99e72p-3 -0x1.2cc076p-3 0x1.823526p-4 -0x1.5a65f6p-5 "
    "0x1.2b619ap-7"
)
EXP2 = _hexadecimal("0x1.3a37acp-2 0x1.10e326p-4 0x1.6d1682p-7 0x1.7e244cp-10 0x1.cb1d4cp-13")


def least(a, b):
    return np.where(a < b, a, b)


def greatest(a, b):
    return np.where(a > b, a, b)


def clamp(v, low, high):
    return least(greatest(v, low), high)


def round_even(v):
    return np.rint(v).astype(np.int32)


def truncate(v):
    return np.trunc(v).astype(np.int32)


def floor(v):
    whole = truncate(v).astype(np.float32)
    return whole - (whole > v).astype(np.float32)


def dot(a, b):
    """Of sequences of three arrays."""
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]


def unit(v):
    """R22: three arrays, divided by their length; zero, or no number, where it is of no use."""
    inverse = ONE / np.sqrt(greatest(np.float32(2.0**-126), dot(v, v)))
    return [component * inverse for component in v]


def log2(q):
    """R27, for positive normal numbers."""
    q = np.ascontiguousarray(q, np.float32)
    exponent = ((q.view(np.int32) >> 23) - 127).astype(np.float32)
    t = ((q.view(np.int32) & 0x7FFFFF) | 0x3F800000).view(np.float32) - ONE
    total = np.full_like(t, LOG2[-1])
    for coefficient in LOG2[-2::-1]:
        total = total * t + coefficient
    return exponent + (t + (t * (ONE - t)) * total)


def exp2(y):
    """R27."""
    y = clamp(y, np.float32(-126), np.float32(126))
    whole = floor(y)
    f = y - whole
    total = np.full_like(f, EXP2[-1])
    for coefficient in EXP2[-2::-1]:
        total = total * f + coefficient
    fraction = (ONE + f) + (f * (f - ONE)) * total
    return fraction * ((whole.astype(np.int32) + 127) << 23).view(np.float32)


def power(x, n):
    """R27."""
    usable = x >= np.float32(2.0**-100)
    return np.where(usable, exp2(n * log2(np.where(usable, x, ONE))), ZERO)

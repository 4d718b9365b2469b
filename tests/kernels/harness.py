"""What every test of a kernel shares: backends, hostile numbers, poisoned records, comparison.

Kernels write records of memory that was filled with 0xDEADBEEF and lies between gaps of the same.
Afterwards the elements that were promised must be the oracle's, those up to PAD further may be
anything, and everything else must still be poison.
"""

import numpy as np
import pytest
from kernels.kernels import Kernels
from kernels.layouts import PAD

from engine3d._native import rasterizer

POISON = 0xDEADBEEF
GAP = 128  # bytes of poison around each record

all_backends = pytest.mark.parametrize(
    "kernels", [name for name in rasterizer.BACKENDS if name != "scalar"], indirect=True
)


def kernels_of(name):
    """The kernels of a backend; the test is skipped where there are none."""
    try:
        return Kernels(rasterizer.BACKENDS[name])
    except LookupError:
        pytest.skip(f"{name}: this build or CPU lacks it")


class Records:
    """`count` poisoned records of a struct, with gaps around them."""

    def __init__(self, struct, count):
        size = struct.itemsize
        self._bytes = np.full((count + 1, GAP + size), POISON & 0xFF, np.uint8)
        words = np.frombuffer(np.uint32(POISON).tobytes(), np.uint8)
        self._bytes[:, : (GAP + size) // 4 * 4] = np.tile(words, (GAP + size) // 4)
        self.rows = [self._bytes[i, GAP:] for i in range(count)]  # what a kernel is given
        self.fields = np.ndarray(
            (count,), struct, self._bytes.data, offset=GAP, strides=(GAP + size,)
        )
        self._gaps = self._bytes[:, :GAP].copy()

    def copy(self):
        """The same bytes in records of their own, for the next backend."""
        other = Records(self.fields.dtype, len(self.fields))
        other._bytes[:] = self._bytes
        return other

    def check_gaps(self):
        """Nothing was written before a record or after it."""
        assert np.array_equal(self._bytes[:, :GAP], self._gaps)


def poisoned(array):
    """Where 4-byte elements still are poison."""
    return np.ascontiguousarray(array).view(np.uint32) == POISON


def bits(array):
    """The bits of an array, with one representation for every NaN."""
    array = np.ascontiguousarray(array)
    if array.dtype != np.float32:
        return array
    return np.where(np.isnan(array), np.uint32(0x7FC00000), array.view(np.uint32))


def check_lanes(name, got, expected, counts):
    """Compare a field, (records, lanes): the promised lanes, and those after the pad."""
    lanes = np.arange(got.shape[1])
    promised = lanes < np.asarray(counts)[:, None]
    expected = np.broadcast_to(expected, got.shape)
    assert expected.dtype == got.dtype, name
    wrong = promised & (bits(got) != bits(expected))
    if wrong.any():
        record, lane = np.argwhere(wrong)[0]
        raise AssertionError(
            f"{name}: {wrong.sum()} lanes differ, first lane {lane} of record {record} "
            f"({counts[record]} lanes): {got[record, lane]!r}, not {expected[record, lane]!r}"
        )
    untouched = lanes >= np.asarray(counts)[:, None] + PAD
    assert poisoned(got)[untouched].all(), f"{name}: written beyond the pad"


def check_poisoned(fields, names):
    """Fields that a kernel has no business with."""
    for name in names:
        assert poisoned(fields[name]).all(), f"{name} was written"


SPECIAL = np.array(
    [0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 2.0, np.inf, -np.inf, np.nan, -np.nan]
    + [1.4e-45, -1.4e-45, 1.1754942e-38, -1.1754942e-38, 1.1754944e-38, -1.1754944e-38]
    + [3.4028235e38, -3.4028235e38, 1e30, -1e30, 1e-30, -1e-30, 2.0**20, -(2.0**20)]
    + [2.0**-20, 2.0**23, 2.0**24, 2.0**26, 2.0**31, -(2.0**31), 0.99999994, 1.0000001, 2.0**-126],
    np.float32,
)


def hostile(rng, shape, scale=1.0, rate=0.05, finite=False):
    """Random float32: mostly within ±scale, the rest special values and arbitrary bits."""
    values = rng.uniform(-scale, scale, shape).astype(np.float32)
    kind = rng.random(shape)
    special = SPECIAL[rng.integers(0, len(SPECIAL), shape)]
    anything = rng.integers(0, 2**32, shape, np.uint32).view(np.float32)
    values = np.where(kind < rate, anything, values)
    values = np.where(kind < rate / 2, special, values)
    if finite:
        values = np.where(np.isfinite(values), values, np.float32(scale))
    return values


def every_count(rng, most, calls):
    """Lengths of `calls` arrays: each of 0 … most at least once, the others mostly long."""
    counts = np.arange(most + 1)
    more = np.where(
        rng.random(calls - len(counts)) < 0.7, most, rng.integers(0, most + 1, calls - len(counts))
    )
    return rng.permutation(np.concatenate([counts, more]))

"""Compares two pixel arrays: how many pixels differ, where, and by how much.

In:  what was drawn and what was expected. Out: a `Difference`. By default every bit counts: a pixel
     differs if any of its channels does. Where something is allowed, it is what the caller says.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .pixel_hash import describe


@dataclass(frozen=True)
class Difference:
    """The difference of two pictures.

    Attributes
    ----------
    mask : (H, W) bool array
        The pixels that differ; of pictures of two sizes, all that only one has.
    amount : (H, W) float32 array
        The largest difference of the channels of a pixel, 0 to 1: of colours, 1 is black and white;
        of other numbers, 1 is the range of what was expected.
    largest : float
        The largest difference of a channel, in the numbers of the arrays; infinite where only one
        is finite.
    kinds : str
        Why they cannot be equal, in a few words; else empty.
    """

    mask: np.ndarray
    amount: np.ndarray
    largest: float
    kinds: str = ""

    @property
    def different(self) -> int:
        """Number of differing pixels."""
        return int(np.count_nonzero(self.mask))

    @property
    def total(self) -> int:
        """Total number of pixels."""
        return self.mask.size

    @property
    def box(self) -> tuple[int, int, int, int] | None:
        """Bounding rectangle of the differences: left, top, right, bottom, ends excluded."""
        rows, columns = (np.flatnonzero(self.mask.any(axis=axis)) for axis in (1, 0))
        if not rows.size:
            return None
        return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1

    def __str__(self) -> str:
        if self.kinds:
            return self.kinds
        if self.box is None:
            return "equal"
        left, top, right, bottom = self.box
        count = f"{self.different:,} of {self.total:,} pixels differ"
        place = f"within ({left}, {top}) to ({right - 1}, {bottom - 1})"
        return f"{count} by up to {self.largest:.6g}, {place}"


def compare(actual: np.ndarray, expected: np.ndarray, tolerance: float = 0) -> Difference:
    """Compare two arrays of pixels.

    Parameters
    ----------
    actual, expected : (H, W) or (H, W, 1 to 4) arrays
        Colours of 8 bits are compared as RGBA, grey and opaque ones too; 16 bits beside 8 as 16.
        Anything else of two types or numbers of channels differs everywhere.
    tolerance : float, optional
        What a channel may differ by, in the numbers of the arrays. 0: the bits are compared.
    """
    kinds = ""
    if actual.shape[:2] != expected.shape[:2]:
        kinds = f"it is {describe(actual)}, not {describe(expected)}"
    pair = _alike(actual, expected)
    if pair is None:
        kinds = f"it is {describe(actual)}, not {describe(expected)}"
        return _all_different(actual, expected, kinds)
    height, width = (max(a, b) for a, b in zip(actual.shape[:2], expected.shape[:2], strict=True))
    mask, amount = np.ones((height, width), bool), np.ones((height, width), np.float32)
    shared = tuple(
        slice(min(a, b)) for a, b in zip(actual.shape[:2], expected.shape[:2], strict=True)
    )
    mask[shared], distance = _different(pair[0][shared], pair[1][shared], tolerance)
    largest = float(distance.max())
    with np.errstate(all="ignore"):
        amount[shared] = np.minimum(distance / _range(pair[1]), 1.0)
    return Difference(mask, amount, largest, kinds)


def root_mean_square(actual: np.ndarray, expected: np.ndarray) -> float:
    """Return the root mean square of the channel differences of two pictures, 0 to 1.

    Parameters
    ----------
    actual, expected : (H, W, 1 to 4) uint8 arrays
        Those of two sizes differ by 1.
    """
    if actual.shape[:2] != expected.shape[:2]:
        return 1.0
    offsets = np.subtract(*_alike(actual, expected), dtype=np.int32)
    squares = int((offsets * offsets).sum(dtype=np.int64))
    return (squares / (offsets.size * 255.0 * 255.0)) ** 0.5


def _all_different(actual: np.ndarray, expected: np.ndarray, kinds: str) -> Difference:
    height, width = (max(a, b) for a, b in zip(actual.shape[:2], expected.shape[:2], strict=True))
    ones = np.ones((height, width), np.float32)
    return Difference(ones > 0, ones, float("inf"), kinds)


def _alike(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Return both as (H, W, C) with one dtype and channel count; None if impossible."""
    if a.dtype != b.dtype:
        if {a.dtype, b.dtype} != {np.dtype(np.uint8), np.dtype(np.uint16)}:
            return None
        a, b = (one if one.dtype == np.uint16 else one * np.uint16(257) for one in (a, b))
    a, b = (one.reshape(*one.shape[:2], -1) for one in (a, b))
    if a.shape[2] == b.shape[2]:
        return a, b
    if a.dtype not in (np.uint8, np.uint16):
        return None
    return _with_alpha(a), _with_alpha(b)


def _with_alpha(colors: np.ndarray) -> np.ndarray:
    count = colors.shape[2]
    rgba = np.full((*colors.shape[:2], 4), np.iinfo(colors.dtype).max, colors.dtype)
    rgba[..., :3] = colors[..., :3] if count > 2 else colors[..., :1]
    if count in (2, 4):
        rgba[..., 3] = colors[..., -1]
    return rgba


def _different(a: np.ndarray, b: np.ndarray, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """Return which pixels of (H, W, C) arrays differ, and the largest distance of each."""
    distance: np.ndarray
    if a.dtype.kind == "f":
        distance = _distance_of_floats(a, b)
        bits = f"u{a.dtype.itemsize}"
        unlike = distance > tolerance if tolerance else _bits(a, bits) != _bits(b, bits)
    else:
        # The distance of 64-bit numbers may be rounded; the comparison is exact.
        wide = np.int32 if a.dtype.itemsize < 4 and a.dtype.kind != "b" else np.float64
        distance = np.abs(a.astype(wide) - b.astype(wide))
        unlike = distance > tolerance if tolerance else a != b
    return unlike.any(axis=2), distance.max(axis=2)


def _bits(values: np.ndarray, dtype: str) -> np.ndarray:
    return np.ascontiguousarray(values).view(dtype)


def _distance_of_floats(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    with np.errstate(all="ignore"):
        distance = np.abs(a.astype(np.float64) - b.astype(np.float64))
    both = (a == b) | (np.isnan(a) & np.isnan(b))
    return np.where(both, 0.0, np.where(np.isnan(distance), np.inf, distance))


def _range(expected: np.ndarray) -> float:
    """Return the difference that is shown as the maximum."""
    if expected.dtype in (np.uint8, np.uint16):
        return float(np.iinfo(expected.dtype).max)
    known = expected[np.isfinite(expected)] if expected.dtype.kind == "f" else expected
    span = float(known.max()) - float(known.min()) if known.size else 0.0
    return span or 1.0

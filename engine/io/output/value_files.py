"""Files of numbers per pixel, as data sets of depth, disparity and optical flow have them.

In: an array, and which of its pixels are valid. Out: bytes, in which the others are marked as the
format marks them. The same bytes everywhere.
Sources: the README of Middlebury's flow code (.flo); the development kits of KITTI 2015 (16-bit
.png); Paul Debevec's PFM as Middlebury's stereo sets use it, and the Scene Flow data sets for flow.
"""

from __future__ import annotations

import io
import os
import struct
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.calls import checks_types
from ...base.files.atomic_write import atomic_write, checked_path
from ...base.files.png import encode_pixels
from ...base.numbers import as_array
from ...base.validation import choose
from ...errors import InvalidArgumentError, warn
from .exr_writer import encode_exr

Floats: TypeAlias = NDArray[np.float32]
Mask: TypeAlias = NDArray[np.bool_]

_FLO_MAGIC = 202021.25
_FLO_UNKNOWN = 1e10
_FLOW_STEPS, _FLOW_MIDDLE = 64.0, 32768.0
_STEPS = 256.0
_MOST = 65535.0
_CHANNELS = {1: "Y", 2: "RG", 3: "RGB"}


@checks_types
def save_values(
    path: str | os.PathLike[str], values: ArrayLike, *, valid: ArrayLike | None = None
) -> None:
    """Write numbers per pixel, such as depths, disparities or flow, whole or not at all.

    Parameters
    ----------
    path : path-like
        The suffix decides the format:

        - .npy: any array; NaN where not valid (floats only).
        - .npz: the arrays ``values`` and ``valid``.
        - .pfm: one or three channels of float32, or flow, whose third channel is 0; infinite where
          not valid.
        - .exr: float32, channel Y, or R and G, or R, G and B, uncompressed; NaN where not valid.
        - .flo: flow; 1e10 where not valid.
        - .png: as KITTI has them: one channel of 16 bits in steps of 1/256, 0 where not valid, so
          0 to 255.99; or flow in steps of 1/64, from -512 to 511.98, with a channel for valid.
          A mask is black and white.
    values : (H, W) or (H, W, channels) number
    valid : (H, W) bool, optional
        By default all.

    Raises
    ------
    InvalidArgumentError
        The format does not hold such an array.
    FileAccessError

    Warns
    -----
    Engine3DWarning
        Values do not fit 16 bits: they are marked as not valid.
    """
    suffix = os.path.splitext(checked_path(path))[1].lstrip(".").lower()
    data = encode_values(values, suffix, valid=valid)
    with atomic_write(path) as file:
        file.write(data)


def encode_values(values: ArrayLike, suffix: str, *, valid: ArrayLike | None = None) -> bytes:
    """Return the bytes of a file, as for `save_values`; the suffix is without a dot."""
    choose(suffix, _FORMATS, "the suffix of numbers per pixel")
    array = as_array(values, "values")
    if array.ndim not in (2, 3) or 0 in array.shape or array.dtype.kind not in "buif":
        raise InvalidArgumentError(
            f"values must be (H, W) or (H, W, channels) numbers, not {array.shape} {array.dtype}"
        )
    mask = np.ones(array.shape[:2], bool) if valid is None else as_array(valid, "valid")
    if mask.shape != array.shape[:2] or mask.dtype != np.bool_:
        raise InvalidArgumentError(
            f"valid must be {array.shape[:2]} bool, not {mask.shape} {mask.dtype}"
        )
    encode, _ = _FORMATS[suffix]
    return encode(array, mask)


def channels_of(array: NDArray[np.generic]) -> int:
    """Return the number of channels of (H, W) or (H, W, channels)."""
    return 1 if array.ndim == 2 else array.shape[2]


def _floats(array: NDArray[np.generic], suffix: str, allowed: tuple[int, ...]) -> Floats:
    """Return an array as (H, W, channels) float32, if a format may hold it."""
    if array.dtype.kind != "f" or channels_of(array) not in allowed:
        counts = " or ".join(map(str, allowed))
        raise InvalidArgumentError(
            f".{suffix} holds floats of {counts} channels, not {array.shape} {array.dtype}: "
            ".npy and .npz hold any array"
        )
    return array.astype(np.float32).reshape(*array.shape[:2], -1)


def _marked(floats: Floats, valid: Mask, mark: float) -> Floats:
    return np.where(valid[..., np.newaxis], floats, np.float32(mark))


def _npy(array: NDArray[np.generic], valid: Mask) -> bytes:
    if not valid.all():
        if array.dtype.kind != "f":
            raise InvalidArgumentError(".npy marks what is not valid as NaN: only in floats")
        array = np.where(valid.reshape(*valid.shape, *(1,) * (array.ndim - 2)), array, np.nan)
    data = io.BytesIO()
    np.save(data, array)
    return data.getvalue()


def _npz(array: NDArray[np.generic], valid: Mask) -> bytes:
    data = io.BytesIO()
    np.savez(data, values=array, valid=valid)  # compressed bytes would depend on zlib's build
    return data.getvalue()


def _flo(array: NDArray[np.generic], valid: Mask) -> bytes:
    flow = _marked(_floats(array, "flo", (2,)), valid, _FLO_UNKNOWN)
    height, width = valid.shape
    return struct.pack("<fii", _FLO_MAGIC, width, height) + flow.astype("<f4").tobytes()


def _pfm(array: NDArray[np.generic], valid: Mask) -> bytes:
    rows = _marked(_floats(array, "pfm", (1, 2, 3)), valid, np.inf)
    if rows.shape[2] == 2:
        rows = np.concatenate([rows, np.zeros_like(rows[..., :1])], axis=2)
    height, width, channels = rows.shape
    head = f"{'Pf' if channels == 1 else 'PF'}\n{width} {height}\n-1.0\n"
    return head.encode() + rows[::-1].astype("<f4").tobytes()


def _exr(array: NDArray[np.generic], valid: Mask) -> bytes:
    rows = _marked(_floats(array, "exr", (1, 2, 3)), valid, np.nan)
    return encode_exr({name: rows[..., k] for k, name in enumerate(_CHANNELS[rows.shape[2]])})


def _png(array: NDArray[np.generic], valid: Mask) -> bytes:
    if array.dtype == np.bool_ and channels_of(array) == 1:
        return encode_pixels(np.logical_and(array.reshape(valid.shape), valid))
    floats = _floats(array, "png", (1, 2)).astype(np.float64)
    if floats.shape[2] == 2:
        codes, fits = _steps(floats * _FLOW_STEPS + _FLOW_MIDDLE, 0.0, valid)
        return encode_pixels(np.concatenate([codes, fits[..., np.newaxis]], axis=2))
    steps = floats * _STEPS
    lifted = np.where((steps >= 0.0) & (steps < 1.0), 1.0, steps)  # 0 is taken
    codes, _ = _steps(lifted, 1.0, valid)
    return encode_pixels(codes)


def _steps(
    values: NDArray[np.float64], least: float, valid: Mask
) -> tuple[NDArray[np.uint16], NDArray[np.uint16]]:
    """Return values as whole numbers from a least one on, 0 where not valid; and 1 where valid."""
    codes = np.floor(values + 0.5)
    fits = valid & ((codes >= least) & (codes <= _MOST)).all(axis=2)
    lost = int((valid & ~fits).sum())
    if lost:
        warn(f"{lost} pixels have values that 16 bits do not hold: they are marked as not valid")
    kept = np.where(fits[..., np.newaxis], codes, 0.0)
    return kept.astype(np.uint16), fits.astype(np.uint16)


# By suffix: what encodes, and how it marks what is not valid, in words for people.
_FORMATS: dict[str, tuple[Callable[[NDArray[np.generic], Mask], bytes], str]] = {
    "npy": (_npy, "NaN where not valid."),
    "npz": (_npz, "Arrays values and valid."),
    "pfm": (
        _pfm,
        "Infinite where not valid; rows from the bottom up; of flow, the third channel is 0.",
    ),
    "exr": (_exr, "NaN where not valid."),
    "flo": (_flo, "1e10 where not valid (Middlebury)."),
    "png": (
        _png,
        "16 bits as KITTI: one channel holds 256 times the value, 0 where not valid; flow holds "
        "64 times the value + 32768, and 1 where valid in blue. Masks are black and white.",
    ),
}
#: How each format marks what is not valid, by suffix.
MARKS = {suffix: mark for suffix, (_, mark) in _FORMATS.items()}

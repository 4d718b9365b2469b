"""Run-length encoded masks, in COCO's compressed text format.

In: masks. Out: ``{"size": [height, width], "counts": text}``, and back. Runs go down the columns,
from left to right: how many pixels are out, then in, then out, and so on. From the fourth run on,
the difference from the one two before is written: five bits a character, the lowest first, 32 more
where others follow, 48 more to be printable.
Source: the format that the COCO API reads (rleToString of its maskApi), written anew.
"""

from __future__ import annotations

import operator
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from ...base.calls import checks_types
from ...base.numbers import as_array, shown
from ...errors import InvalidArgumentError

_FIRST = 48  # the character "0"
_MORE, _SIGN, _BITS = 0x20, 0x10, 0x1F


class Rle(TypedDict):
    """A mask as in COCO's files."""

    size: list[int]
    counts: str


def encode_rle(mask: NDArray[np.bool_]) -> Rle:
    """Return a mask as run lengths.

    Parameters
    ----------
    mask : (H, W) bool

    Returns
    -------
    dict
        ``size`` and ``counts``, as COCO has them.

    Raises
    ------
    InvalidArgumentError
    """
    mask = as_array(mask, "mask")
    if mask.ndim != 2 or mask.dtype != np.bool_:
        raise InvalidArgumentError(f"mask must be (H, W) bool, not {mask.dtype} {mask.shape}")
    column = mask.ravel(order="F")
    changes = np.flatnonzero(column[1:] != column[:-1]) + 1
    begins_inside = [0] if column.size and column[0] else []
    edges = [0, *begins_inside, *changes.tolist(), column.size]
    runs = [b - a for a, b in zip(edges, edges[1:], strict=False)]
    return {"size": list(mask.shape), "counts": _packed(runs)}


@checks_types
def decode_rle(rle: Rle) -> NDArray[np.bool_]:
    """Return the mask, (H, W) bool, of an `encode_rle` result.

    Raises
    ------
    InvalidArgumentError
        The runs are not as many pixels as the picture has, or no runs at all.
    """
    try:
        height, width = map(operator.index, rle["size"])
        runs = _unpacked(rle["counts"])
    except (KeyError, TypeError, ValueError):
        raise InvalidArgumentError(
            f"rle must be a dict of size, two whole numbers, and counts, a text: {shown(rle)}"
        ) from None
    if sum(runs) != height * width or any(run < 0 for run in runs):
        raise InvalidArgumentError(f"these are no runs of {width}x{height} pixels")
    inside = np.arange(len(runs)) % 2 == 1
    return np.repeat(inside, runs).reshape((height, width), order="F")


def _packed(runs: list[int]) -> str:
    characters = bytearray()
    for number, run in enumerate(runs):
        rest = run - runs[number - 2] if number > 2 else run
        while True:
            bits, rest = rest & _BITS, rest >> 5
            if rest == (-1 if bits & _SIGN else 0):
                characters.append(bits + _FIRST)
                break
            characters.append((bits | _MORE) + _FIRST)
    return characters.decode("ascii")


def _unpacked(text: str) -> list[int]:
    runs: list[int] = []
    value = shift = 0
    for character in text:
        bits = ord(character) - _FIRST
        if not 0 <= bits < 2 * _MORE:
            raise InvalidArgumentError(f"{shown(text)} is no text of run lengths")
        value |= (bits & _BITS) << shift
        shift += 5
        if bits & _MORE:
            continue
        if bits & _SIGN:
            value -= 1 << shift
        runs.append(value + runs[-2] if len(runs) > 2 else value)
        value = shift = 0
    return runs

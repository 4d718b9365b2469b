"""Converts pictures of all kinds to pixels for a window.

In: a frame, a canvas, or an array of pixels. Out: (H, W, 4) uint8, and the order of its bytes.
"""

from __future__ import annotations

from typing import Any, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import as_array
from ...choices import PixelFormat
from ...errors import InvalidArgumentError
from ...rendering.canvas import Canvas
from ...rendering.frame import Frame

Picture: TypeAlias = Frame | Canvas | NDArray[Any]
FORMATS = get_args(PixelFormat)
KINDS = (
    "a picture is a Frame, a Canvas, or an array: (H, W, 4) or (H, W, 3) uint8, (H, W) uint8 "
    "for grey, or (H, W) uint32 with its format"
)


def as_pixels(picture, format: PixelFormat | None = None) -> tuple[NDArray[np.uint8], PixelFormat]:
    """Return a picture's pixels, (H, W, 4) uint8, top row first, and their byte order.

    Parameters
    ----------
    picture, format
        As for `engine3d.Window.present`.

    Raises
    ------
    InvalidArgumentError
        It is no picture, or its format is missing or unknown.
    """
    if format is not None and format not in FORMATS:
        raise InvalidArgumentError(f"format must be one of {', '.join(FORMATS)}, not {format!r}")
    if isinstance(picture, Canvas):
        picture = picture.pixels
    elif isinstance(picture, Frame):
        picture = picture.color
    pixels = as_array(picture, "picture")
    if pixels.size == 0:
        raise InvalidArgumentError("the picture has no pixels")
    if pixels.dtype == np.uint32 and pixels.ndim == 2:
        pixels = _bytes_of_words(pixels, format)
    if pixels.dtype != np.uint8:
        raise InvalidArgumentError(f"{KINDS}; this one is {_kind(pixels)}")
    return _four_channels(pixels), format or "rgba"


def _bytes_of_words(words: NDArray[np.uint32], format: PixelFormat | None) -> NDArray[np.uint8]:
    if format is None:
        raise InvalidArgumentError(
            'an array of 32-bit words needs its format: "bgra" if words are 0xAARRGGBB, "rgba" '
            "if they are 0xAABBGGRR"
        )
    little = np.ascontiguousarray(words, dtype="<u4")
    return little.view(np.uint8).reshape(*words.shape, 4)


def _four_channels(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[:, :, np.newaxis], 3, axis=2)
    if pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        raise InvalidArgumentError(f"{KINDS}; this one is {_kind(pixels)}")
    if pixels.shape[2] == 3:
        opaque = np.full((*pixels.shape[:2], 4), 255, np.uint8)
        opaque[:, :, :3] = pixels
        return opaque
    return np.ascontiguousarray(pixels)


def _kind(pixels: np.ndarray) -> str:
    return f"{pixels.shape} {pixels.dtype}"

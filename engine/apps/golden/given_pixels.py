"""Converts pictures given by tests to pixel arrays.

In:  a `Frame`, a `Canvas`, an image of Pillow's, an array, or the path of an image file.
Out: an (H, W) or (H, W, C) array, C from 1 to 4, the top row first.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ...base.numbers import as_array
from ...errors import InvalidArgumentError

_KINDS = "biuf"
MAX_CHANNELS = 4


def as_pixels(picture: Any) -> np.ndarray:
    """Return the pixels of a picture given by a test, contiguous and little-endian.

    Parameters
    ----------
    picture : Frame, Canvas, PIL.Image.Image, array, or path of an image file
        Of a frame the colour counts; its other outputs are arrays. Of an animation the first
        picture counts, or of Pillow's the current one.

    Raises
    ------
    InvalidArgumentError
        It is none of these, has no pixels, or more than four channels.
    FileAccessError, FileFormatError
        The file cannot be read.
    """
    if isinstance(picture, str | os.PathLike):
        from .reading import read_picture

        return read_picture(picture).frames[0]
    if hasattr(picture, "getbands"):
        from .picture_files import image_pixels

        return image_pixels(picture)
    pixels = as_array(getattr(picture, "pixels", picture), "a picture")
    if pixels.dtype.kind not in _KINDS or pixels.dtype.itemsize > 8:
        what = pixels.dtype if pixels.ndim else type(picture).__name__
        raise InvalidArgumentError(f"a picture holds numbers, and {what} is none of their types")
    if pixels.ndim not in (2, 3) or 0 in pixels.shape or pixels.shape[2:] > (MAX_CHANNELS,):
        raise InvalidArgumentError(
            f"a picture is (H, W) or (H, W, 1 to {MAX_CHANNELS}), not {pixels.shape}"
        )
    return np.ascontiguousarray(pixels, pixels.dtype.newbyteorder("<"))

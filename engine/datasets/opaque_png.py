"""Pictures without alpha as PNG files: the same bytes on every machine.

In: arrays of grey or RGB pixels. Out: the bytes of a file, by the core's own compressor.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._native.images import encode_opaque_png
from ..rendering.frame import Frame


def grey_png(pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """Return a PNG file of (H, W) pixels, uint8 or uint16."""
    if pixels.dtype == np.uint16:
        rows = np.ascontiguousarray(pixels, ">u2")
        return encode_opaque_png(rows.view(np.uint8).reshape(*pixels.shape, 2))
    return encode_opaque_png(np.ascontiguousarray(pixels, np.uint8)[..., np.newaxis])


def mask_png(mask: NDArray[np.bool_]) -> bytes:
    """Return a PNG file of an (H, W) mask: 255 where it is True, else 0."""
    return grey_png(mask.astype(np.uint8) * np.uint8(255))


def color_png(frame: Frame) -> bytes:
    """Return a PNG file of a frame's colour, RGB: many readers of data sets expect no alpha."""
    return encode_opaque_png(np.ascontiguousarray(frame.color[..., :3]))

"""PNG encoding of pixel arrays, with the same bytes on every machine.

In: grey, RGB or RGBA pixels. Out: the bytes of a file, by the core's own compressor.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..._native.images import encode_png


def encode_pixels(pixels: NDArray[np.uint8] | NDArray[np.uint16] | NDArray[np.bool_]) -> bytes:
    """Return pixels, (H, W) or (H, W, 1 to 4), uint8, uint16 or bool (True is white), as PNG.

    Raises `InvalidArgumentError` if a side exceeds 16384.
    """
    height, width = pixels.shape[:2]
    deep = pixels.dtype == np.uint16
    if pixels.dtype == np.bool_:
        pixels = pixels * np.uint8(255)
    codes = np.ascontiguousarray(pixels, ">u2" if deep else np.uint8)
    return encode_png(codes.view(np.uint8).reshape(height, width, -1), 16 if deep else 8)

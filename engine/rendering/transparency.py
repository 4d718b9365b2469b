"""Refuses to write transparent pictures in formats without alpha.

In: pixels, (H, W, 4) uint8 RGBA. Out: nothing, or an error: transparent pixels would turn black.
"""

from __future__ import annotations

import numpy as np

from ..errors import InvalidArgumentError


def refuse_transparency(pixels: np.ndarray, format: str) -> None:
    """Raise `InvalidArgumentError` unless every pixel is opaque."""
    if pixels[..., 3].min(initial=255) < 255:
        raise InvalidArgumentError(
            f"the picture needs transparency, which {format} lacks: write a PNG, or draw it before "
            "a scene.background"
        )

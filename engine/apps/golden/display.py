"""Converts arrays of any content to 8-bit RGBA for display.

In:  (H, W) or (H, W, 1 to 4) numbers. Out: (H, W, 4) uint8. Colours stay; 16 bits lose the lower
     ones; floats run from the least to the greatest; whole numbers, which may be identities, have a
     colour each, -1 being black.
"""

from __future__ import annotations

import numpy as np

_NOT_A_NUMBER = (255, 0, 255)
# An odd multiplier that spreads over 32 bits, so that neighbouring IDs get different colours.
_SPREAD = np.uint32(2654435769)


def displayed(pixels: np.ndarray, like: np.ndarray | None = None) -> np.ndarray:
    """Return pixels converted for display.

    Parameters
    ----------
    pixels : (H, W) or (H, W, 1 to 4) array
    like : array, optional
        Another array: the range of its floats is taken, so that both are shown alike.
    """
    like = pixels if like is None else like
    if pixels.dtype == np.bool_:
        return _rgba(pixels.astype(np.uint8) * np.uint8(255))
    if pixels.dtype == np.uint8:
        return _rgba(pixels)
    if pixels.dtype == np.uint16:
        return _rgba((pixels >> 8).astype(np.uint8))
    if pixels.dtype.kind == "f":
        return _shown_floats(pixels, like)
    if pixels.ndim == 2 or pixels.shape[2] == 1:
        return _identities(pixels.reshape(pixels.shape[:2]))
    return _shown_floats(pixels.astype(np.float64), like.astype(np.float64))


def _rgba(codes: np.ndarray) -> np.ndarray:
    height, width = codes.shape[:2]
    channels = codes.reshape(height, width, -1)
    count = channels.shape[2]
    shown = np.full((height, width, 4), 255, np.uint8)
    shown[..., :3] = channels[..., :3] if count > 2 else channels[..., :1]
    if count in (2, 4):
        shown[..., 3] = channels[..., -1]
    return shown


def _shown_floats(values: np.ndarray, like: np.ndarray) -> np.ndarray:
    known = like[np.isfinite(like)]
    low, high = (known.min(), known.max()) if known.size else (0.0, 1.0)
    # Computed in halves, because the range of finite numbers may overflow.
    span = float(high) / 2 - float(low) / 2
    with np.errstate(all="ignore"):
        share = (values.astype(np.float64) / 2 - float(low) / 2) / (span or 1.0)
    codes = np.nan_to_num(np.clip(share, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)
    height, width = values.shape[:2]
    layers = codes.reshape(height, width, -1)
    if layers.shape[2] == 2:  # no alpha: two numbers, such as texture coordinates
        layers = np.dstack([layers, np.zeros((height, width), np.uint8)])
    shown = _rgba(layers[..., :3])
    shown[np.isnan(values).reshape(height, width, -1).any(axis=2), :3] = _NOT_A_NUMBER
    return shown


def _identities(numbers: np.ndarray) -> np.ndarray:
    mixed = numbers.astype(np.int64).astype(np.uint32) * _SPREAD
    shown = np.full((*numbers.shape, 4), 255, np.uint8)
    for channel, shift in enumerate((24, 15, 6)):
        shown[..., channel] = (mixed >> np.uint32(shift) & np.uint32(0xBF)) + 64
    shown[numbers == -1, :3] = 0
    return shown

"""The hash of a pixel array, and its short description."""

from __future__ import annotations

import hashlib

import numpy as np


def pixel_hash(pixels: np.ndarray) -> str:
    """Return the SHA-256 of an array's dtype, shape and bytes."""
    summary = hashlib.sha256(f"{pixels.dtype.name} {pixels.shape}\n".encode())
    summary.update(np.ascontiguousarray(pixels))
    return summary.hexdigest()


def describe(pixels: np.ndarray) -> str:
    """Return size and type in brief: ``160x120 RGBA``, ``160x120 float32``."""
    height, width = pixels.shape[:2]
    channels = pixels.shape[2] if pixels.ndim == 3 else 0
    if pixels.dtype == np.uint8:
        return f"{width}x{height} {('grey', 'grey', 'grey and alpha', 'RGB', 'RGBA')[channels]}"
    return f"{width}x{height} {pixels.dtype.name}" + (f" x {channels}" if channels else "")

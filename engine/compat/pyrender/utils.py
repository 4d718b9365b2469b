"""Colours and images as pyrender reads them: whole numbers are of 0 to 255, others of 0 to 1."""

from __future__ import annotations

import numbers

import numpy as np


def format_color_vector(value, length: int) -> np.ndarray:
    """Return a colour as ``(length,)`` float32.

    Parameters
    ----------
    value : int, float, or sequence of numbers
        Whole numbers are divided by 255. What lacks is 1; what is too many is left out.
    length : int

    Raises
    ------
    ValueError
        It is no vector of numbers.
    """
    if isinstance(value, numbers.Integral):
        value = int(value) / 255.0
    if isinstance(value, numbers.Real):
        value = np.full(length, float(value))
    if not isinstance(value, list | tuple | np.ndarray):
        raise ValueError("Invalid vector data type")
    vector = np.asarray(value).squeeze()
    if vector.dtype.kind in "iu":
        vector = vector / 255.0
    if vector.ndim != 1:
        raise ValueError("Format vector takes only 1-D vectors")
    color = np.ones(length, np.float32)
    color[: min(length, len(vector))] = vector[:length]
    return color


def format_color_array(value, shape) -> np.ndarray:
    """Return colours as float32 of a shape (N, C); see `format_color_vector`."""
    array = np.asarray(value)
    if array.dtype.kind in "iu":
        array = array / 255.0
    if array.ndim == 1:
        array = np.tile(array, (shape[0], 1))
    colors = np.ones((len(array), shape[1]), np.float32)
    kept = min(shape[1], array.shape[1])
    colors[:, :kept] = array[:, :kept]
    return colors


def format_texture_source(texture, target_channels: str = "RGB") -> np.ndarray | None:
    """Return an image as uint8 texels with the channels of a name.

    Parameters
    ----------
    texture : (H, W), (H, W, C) array, or image of Pillow
        Floats are of 0 to 1. Images are of any mode.
    target_channels : {"R", "RG", "GB", "RGB", "RGBA"}

    Raises
    ------
    TypeError, ValueError
    """
    if texture is None:
        return None
    if hasattr(texture, "convert") and hasattr(texture, "mode"):  # Pillow's
        from ...io.formats.images import made_pixels

        texture = made_pixels(texture, "texture")
    if not isinstance(texture, np.ndarray) or texture.dtype.kind not in "fiu":
        raise TypeError(f"Invalid type {type(texture)} for texture")
    scale = 255.0 if texture.dtype.kind == "f" else 1
    texels = np.array(texture * scale).astype(np.uint8)
    return _with_channels(texels[:, :, np.newaxis] if texels.ndim == 2 else texels, target_channels)


def _with_channels(texels: np.ndarray, target: str) -> np.ndarray:
    count = texels.shape[2]
    if target == "R":
        return texels[:, :, 0]
    if target in ("RG", "GB"):
        if count == 1:
            return np.repeat(texels, 2, axis=2)
        return texels[:, :, 1:3] if target == "GB" and count > 2 else texels[:, :, :2]
    if target not in ("RGB", "RGBA"):
        raise ValueError(f"Invalid texture channel specification: {target}")
    if count == 2:
        raise ValueError(f"Cannot reformat 2-channel texture into {target}")
    colors = np.repeat(texels, 3, axis=2) if count == 1 else texels[:, :, :3]
    if target == "RGB":
        return colors
    if count == 4:
        return texels
    return np.concatenate([colors, np.full((*colors.shape[:2], 1), 255, np.uint8)], axis=2)

"""Reads image files for comparison, with full channel depth and all frames.

In:  the bytes of a file. Out: arrays (H, W) or (H, W, 2 to 4), the top row first. Unlike
     `load_texture`, which makes RGBA of 8 bits of everything for drawing.
"""

from __future__ import annotations

import io
from dataclasses import dataclass

import numpy as np

from ...errors import FileFormatError
from ...io.formats.images import (
    PILLOW_FORMATS,
    check_image_size,
    decoding_fault,
    quiet_pillow,
)
from ...io.loaders import load_texture
from . import png_files

#: Suffixes of files that count as pictures in compared folders.
SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".gif", ".tif", ".tiff", ".tga", ".apng")
MAX_FRAMES = 10_000
# Pillow modes whose arrays equal the file's content; others are converted.
_AS_THEY_ARE = ("L", "LA", "RGB", "RGBA", "I", "F")


@dataclass(frozen=True)
class Picture:
    """The content of an image file: an array for each frame."""

    frames: list[np.ndarray]


def decode_picture(data: bytes, path: str) -> Picture:
    """Decode the bytes of an image file; errors name the path.

    Raises `FileFormatError`.
    """
    if path.lower().endswith(".tga"):
        return Picture([load_texture(data, format="tga").pixels])
    return _decode_by_pillow(data, path)


def _decode_by_pillow(data: bytes, path: str) -> Picture:
    from PIL import Image

    try:
        with quiet_pillow(), Image.open(io.BytesIO(data), formats=PILLOW_FORMATS) as image:
            check_image_size(*image.size, path, len(data))
            count = getattr(image, "n_frames", 1)
            if count > MAX_FRAMES:
                raise FileFormatError(f"an animation is limited to {MAX_FRAMES} frames", path)
            if count == 1 and png_files.is_deep(data):
                return Picture([png_files.read_deep(data)])
            frames = []
            for number in range(count):
                image.seek(number)
                frames.append(image_pixels(image))
            return Picture(frames)
    except FileFormatError:
        raise
    except Image.UnidentifiedImageError as error:
        raise FileFormatError("not an image of a known format", path) from error
    # For damaged files, Pillow's plugins raise various errors.
    except Exception as error:
        raise decoding_fault(error, path) from error


def image_pixels(image) -> np.ndarray:
    """Return the pixels of a Pillow image; palettes become colours."""
    if image.mode == "1":
        image = image.convert("L")
    elif image.mode.startswith("I;16"):
        return np.asarray(image).astype(np.uint16)
    elif image.mode not in _AS_THEY_ARE or "transparency" in image.info:
        has_alpha = image.mode in ("P", "PA", "La", "RGBa") or "transparency" in image.info
        image = image.convert("RGBA" if has_alpha else "RGB")
    return np.array(image)

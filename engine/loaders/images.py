"""PNG, JPEG and the other common image formats, decoded by Pillow.

In: the bytes of an image file. Out: (H, W, 4) uint8 RGBA, the top row first. Pillow is imported
when the first image is read, and is allowed the listed formats only (others may start programs).
"""

from __future__ import annotations

import contextlib
import io
import re
import warnings

import numpy as np

from ..errors import FileFormatError
from ..textures import MAX_SIDE
from .registry import Reader
from .sources import Source

# More pixels than this are refused before anything is decoded; as RGBA they take 683 MiB. Assign
# another value to change it (beyond this one, which is Pillow's, Image.MAX_IMAGE_PIXELS as well).
MAX_PIXELS = 178_956_970
# Pixels that are converted at a time.
_STRIP = 1 << 20


def check_image_size(width: int, height: int, path: str) -> None:
    """Refuse images without pixels, and those too large to be honest."""
    if width < 1 or height < 1:
        raise FileFormatError(f"an image of {width}x{height} pixels", path)
    if max(width, height) > MAX_SIDE:
        raise FileFormatError(f"{width}x{height} pixels: a side is limited to {MAX_SIDE}", path)
    if width * height > MAX_PIXELS:
        raise FileFormatError(
            f"{width}x{height} pixels: an image is limited to {MAX_PIXELS} pixels", path
        )


def read_image(source: Source) -> np.ndarray:
    """Decode an image file with Pillow.

    Returns
    -------
    pixels : (H, W, 4) uint8, the top row first
        The first frame of an animation.

    Raises
    ------
    FileFormatError
    """
    from PIL import Image

    formats = [pillow_name for _, _, _, pillow_name, _ in _FORMATS]
    try:
        with _quiet_pillow(), Image.open(io.BytesIO(source.data), formats=formats) as image:
            check_image_size(*image.size, source.path)
            if image.mode == "F":  # Pillow would make them 0 and 1 of 255
                raise FileFormatError("pixels that are floats are not read", source.path)
            pixels = _rgba(image)
            pixels.setflags(write=False)
            return pixels
    except FileFormatError:
        raise
    except Image.DecompressionBombError as error:
        raise FileFormatError(f"an image is limited to {MAX_PIXELS} pixels", source.path) from error
    except Image.UnidentifiedImageError as error:
        raise FileFormatError("not an image of a known format", source.path) from error
    # Pillow's plugins raise whatever a damaged file leads them to: OSError, SyntaxError,
    # struct.error, IndexError, ...
    except Exception as error:
        raise FileFormatError(f"damaged image: {error}", source.path) from error


@contextlib.contextmanager
def _quiet_pillow():
    """Silence warnings of what Pillow passes over, and of sizes that are not too large here."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _rgba(image) -> np.ndarray:
    if image.mode.startswith("I"):
        # 16-bit grey; Pillow's own conversion would clip it at 255.
        wide = np.asarray(image).astype(np.int64)
        return _widened_grey(np.clip(wide >> 8, 0, 255).astype(np.uint8))
    # Strip by strip: Pillow's own conversion and the way from it to an array copy an image each.
    pixels = np.empty((image.height, image.width, 4), np.uint8)
    rows = max(_STRIP // image.width, 1)
    for top in range(0, image.height, rows):
        bottom = min(top + rows, image.height)
        strip = image.crop((0, top, image.width, bottom))
        pixels[top:bottom] = np.asarray(strip.convert("RGBA"))
    return pixels


def _widened_grey(grey: np.ndarray) -> np.ndarray:
    rgba = np.full((*grey.shape, 4), 255, np.uint8)
    rgba[:, :, :3] = grey[:, :, np.newaxis]
    return rgba


def _starts_with(*signatures: bytes):
    return lambda head: head.startswith(signatures)


def _is_webp(head: bytes) -> bool:
    return head[:4] == b"RIFF" and head[8:12] == b"WEBP"


def _is_ppm(head: bytes) -> bool:
    return re.match(rb"P[1-6]\s", head) is not None


_FORMATS = (
    ("png", "Portable Network Graphics", (".png",), "PNG", _starts_with(b"\x89PNG\r\n\x1a\n")),
    ("jpeg", "JPEG", (".jpg", ".jpeg"), "JPEG", _starts_with(b"\xff\xd8\xff")),
    ("webp", "WebP", (".webp",), "WEBP", _is_webp),
    ("bmp", "Windows bitmap", (".bmp",), "BMP", _starts_with(b"BM")),
    ("gif", "GIF, first frame", (".gif",), "GIF", _starts_with(b"GIF87a", b"GIF89a")),
    ("tiff", "TIFF", (".tif", ".tiff"), "TIFF", _starts_with(b"II*\0", b"MM\0*")),
    ("ppm", "Portable pixmap", (".ppm", ".pgm", ".pbm"), "PPM", _is_ppm),
)

READERS = tuple(
    Reader(name, description, "image", extensions, read_image, signature)
    for name, description, extensions, _, signature in _FORMATS
)

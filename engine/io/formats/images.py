"""PNG, JPEG and other common image formats, decoded by Pillow.

In: the bytes of an image file. Out: (H, W, 4) uint8 RGBA, the top row first. Pillow is imported for
the first image, and restricted to the listed formats (others may start programs). This module
checks the sizes of all images, whichever decoder reads them.
"""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

import numpy as np

from ..._native.loaders import frozen
from ...base.memory import NEEDS_MORE, is_lack_of_memory
from ...base.warning_scopes import ignored_of
from ...errors import FileFormatError
from ...model.materials.textures import MAX_SIDE
from ..reading.reader_registry import Reader
from ..reading.sources import Source

if TYPE_CHECKING:
    from PIL import Image

# Images with more pixels are refused before decoding; this many take 683 MiB as RGBA. Assignable
# (above this default, which is Pillow's, change Image.MAX_IMAGE_PIXELS too).
MAX_PIXELS = 178_956_970
# A guard against decompression bombs: all images of a model together have at most MAX_PIXELS, and
# at most this many pixels for each byte of their files.
PIXELS_PER_BYTE = 10
# Pixels converted at a time.
_STRIP = 1 << 20

_left: ContextVar[list[int] | None] = ContextVar("pixels_left", default=None)


@contextlib.contextmanager
def images_of_one_model() -> Iterator[None]:
    """Limit the total pixels of all images checked within the block."""
    token = _left.set([MAX_PIXELS])
    try:
        yield
    finally:
        _left.reset(token)


def check_image_size(width: int, height: int, path: str, size: int = 0) -> None:
    """Refuse empty images, and sizes that are implausible for their files.

    Parameters
    ----------
    width, height : int
    path : str
        The name in errors.
    size : int
        Size of the image file in bytes.

    Raises
    ------
    FileFormatError
    """
    if width < 1 or height < 1:
        raise FileFormatError(f"an image of {width}x{height} pixels", path)
    if max(width, height) > MAX_SIDE:
        raise FileFormatError(f"{width}x{height} pixels: a side is limited to {MAX_SIDE}", path)
    if width * height > MAX_PIXELS:
        raise FileFormatError(
            f"{width}x{height} pixels: an image is limited to {MAX_PIXELS} pixels", path
        )
    left = _left.get()
    if left is None:
        return
    taken = max(width * height - PIXELS_PER_BYTE * size, 0)
    if taken > left[0]:
        raise FileFormatError(
            f"{width}x{height} pixels: the images of a model are limited to {MAX_PIXELS} pixels "
            "together",
            path,
        )
    left[0] -= taken


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
    from PIL import Image, UnidentifiedImageError

    try:
        with quiet_pillow(), Image.open(io.BytesIO(source.data), formats=PILLOW_FORMATS) as image:
            check_image_size(*image.size, source.path, source.size)
            return rgba_pixels(image, source.path)
    except FileFormatError:
        raise
    except Image.DecompressionBombError as error:
        raise FileFormatError(f"an image is limited to {MAX_PIXELS} pixels", source.path) from error
    except UnidentifiedImageError as error:
        raise FileFormatError("not an image of a known format", source.path) from error
    # For damaged files, Pillow's plugins raise many types: OSError, SyntaxError, struct.error,
    # IndexError, ...
    except Exception as error:
        raise decoding_fault(error, source.path) from error


def decoding_fault(error: Exception, path: str) -> FileFormatError:
    """Return what a decoder's error says about an image file."""
    if is_lack_of_memory(error):
        return FileFormatError(NEEDS_MORE, path)
    return FileFormatError(f"damaged image: {error}", path)


@contextlib.contextmanager
def quiet_pillow() -> Iterator[None]:
    """Silence Pillow's warnings about ignored content, and about sizes that are allowed here."""
    with ignored_of(r"PIL(\.|$)"):
        yield


def rgba_pixels(image: Image.Image, path: str) -> np.ndarray:
    """Convert a Pillow image to RGBA.

    Parameters
    ----------
    image : PIL.Image.Image
        An image in any mode. 16-bit channels keep their high byte.
    path : str
        The name in errors.

    Returns
    -------
    pixels : (H, W, 4) uint8, read-only

    Raises
    ------
    FileFormatError
        Its pixels have no known range: floats, or integers beyond 16 bits.
    """
    if image.mode == "F":  # Pillow would turn values of 0 to 1 into 0 and 1 of 255
        raise FileFormatError("pixels that are floats are not read", path)
    convert = _wide_grey if image.mode.startswith("I") else _converted
    # Strip by strip: Pillow's conversion and the conversion to an array would each copy the whole
    # image.
    pixels = np.empty((image.height, image.width, 4), np.uint8)
    rows = max(_STRIP // image.width, 1)
    for top in range(0, image.height, rows):
        bottom = min(top + rows, image.height)
        convert(image, image.crop((0, top, image.width, bottom)), pixels[top:bottom], path)
    return frozen(pixels)  # the texture can keep it without copying


def made_pixels(image: Image.Image, path: str) -> np.ndarray:
    """Convert a Pillow image made by a program; otherwise as `rgba_pixels`.

    Integers and floats that Pillow converted from other modes range from 0 to 255. Other integers
    range from 0 to 65535, and floats from 0 to 1.
    """
    if image.mode == "F":
        values = np.asarray(image)
        scale = 255.0 if values.max(initial=0) <= 1 else 1.0
        codes = np.clip(np.nan_to_num(values * scale), 0, 255).astype(np.uint8)
        return np.stack([codes, codes, codes, np.full_like(codes, 255)], axis=-1)
    if image.mode == "I":
        largest: Any = image.getextrema()[1]  # a number, as there is one channel
        image = image.convert("L") if largest <= 255 else image
    return rgba_pixels(image, path)


# Modes that Pillow cannot convert to RGBA correctly -> the intermediate mode.
_THROUGH = {"HSV": "RGB", "YCbCr": "RGB", "RGBX": "RGB", "CMYK": "RGB", "La": "LA", "PA": "RGBA"}


def _converted(image: Image.Image, strip: Image.Image, pixels: np.ndarray, path: str) -> None:
    if strip.mode == "LAB":
        strip = _of_lab(strip)
    elif strip.mode in _THROUGH:
        strip = strip.convert(_THROUGH[strip.mode])
    pixels[:] = np.asarray(strip.convert("RGBA"))


def _of_lab(strip: Image.Image) -> Image.Image:
    """Convert CIE Lab (D50) to sRGB."""
    from PIL import ImageCms

    profiles = ImageCms.createProfile("LAB"), ImageCms.createProfile("sRGB")
    made = ImageCms.profileToProfile(strip, *profiles, outputMode="RGB")
    assert made is not None  # it is None only if the image is changed in place
    return made


def _wide_grey(image: Image.Image, strip: Image.Image, pixels: np.ndarray, path: str) -> None:
    """Convert 16-bit grey, which Pillow's conversion would clip at 255."""
    wide = np.asarray(strip)
    if wide.dtype.itemsize > 2 and (wide.min() < 0 or wide.max() > 0xFFFF):
        raise FileFormatError("pixels of more than 16 bits are not read", path)
    pixels[:, :, :3] = (wide >> 8).astype(np.uint8)[:, :, np.newaxis]
    transparent = image.info.get("transparency")
    pixels[:, :, 3] = 255 if transparent is None else np.where(wide == transparent, 0, 255)


def starts_with(*signatures: bytes) -> Callable[[bytes], bool]:
    """Return a `Reader` signature that accepts files with one of these beginnings."""
    return lambda head: head.startswith(signatures)


def _is_webp(head: bytes) -> bool:
    return head[:4] == b"RIFF" and head[8:12] == b"WEBP"


def _is_ppm(head: bytes) -> bool:
    return re.match(rb"P[1-6]\s", head) is not None


_FORMATS = (
    ("png", "Portable Network Graphics", (".png",), "PNG", starts_with(b"\x89PNG\r\n\x1a\n")),
    ("jpeg", "JPEG", (".jpg", ".jpeg"), "JPEG", starts_with(b"\xff\xd8\xff")),
    ("webp", "WebP", (".webp",), "WEBP", _is_webp),
    ("bmp", "Windows bitmap", (".bmp",), "BMP", starts_with(b"BM")),
    ("gif", "GIF, first frame", (".gif",), "GIF", starts_with(b"GIF87a", b"GIF89a")),
    ("tiff", "TIFF", (".tif", ".tiff"), "TIFF", starts_with(b"II*\0", b"MM\0*")),
    ("ppm", "Portable pixmap", (".ppm", ".pgm", ".pbm"), "PPM", _is_ppm),
)
# The formats that Pillow may open, whatever a file claims to be.
PILLOW_FORMATS = [pillow_name for _, _, _, pillow_name, _ in _FORMATS]

READERS = tuple(
    Reader(name, description, "image", extensions, read_image, signature)
    for name, description, extensions, _, signature in _FORMATS
)

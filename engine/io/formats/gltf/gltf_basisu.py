"""Basis Universal images, decoded by the optional package opengl-basisu.

In: the bytes of a .ktx2 or .basis file. Out: its pixels. The package runs in a separate process,
see `limited_process`.
"""

from __future__ import annotations

import importlib.util
import struct

import numpy as np

from ...._native.loaders import frozen
from ....base.optional_packages import needed
from ....errors import FileFormatError
from ...reading.limited_process import in_limited_process
from ...reading.sources import Source
from ..images import check_image_size

#: The extensions for such images.
READ = ("KHR_texture_basisu", "GOOGLE_texture_basis")
_KTX2, _BASIS = b"\xabKTX 20\xbb\r\n\x1a\n", b"sB"
# Position of width and height in the header of a KTX2 file, and the header's size.
_SIZE_AT, _HEADER = 20, 80


class NotInstalledError(Exception):
    """Raised if the package is missing; the text says what to install."""


def is_installed() -> bool:
    """Return whether the package is installed."""
    return importlib.util.find_spec("opengl_basisu") is not None


def is_packed(data: bytes) -> bool:
    """Return whether the bytes are such an image."""
    return data.startswith((_KTX2, _BASIS))


def read_packed(source: Source) -> np.ndarray:
    """Decode an image.

    Returns
    -------
    pixels : (H, W, 4) uint8, read-only, the top row first

    Raises
    ------
    NotInstalledError
    FileFormatError
    """
    if not is_installed():
        raise NotInstalledError(
            needed("is packed by Basis Universal, which needs", "opengl-basisu", "ktx2")
        )
    size = source.size
    if source.data.startswith(_KTX2):
        if source.size < _HEADER:
            raise FileFormatError("damaged: the KTX2 file ends within its header", source.path)
        width, height = struct.unpack_from("<II", source.data, _SIZE_AT)
        check_image_size(width, height, source.path, source.size)
        size += width * height // 8
    return frozen(np.array(in_limited_process(_read_here, source, True, size=size)))


def _read_here(source: Source, split: bool) -> np.ndarray:
    """Decode the largest level in this process."""
    import opengl_basisu

    try:
        texture = opengl_basisu.open(source.data)
        check_image_size(texture.width, texture.height, source.path, source.size)
        return texture.transcode("rgba8").data
    except (FileFormatError, MemoryError):
        raise
    # The package has its own exceptions, and passes on C++ exceptions.
    except Exception as error:
        raise FileFormatError(f"damaged image: {error}", source.path) from None

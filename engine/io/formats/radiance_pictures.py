"""Images of linear light, detected by content: Radiance or OpenEXR.

In: the bytes of a file. Out: its light as floats, or as the 8-bit codes of a texture, clamped at 1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...errors import FileFormatError
from ...model.materials.colors import srgb_bytes
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from .images import starts_with

#: Extensions of files whose pixels are light.
LIGHT_EXTENSIONS = (".hdr", ".exr")
_STRIP = 1 << 20
_RADIANCE = b"#?"
_OPENEXR = b"\x76\x2f\x31\x01"


def load_radiance(source: Source) -> NDArray[np.float32]:
    """Decode an image.

    Returns
    -------
    pixels : (H, W, 3) float32
        Linear light, the top row first.

    Raises
    ------
    FileFormatError, FileAccessError
    """
    if source.head(2) == _RADIANCE:
        from .hdr import read_hdr

        return read_hdr(source)
    if source.head(4) == _OPENEXR:
        from .exr import read_exr

        return read_exr(source)
    raise FileFormatError(
        "neither a Radiance picture (.hdr) nor OpenEXR (.exr) by its first bytes", source.path
    )


def read_srgb(source: Source) -> NDArray[np.uint8]:
    """Decode an image as a colour texture: (H, W, 4) uint8, sRGB."""
    return _codes(load_radiance(source), is_data=False)


def read_linear(source: Source) -> NDArray[np.uint8]:
    """Decode an image as a data texture: (H, W, 4) uint8, 255 for 1."""
    return _codes(load_radiance(source), is_data=True)


def _codes(light: NDArray[np.float32], *, is_data: bool) -> NDArray[np.uint8]:
    height, width = light.shape[:2]
    pixels = np.empty((height, width, 4), np.uint8)
    rows = max(_STRIP // max(width, 1), 1)
    for top in range(0, height, rows):
        part = light[top : top + rows]
        colors = np.ones((part.shape[0] * width, 4), np.float32)
        colors[:, :3] = np.clip(np.nan_to_num(part.reshape(-1, 3), nan=0.0), 0, 1)
        codes = np.floor(colors.astype(np.float64) * 255 + 0.5) if is_data else srgb_bytes(colors)
        pixels[top : top + rows] = codes.reshape(part.shape[0], width, 4)
    pixels.setflags(write=False)  # the texture can keep it without copying
    return pixels


READERS = tuple(
    Reader(
        name,
        description,
        "image",
        (extension,),
        read_srgb,
        starts_with(begins),
        read_linear=read_linear,
    )
    for name, description, extension, begins in (
        ("hdr", "Radiance", ".hdr", _RADIANCE),
        ("exr", "OpenEXR (engine3d[exr])", ".exr", _OPENEXR),
    )
)

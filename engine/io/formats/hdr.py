"""Radiance images (.hdr): linear light in four bytes per pixel.

In: the bytes of a file. Out: (H, W, 3) float32 linear light, the top row first, whichever of the
eight orders of pixels the file has. The file's length is checked against its header before any
allocation. Exposure lines are ignored, as in three.js and Blender. Source: Ward, Real Pixels,
Graphics Gems II, 1991; Radiance's own reader, color.c.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from ..._native.images import unpack_rgbe
from ...errors import FileFormatError
from ..reading.sources import Source
from ..reading.text import shown
from .images import check_image_size

_MOST_HEADER = 1 << 16  # bytes
_SIZE = re.compile(rb"([-+])([XY]) +(\d{1,9}) +([-+])([XY]) +(\d{1,9})\s*")
_FORMAT = b"32-bit_rle_rgbe"
_LEAST_LINE = 8  # bytes: a pixel, and an old-style run
# New-style files encode at most 16 pixels per byte; old-style files are rare, and their long runs
# count as hostile.
_PIXELS_PER_BYTE, _FEW_PIXELS = 20, 1 << 21


def read_hdr(source: Source) -> NDArray[np.float32]:
    """Decode a Radiance image.

    Returns
    -------
    pixels : (H, W, 3) float32
        Linear radiance.

    Raises
    ------
    FileFormatError
        The message names the file and, for damaged pixels, the byte.
    """
    size, start = _read_header(source)
    lines, width = int(size[3]), int(size[6])
    check_image_size(width, lines, source.path, source.size)
    _check_length(source, lines, width, start)
    packed = np.empty((lines, width, 4), np.uint8)
    done, at, fault = unpack_rgbe(memoryview(source.data)[start:], packed)
    if fault:
        raise FileFormatError(
            f"damaged Radiance picture: {fault} in line {done + 1} of {lines}, byte {start + at}",
            source.path,
        )
    return _upright(_light(packed), size)


def _read_header(source: Source) -> tuple[re.Match[bytes], int]:
    """Return the image's size and orientation, and the offset of the pixels."""
    head = source.head(_MOST_HEADER)
    if not head.startswith((b"#?RADIANCE", b"#?RGBE")):
        raise FileFormatError("no Radiance picture: it does not begin with #?RADIANCE", source.path)
    at = 0
    while True:
        end = head.find(b"\n", at)
        if end < 0:
            raise FileFormatError("cut short in the header of a Radiance picture", source.path)
        line, at = head[at:end].rstrip(b"\r"), end + 1
        if not line:
            break
        key, _, value = line.partition(b"=")
        if key == b"FORMAT" and value.strip() != _FORMAT:
            name = shown(value.strip().decode("latin-1"))
            raise FileFormatError(f"Radiance pixels of the format {name} are not read", source.path)
    end = head.find(b"\n", at)
    match = _SIZE.fullmatch(head[at:end]) if end >= 0 else None
    if match is None or match[2] == match[5]:
        raise FileFormatError(
            f"no size of a Radiance picture, such as -Y 512 +X 1024, at byte {at}", source.path
        )
    return match, end + 1


def _check_length(source: Source, lines: int, width: int, start: int) -> None:
    """Refuse a file too short for its lines, before allocating memory."""
    most = _FEW_PIXELS + _PIXELS_PER_BYTE * source.size
    least = lines * min(4 * width, _LEAST_LINE)
    if source.size - start < least or lines * width > most:
        raise FileFormatError(
            f"cut short: {width}x{lines} pixels are more than {source.size - start} bytes can say",
            source.path,
        )


def _light(packed: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Return c * 2**(e - 136) for a channel c with exponent e, and 0 if e is 0, exactly."""
    scale = np.ldexp(np.float32(1), np.arange(256) - 136).astype(np.float32)
    scale[0] = 0
    return packed[:, :, :3] * scale[packed[:, :, 3:]]


def _upright(light: NDArray[np.float32], size: re.Match[bytes]) -> NDArray[np.float32]:
    """Return the image with the top left pixel first; the header gives the order of lines."""
    first, second = size[1] + size[2], size[4] + size[5]
    if first in (b"+Y", b"-X"):
        light = light[::-1]
    if second in (b"-X", b"+Y"):
        light = light[:, ::-1]
    if size[2] == b"X":
        light = light.transpose(1, 0, 2)
    return np.ascontiguousarray(light)

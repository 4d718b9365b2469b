"""PNG files at chunk level: splitting, joining, and reading 16-bit channels.

In:  the bytes of a file. Out: its chunks, or its pixels: Pillow keeps only the upper bytes of
     colours with 16 bits a channel. Source: PNG specification, third edition (W3C, 2025).
"""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterable

import numpy as np

SIGNATURE = b"\x89PNG\r\n\x1a\n"
_CHANNELS = {0: 1, 4: 2, 2: 3, 6: 4}  # by colour type
_HEADER = struct.Struct(">IIBBBBB")


class DamagedPng(ValueError):
    """The bytes are not a complete PNG file."""


def join_chunks(chunks: Iterable[tuple[bytes, bytes]]) -> bytes:
    """Return the file of (name, content) pairs."""
    parts = [SIGNATURE]
    for name, content in chunks:
        sum_of_both = zlib.crc32(content, zlib.crc32(name))
        parts += [struct.pack(">I", len(content)), name, content, struct.pack(">I", sum_of_both)]
    return b"".join(parts)


def split_chunks(file: bytes) -> list[tuple[bytes, bytes]]:
    """Return the (name, content) pairs of a file, with checked sums.

    Raises `DamagedPng`.
    """
    if not file.startswith(SIGNATURE):
        raise DamagedPng("not a PNG file")
    chunks: list[tuple[bytes, bytes]] = []
    at = len(SIGNATURE)
    while not chunks or chunks[-1][0] != b"IEND":
        head = file[at : at + 8]
        length = int.from_bytes(head[:4], "big")
        end = at + 12 + length
        if len(head) < 8 or end > len(file):
            raise DamagedPng("the PNG file ends too early")
        name, content = head[4:], file[at + 8 : end - 4]
        if zlib.crc32(content, zlib.crc32(name)) != int.from_bytes(file[end - 4 : end], "big"):
            raise DamagedPng("the PNG file is damaged")
        chunks.append((name, content))
        at = end
    return chunks


def is_deep(file: bytes) -> bool:
    """Return whether a file has 16-bit channels that are not just grey."""
    name_and_header = file[12 : 16 + _HEADER.size]
    if not file.startswith(SIGNATURE) or len(name_and_header) < 4 + _HEADER.size:
        return False
    _, _, bits, color_type, *_ = _HEADER.unpack(name_and_header[4:])
    return bits == 16 and _CHANNELS.get(color_type, 1) > 1


def read_deep(file: bytes) -> np.ndarray:
    """Return the (H, W, 2 to 4) uint16 pixels of a file for which `is_deep` is true.

    Pillow unpacks the same data twice: once as the upper bytes, once as the lower ones.
    """
    channels = _CHANNELS[file[25]]
    if channels == 2:  # four bytes per pixel, as in 8-bit RGBA
        return _unpacked(file, "RGBA", "RGBA").view(">u2").astype(np.uint16)
    mode = "RGB" if channels == 3 else "RGBA"
    upper, lower = (_unpacked(file, mode, f"{mode};16{order}") for order in "BL")
    return upper.astype(np.uint16) << 8 | lower


def _unpacked(file: bytes, mode: str, raw_mode: str) -> np.ndarray:
    from PIL import Image

    with Image.open(io.BytesIO(file), formats=("PNG",)) as image:
        image._mode = mode
        image.tile = [tile._replace(args=raw_mode) for tile in image.tile]
        return np.array(image)

"""Truevision TGA: types 1, 2, 3, 9, 10 and 11 of 8 to 32 bits, all four origins.

In: the bytes of a file. Out: (H, W, 4) uint8 RGBA, the top row first. The file's length is checked
against its header before any allocation, and pixels are decoded in blocks, so that memory use stays
near the image's size. Source: Truevision TGA File Format Specification 2.0. Pillow reads these
differently: images with their origin at the right, run-length packets across lines, maps of 15 and
16 bits, grey with alpha.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np

from ..._native.images import unpack_tga
from ..._native.loaders import frozen
from ...errors import FileFormatError
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from .images import check_image_size

_HEADER = struct.Struct("<BBBHHBHHHHBB")
_FOOTER_SIGNATURE = b"TRUEVISION-XFILE."
_MAPPED, _TRUE_COLOR, _GREY = 1, 2, 3
_RUN_LENGTH = 8
_ALPHA_RETAINED, _ALPHA, _ALPHA_PREMULTIPLIED = 2, 3, 4
_DEPTHS = {_MAPPED: (8, 15, 16), _TRUE_COLOR: (15, 16, 24, 32), _GREY: (8, 16)}
_BLOCK = 1 << 18


@dataclass(frozen=True)
class _Header:
    """The 18-byte file header, checked."""

    kind: int
    run_length: bool
    id_length: int
    map_type: int
    map_first: int
    map_length: int
    map_bits: int
    width: int
    height: int
    bits: int
    alpha_bits: int
    from_right: bool
    from_top: bool

    @property
    def pixel_bytes(self) -> int:
        return (self.bits + 7) // 8

    @property
    def map_start(self) -> int:
        return _HEADER.size + self.id_length

    @property
    def map_size(self) -> int:
        return self.map_length * ((self.map_bits + 7) // 8) if self.map_type else 0


def read_tga(source: Source) -> np.ndarray:
    """Decode a TGA file.

    Returns
    -------
    pixels : (H, W, 4) uint8, the top row first
        5-bit channels are widened by repeating their high bits. Alpha is used if the extension area
        or, without one, the attribute bits declare it, else it is 255. Alpha that is zero
        everywhere is ignored, unless an extension area declares it.

    Raises
    ------
    FileFormatError
        The header is not TGA, or the file is too short for its pixels.
    """
    header = _read_header(source)
    attributes = _extension_attributes(source.data)
    has_alpha = _has_alpha(header, attributes)
    is_mapped = header.kind == _MAPPED
    color_map = _read_color_map(source, header, has_alpha) if is_mapped else None
    start = header.map_start + header.map_size
    _check_length(source, header, start)
    pixels = np.empty((header.height, header.width, 4), np.uint8)
    flat = pixels.reshape(-1, 4)
    stored = _stored_pixels(source, header, start, flat)
    for done in range(0, len(flat), _BLOCK):
        block = stored[done : done + _BLOCK]
        if color_map is not None:
            rgba = _look_up(block, color_map, header, source.path)
        elif header.kind == _GREY:
            rgba = _rgba_from_grey(block)
        else:
            rgba = _rgba(block, header.bits, has_alpha)
        flat[done : done + len(block)] = rgba
    if attributes is None and not pixels[:, :, 3].any():
        pixels[:, :, 3] = 255
    _turn_upright(pixels, header)
    return frozen(pixels)


def _read_header(source: Source) -> _Header:
    if len(source.data) < _HEADER.size:
        raise FileFormatError("cut short in the TGA header", source.path)
    (id_length, map_type, image_type, first, length, map_bits, _, _, width, height, bits, flags) = (
        _HEADER.unpack_from(source.data)
    )
    kind = image_type & ~_RUN_LENGTH
    if kind not in _DEPTHS:
        raise FileFormatError(f"unknown TGA image type {image_type}", source.path)
    if bits not in _DEPTHS[kind]:
        raise FileFormatError(f"TGA type {image_type} with {bits} bits per pixel", source.path)
    if map_type > 1 or (kind == _MAPPED and map_type == 0):
        raise FileFormatError(f"TGA type {image_type} with colour map {map_type}", source.path)
    if kind == _MAPPED and map_bits not in _DEPTHS[_TRUE_COLOR]:
        raise FileFormatError(f"TGA colour map of {map_bits} bits an entry", source.path)
    if flags & 0xC0:
        raise FileFormatError("TGA with interleaved lines", source.path)
    check_image_size(width, height, source.path, source.size)
    return _Header(
        kind=kind,
        run_length=bool(image_type & _RUN_LENGTH),
        id_length=id_length,
        map_type=map_type,
        map_first=first,
        map_length=length,
        map_bits=map_bits,
        width=width,
        height=height,
        bits=bits,
        alpha_bits=flags & 0x0F,
        from_right=bool(flags & 0x10),
        from_top=bool(flags & 0x20),
    )


def _has_alpha(header: _Header, attributes: int | None) -> bool:
    """Return whether the file has alpha: by its extension area, else by the attribute bits."""
    if attributes is not None:
        return attributes in (_ALPHA_RETAINED, _ALPHA, _ALPHA_PREMULTIPLIED)
    return header.alpha_bits > 0 or (header.kind == _GREY and header.bits == 16)


def _extension_attributes(data: bytes) -> int | None:
    """Return the attribute type byte of the extension area, or None without a valid one."""
    footer = data[-26:]
    if len(footer) < 26 or footer[8:25] != _FOOTER_SIGNATURE:
        return None
    offset = int.from_bytes(footer[:4], "little")
    if offset < _HEADER.size or offset + 495 > len(data):
        return None
    return data[offset + 494]


def _read_color_map(source: Source, header: _Header, has_alpha: bool) -> np.ndarray:
    entry = (header.map_bits + 7) // 8
    raw = source.data[header.map_start : header.map_start + header.map_size]
    if len(raw) < header.map_size or not raw:
        raise FileFormatError("cut short in the TGA colour map", source.path)
    # 32-bit map entries have alpha regardless of the attribute bits, which describe the pixels.
    has_alpha = has_alpha or header.map_bits == 32
    return _rgba(np.frombuffer(raw, np.uint8).reshape(-1, entry), header.map_bits, has_alpha)


def _check_length(source: Source, header: _Header, start: int) -> None:
    """Refuse a file too short for its pixels, before allocating memory."""
    count = header.width * header.height
    least = count * header.pixel_bytes
    if header.run_length:
        least = (count + 127) // 128 * (1 + header.pixel_bytes)
    if len(source.data) - start < least:
        raise FileFormatError(
            f"cut short: {header.width}x{header.height} pixels need {least} bytes, "
            f"{max(len(source.data) - start, 0)} are there",
            source.path,
        )


def _stored_pixels(source: Source, header: _Header, start: int, room: np.ndarray) -> np.ndarray:
    """Return the pixels as stored, (N, bytes per pixel) uint8.

    Run-length packets are unpacked to the end of ``room``, (N, 4). Pixels can then be converted in
    place from first to last: none overwrites bytes that are still needed.
    """
    size, count = header.pixel_bytes, len(room)
    if not header.run_length:
        data = np.frombuffer(source.data, np.uint8, count * size, start)
        return data.reshape(count, size)
    stored = room.reshape(-1)[count * (4 - size) :].reshape(count, size)
    done = unpack_tga(memoryview(source.data)[start:], stored)
    if done < count:
        raise FileFormatError(f"cut short: {done} of {count} pixels are there", source.path)
    return stored


def _rgba(stored: np.ndarray, bits: int, has_alpha: bool) -> np.ndarray:
    """Convert stored colours of 15 to 32 bits to RGBA."""
    rgba = np.empty((len(stored), 4), np.uint8)
    rgba[:, 3] = 255
    if bits in (24, 32):
        rgba[:, :3] = stored[:, 2::-1]
        if bits == 32 and has_alpha:
            rgba[:, 3] = stored[:, 3]
        return rgba
    packed = stored[:, 0].astype(np.uint16) | stored[:, 1].astype(np.uint16) << 8
    for channel, shift in enumerate((10, 5, 0)):
        five = packed >> shift & 31
        rgba[:, channel] = five << 3 | five >> 2
    if bits == 16 and has_alpha:
        rgba[:, 3] = np.where(packed & 0x8000, 255, 0)
    return rgba


def _rgba_from_grey(stored: np.ndarray) -> np.ndarray:
    """Convert one-byte grey, or two-byte grey and alpha, to RGBA."""
    rgba = np.full((len(stored), 4), 255, np.uint8)
    rgba[:, :3] = stored[:, :1]
    if stored.shape[1] == 2:
        rgba[:, 3] = stored[:, 1]
    return rgba


def _look_up(stored: np.ndarray, color_map: np.ndarray, header: _Header, path: str) -> np.ndarray:
    index = stored[:, 0].astype(np.int64)
    if stored.shape[1] == 2:
        index |= stored[:, 1].astype(np.int64) << 8
    index -= header.map_first
    if index.min() < 0 or index.max() >= len(color_map):
        wrong = index.min() if index.min() < 0 else index.max()
        raise FileFormatError(
            f"pixel value {wrong + header.map_first} is outside the colour map", path
        )
    return color_map[index]


def _turn_upright(pixels: np.ndarray, header: _Header) -> None:
    """Flip the image in place so that the top-left pixel comes first."""
    if not header.from_top:
        half = header.height // 2
        for row in range(half):
            upper, lower = pixels[row], pixels[header.height - 1 - row]
            kept = upper.copy()
            upper[:] = lower
            lower[:] = kept
    if header.from_right:
        for row in pixels:
            row[:] = row[::-1].copy()


def _resembles_tga(head: bytes, size: int) -> bool:
    if len(head) < _HEADER.size:
        return False
    kind = head[2] & ~_RUN_LENGTH
    return kind in _DEPTHS and head[16] in _DEPTHS[kind] and head[1] <= 1 and not head[17] & 0xC0


READERS = (
    Reader(
        "tga",
        "Truevision TGA, plain and run-length encoded",
        "image",
        (".tga", ".vda", ".icb", ".vst"),
        read_tga,
        resembles=_resembles_tga,
    ),
)

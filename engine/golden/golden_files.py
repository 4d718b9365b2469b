"""Golden files: a PNG that people look at, which also holds what exactly was drawn.

In:  an array of pixels. Out: the bytes of a PNG file, and back.

Two chunks are the project's own; by their names, a program that edits the picture drops them. The
first, ``goLD``, holds type, shape and hash of the pixels, so that comparing decodes nothing, and a
seal: the hash of everything else in the file. A picture that was changed by other means does not
fit its seal, and is then decoded and compared as it is. The second, ``daTA``, holds the numbers of
arrays that are no colours of 8 or 16 bits: depths, identities. The picture only shows these.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import zlib
from dataclasses import dataclass

import numpy as np

from ..errors import FileAccessError, FileFormatError
from ..files.atomic_write import atomic_write
from ..files.making_folders import make_folder_of
from . import png_files
from .display import displayed
from .picture_files import decode_picture
from .pixel_hash import pixel_hash

_IDENTITY, _NUMBERS = b"goLD", b"daTA"
_PLACE = 37  # of the first one's name: after the signature, the header and a length
MAX_BYTES = 1 << 31  # of the numbers of one array


@dataclass(frozen=True)
class GoldenFile:
    """A golden file that was read, but not decoded.

    Attributes
    ----------
    path : str
    data : bytes
        The whole file.
    digest : str or None
        What `pixel_hash` said of the pixels; None where the picture was made by other means.
    """

    path: str
    data: bytes
    digest: str | None

    def pixels(self) -> np.ndarray:
        """Decode the exact pixels. Raises `FileFormatError`."""
        exact = exact_pixels(self.data) if self.digest is not None else None
        return decode_picture(self.data, self.path).frames[0] if exact is None else exact


def read_golden(path: str) -> GoldenFile | None:
    """Return a golden file, None if there is none.

    Raises `FileAccessError`, or `FileFormatError` where it is no whole PNG file.
    """
    try:
        with open(path, "rb") as file:
            data = file.read()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise FileAccessError(f"cannot read: {error.strerror}", path) from error
    try:
        identity = _identity(png_files.split_chunks(data))
    except png_files.DamagedPng as error:
        raise FileFormatError(str(error), path) from error
    return GoldenFile(path, data, identity["sha256"] if identity else None)


def is_golden_file(path: str | os.PathLike) -> bool:
    """Return whether a file begins as `encode_golden` writes it."""
    try:
        with open(path, "rb") as file:
            start = file.read(_PLACE + len(_IDENTITY))
    except OSError:
        return False
    return start.startswith(png_files.SIGNATURE) and start[_PLACE:] == _IDENTITY


def write_golden(path: str, pixels: np.ndarray) -> None:
    """Write a golden file whole or not at all, with the folders above it.

    Raises `FileAccessError`.
    """
    make_folder_of(path)
    with atomic_write(path) as file:
        file.write(encode_golden(pixels))


def encode_golden(pixels: np.ndarray) -> bytes:
    """Return the bytes of a golden file."""
    shown = displayed(pixels) if needs_numbers(pixels) else pixels.astype(_stored_type(pixels))
    if pixels.dtype == np.bool_:
        shown = shown * np.uint8(255)
    header, *body, end = png_files.split_chunks(png_files.encode(shown))
    if needs_numbers(pixels):
        body.append((_NUMBERS, zlib.compress(_by_place(pixels), 9)))
    identity = {
        "dtype": pixels.dtype.name,
        "shape": pixels.shape,
        "sha256": pixel_hash(pixels),
        "seal": _seal([header, *body]),
    }
    text = json.dumps(identity, separators=(",", ":")).encode("ascii")
    return png_files.join_chunks([header, (_IDENTITY, text), *body, end])


def needs_numbers(pixels: np.ndarray) -> bool:
    """Return whether the colours of a PNG file cannot hold such pixels."""
    return pixels.dtype not in (np.bool_, np.uint8, np.uint16)


def exact_pixels(data: bytes) -> np.ndarray | None:
    """Return the pixels of a golden file as they were given; None if it is not sealed, or none.

    Raises `FileFormatError` where a sealed file does not hold what it should.
    """
    try:
        chunks = png_files.split_chunks(data)
    except png_files.DamagedPng:
        return None
    identity = _identity(chunks)
    if identity is None:
        return None
    dtype, shape = np.dtype(identity["dtype"]), tuple(identity["shape"])
    numbers = next((content for name, content in chunks if name == _NUMBERS), None)
    if numbers is None:
        pixels = decode_picture(data, "golden picture").frames[0]
        return (pixels > 0 if dtype == np.bool_ else pixels).reshape(shape)
    size = math.prod(shape) * dtype.itemsize
    places = zlib.decompressobj().decompress(numbers, size) if 0 < size <= MAX_BYTES else b""
    if len(places) != size:
        raise FileFormatError("the golden picture does not hold the numbers that it should")
    columns = np.frombuffer(places, np.uint8).reshape(dtype.itemsize, -1)
    return np.ascontiguousarray(columns.T).view(dtype.newbyteorder("<")).reshape(shape)


def _identity(chunks: list[tuple[bytes, bytes]]) -> dict | None:
    """Return what a sealed file says of its pixels, None of any other."""
    text = next((content for name, content in chunks if name == _IDENTITY), None)
    if text is None:
        return None
    try:
        identity = json.loads(text)
        fits = identity["seal"] == _seal([c for c in chunks if c[0] not in (_IDENTITY, b"IEND")])
    except (ValueError, KeyError, TypeError):
        return None
    return identity if fits else None


def _seal(chunks: list[tuple[bytes, bytes]]) -> str:
    summary = hashlib.sha256()
    for name, content in chunks:
        summary.update(name + len(content).to_bytes(4, "big"))
        summary.update(content)
    return summary.hexdigest()


def _stored_type(pixels: np.ndarray) -> np.dtype:
    return np.dtype(np.uint16 if pixels.dtype == np.uint16 else np.uint8)


def _by_place(pixels: np.ndarray) -> bytes:
    """Return the bytes of all numbers, first all lowest ones, and so on: they pack better."""
    return np.ascontiguousarray(pixels.reshape(-1, 1).view(np.uint8).T).tobytes()

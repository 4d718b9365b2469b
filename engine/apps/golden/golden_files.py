"""Golden files: viewable PNG files that also hold the exact pixels.

In:  an array of pixels. Out: the bytes of a PNG file, and back.

Two chunks are the project's own; by their names, a program that edits the picture drops them. The
first, ``goLD``, holds type, shape and hash of the pixels, so that comparing decodes nothing,
`PICTURES`, and a seal: the hash of everything else in the file. A picture that was changed by other
means does not fit its seal, and is then decoded and compared as it is. The second, ``daTA``, holds
the numbers of arrays that are no colours of 8 or 16 bits: depths, identities. The picture only
shows these.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import zlib
from dataclasses import dataclass

import numpy as np

from ...base.files import json_records as shapes
from ...base.files.atomic_write import atomic_write
from ...base.files.making_folders import make_folder_of
from ...base.files.png import encode_pixels
from ...errors import FileAccessError, FileFormatError
from ...version import PICTURES
from . import png_files
from .display import displayed
from .picture_files import decode_picture
from .pixel_hash import pixel_hash

_IDENTITY, _NUMBERS = b"goLD", b"daTA"
_PLACE = 37  # of the first chunk's name: after the signature, the header and a length
MAX_BYTES = 1 << 31  # limit for the numbers of one array
_SHAPE = shapes.members(
    {
        "dtype": shapes.one_of(*(np.dtype(kind).name for kind in "?bBhHiIqQefd")),
        "shape": shapes.listed(shapes.count),
        "sha256": shapes.sound_text,
        "seal": shapes.sound_text,
    },
    {"pictures": shapes.count},
)


@dataclass(frozen=True)
class GoldenFile:
    """A golden file that has been read but not decoded.

    Attributes
    ----------
    path : str
    data : bytes
        The whole file.
    digest : str or None
        What `pixel_hash` said of the pixels; None where the picture was made by other means.
    pictures : int or None
        `engine3d.PICTURES` of the engine3d that wrote the file; None if the file does not say it.
    """

    path: str
    data: bytes
    digest: str | None
    pictures: int | None = None

    def pixels(self) -> np.ndarray:
        """Decode the exact pixels. Raises `FileFormatError`."""
        exact = exact_pixels(self.data, self.path) if self.digest is not None else None
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
        identity = _identity(png_files.split_chunks(data), path)
    except png_files.DamagedPng as error:
        raise FileFormatError(str(error), path) from error
    if identity is None:
        return GoldenFile(path, data, None)
    return GoldenFile(path, data, identity["sha256"], identity.get("pictures"))


def is_golden_file(path: str | os.PathLike) -> bool:
    """Return whether a file begins as `encode_golden` writes it."""
    try:
        with open(path, "rb") as file:
            start = file.read(_PLACE + len(_IDENTITY))
    except OSError:
        return False
    return start.startswith(png_files.SIGNATURE) and start[_PLACE:] == _IDENTITY


def write_golden(path: str, pixels: np.ndarray, *, below: str | None = None) -> None:
    """Write a golden file whole or not at all, with the folders above it, as `atomic_write`.

    Raises `FileAccessError`.
    """
    make_folder_of(path, below=below)
    with atomic_write(path, below=below) as file:
        file.write(encode_golden(pixels))


def encode_golden(pixels: np.ndarray) -> bytes:
    """Return the bytes of a golden file."""
    shown = displayed(pixels) if needs_numbers(pixels) else pixels
    header, *body, end = png_files.split_chunks(encode_pixels(shown))
    if needs_numbers(pixels):
        body.append((_NUMBERS, zlib.compress(_by_place(pixels), 9)))
    identity = {
        "dtype": pixels.dtype.name,
        "shape": pixels.shape,
        "sha256": pixel_hash(pixels),
        "seal": _seal([header, *body]),
        "pictures": PICTURES,
    }
    text = json.dumps(identity, separators=(",", ":")).encode("ascii")
    return png_files.join_chunks([header, (_IDENTITY, text), *body, end])


def needs_numbers(pixels: np.ndarray) -> bool:
    """Return whether PNG colours cannot represent such pixels."""
    return pixels.dtype not in (np.bool_, np.uint8, np.uint16)


def exact_pixels(data: bytes, path: str) -> np.ndarray | None:
    """Return the exact pixels of a golden file; None if it is not sealed, or None is given.

    Raises `FileFormatError`, which names the path, where a sealed file is not what it says.
    """
    try:
        chunks = png_files.split_chunks(data)
    except png_files.DamagedPng:
        return None
    identity = _identity(chunks, path)
    if identity is None:
        return None
    dtype, shape = np.dtype(identity["dtype"]), tuple(identity["shape"])
    numbers = next((content for name, content in chunks if name == _NUMBERS), None)
    pixels = _decoded(data, path, dtype) if numbers is None else _unpacked(numbers, dtype, shape)
    if pixels is None or pixels.size != math.prod(shape):
        raise FileFormatError("the golden picture does not hold the numbers that it should", path)
    pixels = pixels.reshape(shape)
    if pixel_hash(pixels) != identity["sha256"]:
        raise FileFormatError("damaged: the golden picture is not what its own hash says", path)
    return pixels


def _decoded(data: bytes, path: str, dtype: np.dtype) -> np.ndarray:
    """Return the pixels of the viewable picture."""
    pixels = decode_picture(data, path).frames[0]
    return pixels > 0 if dtype == np.bool_ else pixels


def _unpacked(numbers: bytes, dtype: np.dtype, shape: tuple[int, ...]) -> np.ndarray | None:
    """Return the numbers stored beside the picture; None if damaged or of wrong length."""
    size = math.prod(shape) * dtype.itemsize
    if not 0 < size <= MAX_BYTES:
        return None
    try:
        places = zlib.decompressobj().decompress(numbers, size)
    except zlib.error:
        return None
    if len(places) != size:
        return None
    columns = np.frombuffer(places, np.uint8).reshape(dtype.itemsize, -1)
    return np.ascontiguousarray(columns.T).view(dtype.newbyteorder("<")).astype(dtype)


def _identity(chunks: list[tuple[bytes, bytes]], path: str) -> dict | None:
    """Return the seal's data on the pixels; None for other files.

    Raises `FileFormatError` where a file says it in no way that it is written in.
    """
    text = next((content for name, content in chunks if name == _IDENTITY), None)
    if text is None:
        return None
    identity = shapes.parsed(text, path, _SHAPE)
    is_whole = identity["seal"] == _seal([c for c in chunks if c[0] not in (_IDENTITY, b"IEND")])
    return identity if is_whole else None


def _seal(chunks: list[tuple[bytes, bytes]]) -> str:
    summary = hashlib.sha256()
    for name, content in chunks:
        summary.update(name + len(content).to_bytes(4, "big"))
        summary.update(content)
    return summary.hexdigest()


def _by_place(pixels: np.ndarray) -> bytes:
    """Return the bytes of all numbers, lowest bytes first: they compress better."""
    return np.ascontiguousarray(pixels.reshape(-1, 1).view(np.uint8).T).tobytes()

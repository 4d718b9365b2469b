"""Reads image files for comparison; for golden files, their exact numbers."""

from __future__ import annotations

import os

from ...errors import FileAccessError
from .golden_files import exact_pixels
from .picture_files import Picture, decode_picture


def read_picture(path: str | os.PathLike) -> Picture:
    """Read an image file of any format that engine3d reads.

    Raises
    ------
    FileAccessError, FileFormatError
    """
    path = os.fspath(path)
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        raise FileAccessError(f"cannot read: {error.strerror}", path) from error
    pixels = exact_pixels(data, path)
    return decode_picture(data, path) if pixels is None else Picture([pixels])

"""OpenEXR images, decoded by the optional package OpenEXR.

In: the bytes of a file. Out: (H, W, 3) float32 linear light. The package reads only paths, so
content in memory goes through a temporary file. Sizes are checked before any pixel is decoded.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.files.temporary_copy import temporary_copy
from ...base.optional_packages import needed
from ...errors import FileAccessError, FileFormatError
from ..reading.sources import Source
from .images import check_image_size

_CHANNELS = (("R", "G", "B"), ("Y", "Y", "Y"))


def read_exr(source: Source) -> NDArray[np.float32]:
    """Decode the first part of an OpenEXR file.

    Returns
    -------
    pixels : (H, W, 3) float32
        The channels R, G and B, or Y alone; others are ignored.

    Raises
    ------
    FileAccessError
        The package OpenEXR is not installed.
    FileFormatError
    """
    try:
        import OpenEXR
    except ImportError:
        raise FileAccessError(needed("OpenEXR files need", "OpenEXR", "exr"), source.path) from None
    with temporary_copy(source.data, "picture.exr") as path:
        try:
            with _silence():
                header = OpenEXR.File(path, header_only=True).header()
                check_image_size(*_size(header), source.path, source.size)
                channels = OpenEXR.File(path, separate_channels=True).channels()
                planes = {name: channel.pixels for name, channel in channels.items()}
        except (FileFormatError, MemoryError):
            raise
        except Exception as error:  # the library raises various errors for damaged files
            lines = str(error).replace(path, "it").strip().splitlines()
            reason = lines[0] if lines else "it cannot be decoded"
            raise FileFormatError(f"damaged OpenEXR picture: {reason}", source.path) from None
    return _joined(planes, source.path)


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Silence the library, which prints its errors to both streams of the process."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        with contextlib.redirect_stdout(None):
            yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)


def _size(header: dict[str, Any]) -> tuple[int, int]:
    low, high = header["dataWindow"]
    return int(high[0]) - int(low[0]) + 1, int(high[1]) - int(low[1]) + 1


def _joined(planes: dict[str, np.ndarray], path: str) -> NDArray[np.float32]:
    for names in _CHANNELS:
        found = [planes[name] for name in names if name in planes]
        if len(found) == 3 and len({plane.shape for plane in found}) == 1:
            with np.errstate(over="ignore"):
                return np.stack([plane.astype(np.float32) for plane in found], axis=-1)
    listed = ", ".join(sorted(planes)) or "none"
    raise FileFormatError(f"no channels R, G and B, nor Y, of one size, but {listed}", path)

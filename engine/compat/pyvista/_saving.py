"""Saves pictures as PyVista does: the suffix of a name decides, and none is PNG.

In: pixels, and a name or a buffer. Out: a file, whole or not at all.
"""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
from numpy.typing import NDArray

from ...base.files.atomic_write import atomic_write
from ...base.numbers import shown
from ...errors import InvalidArgumentError

_FORMATS = {
    ".png": "PNG",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
    ".bmp": "BMP",
    ".tif": "TIFF",
    ".tiff": "TIFF",
}


def save_pixels(pixels: NDArray[np.uint8], filename: Any) -> None:
    """Save pixels.

    Raises
    ------
    InvalidArgumentError
        The suffix is none of a picture, or the name is no name.
    FileAccessError
    """
    from PIL import Image

    picture = Image.fromarray(pixels)
    if isinstance(filename, io.BytesIO):
        picture.save(filename, format="PNG")
        return
    path, form = _checked(filename)
    if form == "JPEG":
        picture = picture.convert("RGB")
    data = io.BytesIO()
    picture.save(data, format=form)
    with atomic_write(path) as file:
        file.write(data.getvalue())


def _checked(filename: Any) -> tuple[Path, str]:
    if not isinstance(filename, (str, os.PathLike)):
        raise InvalidArgumentError(f"filename must be a path or io.BytesIO, not {shown(filename)}")
    path = Path(filename).expanduser()
    if not path.name:
        raise InvalidArgumentError(f"filename must be the name of a file, not {shown(filename)}")
    if isinstance(pyvista.FIGURE_PATH, str) and not path.is_absolute():
        path = Path(pyvista.FIGURE_PATH) / path
    if not path.suffix:
        path = path.with_suffix(".png")
    form = _FORMATS.get(path.suffix.lower())
    if form is None:
        known = ", ".join(_FORMATS)
        raise InvalidArgumentError(f"{path.name}: the suffix must be one of {known}")
    return path, form

"""Colour maps: tables that map numbers to colours.

In: the name of a map, a picture whose middle row is a map, or positions with colours. Out: a table
of colours. The maps of matplotlib and Google's turbo are interpolated between a few of their
colours; both are free for any use (CC0 and Apache-2.0).
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.near_words import meant
from ...base.numbers import as_array
from ...errors import InvalidArgumentError
from ...io.loaders import load_texture
from ...model.materials.color_names import color_of_word

#: The choices of a colour map: see `colormap`.
ColormapLike: TypeAlias = str | ArrayLike | Callable[[Any], Any]

SIZE = 256
#: The colour of missing numbers.
MISSING = (128, 128, 128)
_COLORS = {
    "viridis": "440154 482878 3e4a89 31688e 26828e 1f9e89 35b779 6ece58 b5de2b fde725",
    "plasma": "0d0887 47039f 7301a8 9c179e bd3786 d8576b ed7953 fa9e3b fdc926 f0f921",
    "inferno": "000004 1b0c41 4a0c6b 781c6d a52c60 cf4446 ed6925 fb9b06 f7d13d fcffa4",
    "magma": "000004 180f3d 440f76 721f81 9e2f7f cd4071 f1605d fd9668 feca8d fcfdbf",
    "turbo": "30123b 4145ab 4675ed 39a2fc 1bcfd4 24eca6 61fc6c a4fc3b d1e834 f3c63a fe9b2d "
    "f36315 d93806 b11901 7a0402",
    "coolwarm": "3b4cc0 6788ee 9abbff c9d7f0 edd1c2 f7a889 e26952 b40426",
    "gray": "000000 ffffff",
}
COLORMAPS = tuple(_COLORS)
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_PART = re.compile(r"[^,(]+(?:\([^)]*\))?")  # keeps rgb(1,2,3) together


def colormap(name: ColormapLike) -> NDArray[np.uint8]:
    """Return the table of a colour map.

    Parameters
    ----------
    name : str, colour map of matplotlib, list of str, or (N, 3) or (N, 4) array
        One of `COLORMAPS`, the path of a picture, or positions with colours, as in f3d:
        ``0,#000000,1,white`` or, with three numbers from 0 to 1 per colour, ``0,0,0,0,1,1,1,1``.
        Colours of an array are display values, lowest number first: 0 to 255 if ``uint8``, else 0
        to 1; alpha is left out. A list may name the colours. Few colours show as bands.

    Returns
    -------
    colors : (N, 3) uint8
        sRGB, lowest number first.

    Raises
    ------
    InvalidArgumentError
        There is neither such a map nor such a file, or the positions do not ascend from 0 to 1.
    FileFormatError
        The file is not a picture.
    """
    if callable(name):
        name = np.asarray(name(np.linspace(0.0, 1.0, SIZE)))
    if not isinstance(name, str):
        return _checked_table(name)
    if name in _COLORS:
        given = np.array([list(bytes.fromhex(color)) for color in _COLORS[name].split()], float)
        return _table(np.linspace(0.0, 1.0, len(given)), given)
    if not os.path.isfile(name):
        if "," in name:
            return _placed(name)
        known = ", ".join(COLORMAPS) + meant(name, COLORMAPS)
        raise InvalidArgumentError(f"colormap {name!r} is neither a picture nor one of {known}")
    pixels = load_texture(name).pixels
    return np.ascontiguousarray(pixels[len(pixels) // 2, :, :3])


def _checked_table(value: ArrayLike) -> NDArray[np.uint8]:
    """Return an array of colours, or their names, as (N, 3) uint8."""
    array = as_array(value, "colormap")
    if array.dtype.kind == "U" and array.ndim == 1:
        array = np.array([color_of_word(word, "colormap")[:3] for word in array.tolist()], np.uint8)
    if array.ndim != 2 or array.shape[1] not in (3, 4) or len(array) < 2:
        raise InvalidArgumentError(
            f"colormap must be a name or (N, 3) colours from N = 2 on, not of shape {array.shape}"
        )
    if array.dtype == np.uint8:
        return np.ascontiguousarray(array[:, :3])
    if array.dtype.kind != "f" or not ((array >= 0.0) & (array <= 1.0)).all():
        raise InvalidArgumentError("the colours of a colormap must be uint8, or from 0.0 to 1.0")
    return np.rint(array[:, :3] * 255.0).astype(np.uint8)


def _table(places: NDArray[np.float64], colors: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Interpolate between colours at positions from 0 to 1."""
    wanted = np.linspace(0.0, 1.0, SIZE)
    columns = [np.interp(wanted, places, colors[:, k]) for k in range(3)]
    return np.rint(np.stack(columns, axis=1)).astype(np.uint8)


def _placed(text: str) -> NDArray[np.uint8]:
    """Return the table for positions with colours."""
    parts = [part.strip() for part in _PART.findall(text)]
    try:
        if len(parts) % 4 == 0 and all(_NUMBER.fullmatch(part) for part in parts):
            numbers = np.array(parts, np.float64).reshape(-1, 4)
            places, colors = numbers[:, 0], numbers[:, 1:].clip(0.0, 1.0) * 255.0
        else:
            places = np.array(parts[::2], np.float64)
            colors = np.array([color_of_word(part)[:3] for part in parts[1::2]], np.float64)
    except ValueError as error:
        raise InvalidArgumentError(f"{text!r} is no list of places and colours: {error}") from None
    is_rising = len(places) == len(colors) > 1 and (np.diff(places) > 0).all()
    if not (is_rising and places[0] >= 0.0 and places[-1] <= 1.0):
        raise InvalidArgumentError(f"{text!r}: the places of colours must ascend from 0 to 1")
    return _table(places, colors)

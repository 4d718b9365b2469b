"""Colour maps: from numbers to colours.

In: the name of a map, or a picture whose middle row is one. Out: a table of colours. The maps of
matplotlib and of Google's turbo are interpolated between a few of their own colours; both are free
for any use (CC0 and Apache-2.0).
"""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidArgumentError
from ..loaders import load_texture

SIZE = 256
#: What has no number.
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


def colormap(name: str) -> NDArray[np.uint8]:
    """Return the table of a colour map.

    Parameters
    ----------
    name : str
        One of `COLORMAPS`, or the path of a picture.

    Returns
    -------
    colors : (N, 3) uint8
        sRGB, that of the least number first.

    Raises
    ------
    InvalidArgumentError
        There is neither such a map nor such a file.
    FileFormatError
        The file is no picture.
    """
    if name in _COLORS:
        given = np.array([list(bytes.fromhex(color)) for color in _COLORS[name].split()], float)
        places = np.linspace(0.0, len(given) - 1.0, SIZE)
        columns = [np.interp(places, np.arange(len(given)), given[:, k]) for k in range(3)]
        return np.rint(np.stack(columns, axis=1)).astype(np.uint8)
    if not os.path.isfile(name):
        known = ", ".join(COLORMAPS)
        raise InvalidArgumentError(f"{name!r} is neither a picture nor one of {known}")
    pixels = load_texture(name).pixels
    return np.ascontiguousarray(pixels[len(pixels) // 2, :, :3])

"""Pictures as sixels: bands of six rows, with a line of characters per colour.

In: pixels. Out: bytes for a terminal. The format is DEC's, of the VT330/VT340 programmer reference
manual, chapter 14; colours are percentages there.
"""

from __future__ import annotations

import re

import numpy as np

#: Colour registers that every sixel terminal has.
COLORS = 256
BAND = 6
_RUNS = re.compile(rb"(.)\1{3,}", re.DOTALL)


def encode(pixels: np.ndarray) -> bytes:
    """Return the codes that show a picture at the cursor, in the terminal's pixels.

    Parameters
    ----------
    pixels : (H, W, 4) uint8
        Alpha is not looked at.
    """
    from PIL import Image

    height, width = pixels.shape[:2]
    picture = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    reduced = picture.quantize(COLORS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    palette = np.array(reduced.getpalette(), np.int64).reshape(-1, 3)
    head = f'\x1bP0;1;0q"1;1;{width};{height}'
    for number, color in enumerate((palette * 100 + 127) // 255):
        head += f"#{number};2;{color[0]};{color[1]};{color[2]}"
    indices = np.zeros((-(-height // BAND) * BAND, width), np.int64)
    indices[:height] = np.asarray(reduced)
    bands = [
        _band(rows, height - BAND * n)
        for n, rows in enumerate(np.split(indices, len(indices) // BAND))
    ]
    return head.encode() + b"-".join(bands) + b"\x1b\\"


def _band(rows: np.ndarray, filled: int) -> bytes:
    """Return a band of six rows, ``filled`` of them used, with a line for each colour."""
    rows = rows[:filled]
    colors, places = np.unique(rows, return_inverse=True)
    places = places.reshape(rows.shape)
    sixels = np.full((len(colors), rows.shape[1]), 63, np.uint8)
    columns = np.arange(rows.shape[1])
    for bit, row in enumerate(places):
        sixels[row, columns] += np.uint8(1 << bit)
    return b"$".join(
        b"#%d" % color + _RUNS.sub(_run, line.tobytes())
        for color, line in zip(colors, sixels, strict=True)
    )


def _run(match: re.Match) -> bytes:
    return b"!%d%s" % (len(match[0]), match[1])

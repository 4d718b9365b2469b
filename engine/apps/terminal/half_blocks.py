"""Pictures as coloured text: an upper half block per two pixels.

In: pixels. Out: bytes for any terminal that has 24-bit colours.
"""

from __future__ import annotations

import numpy as np

_HALF = "\N{UPPER HALF BLOCK}"


def encode(pixels: np.ndarray) -> bytes:
    """Return lines of text that show a picture, from the left of the cursor's line on.

    Parameters
    ----------
    pixels : (H, W, 4) uint8
        Alpha is not looked at. A cell shows two rows of one column.
    """
    height = len(pixels) // 2 * 2
    rows = pixels[:height, :, :3].tolist()
    lines = [_line(upper, lower) for upper, lower in zip(rows[::2], rows[1::2], strict=True)]
    return "\r\n".join(lines).encode()


def _line(upper: list, lower: list) -> str:
    """Return a line of cells; colours are named where they change."""
    parts, front, back = [], None, None
    for above, below in zip(upper, lower, strict=True):
        if above != front:
            parts.append(f"\x1b[38;2;{above[0]};{above[1]};{above[2]}m")
            front = above
        if below != back:
            parts.append(f"\x1b[48;2;{below[0]};{below[1]};{below[2]}m")
            back = below
        parts.append(_HALF)
    return "".join(parts) + "\x1b[0m"

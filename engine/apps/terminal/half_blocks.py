"""Pictures as coloured text: one upper half block for two pixels.

In: pixels. Out: bytes for any terminal with 24-bit colours.
"""

from __future__ import annotations

import numpy as np

_HALF = "\N{UPPER HALF BLOCK}"


def encode(pixels: np.ndarray) -> bytes:
    """Return lines of text that show a picture, starting at the cursor's line.

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
    """Return a line of cells; colour codes appear only at changes."""
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

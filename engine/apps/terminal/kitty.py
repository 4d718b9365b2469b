"""Pictures in kitty's graphics protocol, which WezTerm and Ghostty also support.

In: pixels. Out: bytes for a terminal. The protocol is described by kitty's manual, "Terminal
graphics protocol".
"""

from __future__ import annotations

import zlib
from base64 import b64encode

import numpy as np

#: The protocol's limit on the payload of one escape code.
CHUNK = 4096
#: The fastest level: time matters more than a few bytes.
LEVEL = 1


def encode(pixels: np.ndarray, columns: int, rows: int, number: int | None = None) -> bytes:
    """Return the codes that show a picture at the cursor, which does not move.

    Parameters
    ----------
    pixels : (H, W, 4) uint8
        Alpha is not looked at.
    columns, rows : int
        Cells of text that the picture covers: the terminal scales it.
    number : int, optional
        A picture of the same number that is there already is replaced.
    """
    height, width = pixels.shape[:2]
    data = b64encode(zlib.compress(np.ascontiguousarray(pixels[..., :3]), LEVEL))
    keys = f"a=T,f=24,o=z,s={width},v={height},c={columns},r={rows},C=1,q=2"
    if number is not None:
        keys += f",i={number},p=1"
    chunks = [data[start : start + CHUNK] for start in range(0, len(data), CHUNK)]
    codes = []
    for index, chunk in enumerate(chunks):
        more = int(index + 1 < len(chunks))
        head = f"{keys},m={more}" if index == 0 else f"m={more}"
        codes.append(b"\x1b_G" + head.encode() + b";" + chunk + b"\x1b\\")
    return b"".join(codes)


def delete(number: int) -> bytes:
    """Return the codes that delete the picture with a number."""
    return f"\x1b_Ga=d,d=I,i={number},q=2\x1b\\".encode()

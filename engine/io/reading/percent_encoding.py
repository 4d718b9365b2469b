"""Bytes written as in URIs, ``%20`` for a blank.

In: text. Out: bytes. Python's own function takes many times the memory of a long text; here it gets
one piece after the other.
"""

from __future__ import annotations

from urllib.parse import unquote_to_bytes

_PIECE = 1 << 14
# Letters of an escape behind its percent sign.
_ESCAPE = 2


def percent_decoded(text: str) -> bytes:
    """Return the bytes that a text stands for."""
    made = bytearray()
    start = 0
    while start < len(text):
        end = start + _PIECE
        # An escape is not cut.
        sign = text.rfind("%", end - _ESCAPE, end)
        end = end if sign < 0 else sign
        made += unquote_to_bytes(text[start:end])
        start = end
    return bytes(made)

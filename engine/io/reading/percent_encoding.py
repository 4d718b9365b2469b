"""Percent-decoding of URIs.

In: text. Out: bytes. Python's own function takes many times the memory of a long text, so this one
passes it one piece at a time.
"""

from __future__ import annotations

from urllib.parse import unquote_to_bytes

_PIECE = 1 << 14
# Characters of an escape after its percent sign.
_ESCAPE = 2


def percent_decoded(text: str) -> bytes:
    """Return the decoded bytes of a text."""
    made = bytearray()
    start = 0
    while start < len(text):
        end = start + _PIECE
        # Do not cut an escape.
        sign = text.rfind("%", end - _ESCAPE, end)
        end = end if sign < 0 else sign
        made += unquote_to_bytes(text[start:end])
        start = end
    return bytes(made)

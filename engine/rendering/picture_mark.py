"""A mark that tells a picture drawn by engine3d from an image painted for a model.

TGA files can say who wrote them: `Frame.save` puts these words in their image identification. A
model that is drawn to ``head.tga`` twice must not wear the first picture in the second.
"""

from __future__ import annotations

TGA_MARK = b"drawn by engine3d"

_HEADER_BYTES = 18
#: Enough of a file for `is_own_picture`.
MARKED_BYTES = _HEADER_BYTES + len(TGA_MARK)


def is_own_picture(head: bytes) -> bool:
    """Return whether the first bytes of a TGA file bear the mark."""
    return head[:1] == bytes([len(TGA_MARK)]) and head[_HEADER_BYTES:MARKED_BYTES] == TGA_MARK

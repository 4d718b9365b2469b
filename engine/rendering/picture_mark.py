"""Marks pictures drawn by engine3d, to tell them from textures.

TGA files can name their author: `Frame.save` writes this mark into the image ID. Otherwise a model
rendered to ``head.tga`` twice would get the first picture as texture in the second.
"""

from __future__ import annotations

TGA_MARK = b"drawn by engine3d"

_HEADER_BYTES = 18
#: The bytes of a file that `is_own_picture` needs.
MARKED_BYTES = _HEADER_BYTES + len(TGA_MARK)


def is_own_picture(head: bytes) -> bool:
    """Return whether the first bytes of a TGA file contain the mark."""
    return head[:1] == bytes([len(TGA_MARK)]) and head[_HEADER_BYTES:MARKED_BYTES] == TGA_MARK

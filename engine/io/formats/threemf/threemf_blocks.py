"""The long lists of a 3MF file, read at once where they are written as all programs write them.

In: the XML of a part. Out: the same without the content of its lists of vertices and triangles, and
that content as arrays. A list in which anything else stands is left where it is, for `ModelParser`
to read element by element: both ways make the same of a file.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...._native import loaders as native
from ...reading.number_arrays import NotANumberError, ended, read_numbers

# How elements are written: what begins one, stands between its numbers, and ends it.
_VERTEX = (b'<vertex x="', b'" y="', b'" z="')
_TRIANGLE = (b'<triangle v1="', b'" v2="', b'" v3="')
_ENDS = (b'"/>', b'" />')
_LISTS = {
    b"vertices": (_VERTEX, b"0123456789+-.eE"),
    b"triangles": (_TRIANGLE, b"0123456789"),
}
_BLANKS = b" \t\r\n"
_FIRST, _LAST = 1, 4  # bytes that no XML holds take the place of the pieces
_TAG = re.compile(rb"<(/?)(vertices|triangles)>")


def cut_lists(text: bytes) -> tuple[bytes, dict[int, NDArray[np.float64]]]:
    """Take the lists out of a text.

    Returns
    -------
    text : bytes
        With as many lines.
    lists : dict of int to (N, 3) float64
        By where in the new text the element begins that held the list.
    """
    pieces: list[bytes] = []
    lists: dict[int, NDArray[np.float64]] = {}
    done = length = 0
    first = None
    for match in _TAG.finditer(text):
        if not match[1]:
            first = match
            continue
        if first is None or first[2] != match[2]:
            first = None
            continue
        content = text[first.end() : match.start()]
        values = _numbers(content, *_LISTS[match[2]])
        if values is not None:
            kept = text[done : first.end()]
            lists[length + first.start() - done] = values
            pieces += [kept, b"\n" * content.count(b"\n")]
            length += len(kept) + len(pieces[-1])
            done = match.start()
        first = None
    return b"".join([*pieces, text[done:]]), lists


def _numbers(content: bytes, form: Sequence[bytes], allowed: bytes) -> NDArray[np.float64] | None:
    """The numbers of a list of elements of one form, (N, 3); None if anything else is in it."""
    marked = content
    for number, piece in enumerate(form):
        marked = marked.replace(piece, bytes([_FIRST + number]))
    for piece in _ENDS:
        marked = marked.replace(piece, bytes([_LAST]))
    if marked.translate(None, allowed + _BLANKS + bytes(range(_FIRST, _LAST + 1))):
        return None
    letters = np.frombuffer(marked, np.uint8)
    places = np.flatnonzero(letters <= _LAST)
    if len(places) % 4 or not _is_regular(letters, places):
        return None
    numbers = marked.translate(bytes.maketrans(bytes(range(_FIRST, _LAST + 1)), b" " * 4))
    try:
        values = read_numbers(ended(numbers), native.NO_COMMENTS).values
    except NotANumberError:
        return None
    return values.reshape(-1, 3) if len(values) == len(places) // 4 * 3 else None


def _is_regular(letters: NDArray[np.uint8], places: NDArray[np.int64]) -> bool:
    """Whether marks come in their order, with a number in each place and blanks only outside."""
    kinds = letters[places].reshape(-1, 4)
    if not (kinds == np.arange(_FIRST, _LAST + 1)).all():
        return False
    widths = np.diff(places).reshape(-1)
    inside = np.arange(len(widths)) % 4 < 3
    if (widths[inside] < 2).any():
        return False
    blanks = np.flatnonzero((letters == 32) | ((letters >= 9) & (letters <= 13)))
    before = np.searchsorted(places, blanks)
    if (before % 4 != 0).any():
        return False
    # Nothing but blanks stands between one element and the next, before the first, after the last.
    room = np.diff(np.concatenate([[-1], places, [len(letters)]]))[::4] - 1
    return int(room.sum()) == len(blanks)

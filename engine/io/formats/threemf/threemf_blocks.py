"""Fast parsing of the long lists in a 3MF file, for their usual spelling.

In: the XML of a part. Out: the same without the content of its vertex and triangle lists, and that
content as arrays. Lists in any other spelling stay in the XML, where `ModelParser` reads them
element by element: both ways give the same result.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...._native import loaders as native
from ...reading.number_arrays import NotANumberError, ended, read_numbers

# The text of an element: its start, between its numbers, and its end.
_VERTEX = (b'<vertex x="', b'" y="', b'" z="')
_TRIANGLE = (b'<triangle v1="', b'" v2="', b'" v3="')
_ENDS = (b'"/>', b'" />')
_LISTS = {
    b"vertices": (_VERTEX, b"0123456789+-.eE"),
    b"triangles": (_TRIANGLE, b"0123456789"),
}
_BLANKS = b" \t\r\n"
_FIRST, _LAST = 1, 4  # bytes that cannot occur in XML mark these pieces
_TAG = re.compile(rb"<(/?)(vertices|triangles)>")


def cut_lists(text: bytes) -> tuple[bytes, dict[int, NDArray[np.float64]]]:
    """Cut the lists out of a text.

    Returns
    -------
    text : bytes
        The rest, with the same number of lines.
    lists : dict of int to (N, 3) float64
        The lists, by the offset in the new text of the element that held them.
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
    """Return the numbers of a list of uniform elements, (N, 3); None for other content."""
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
    """Return whether marks are in order, with a number in each place and only blanks outside."""
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
    # Only blanks may occur between elements, before the first, and after the last.
    room = np.diff(np.concatenate([[-1], places, [len(letters)]]))[::4] - 1
    return int(room.sum()) == len(blanks)

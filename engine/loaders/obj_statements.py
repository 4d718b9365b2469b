"""The statements of an OBJ file: where each one's words stand, found with NumPy in one pass.

In: the text of the file. Out: a `Statements` table with one row a line that holds anything: its
keyword, its words, its line number. Comments are blanked and continued lines joined before, both
without moving a byte.
"""

from __future__ import annotations

import re

import numpy as np

_BLANKS = b" \t\n\v\f"
_IS_BLANK = np.isin(np.arange(256), np.frombuffer(_BLANKS, np.uint8))

_COMMENT = re.compile(rb"#[^\n]*")
_LATER_COMMENT = re.compile(rb"(?<=[ \t\v\f])#")
_CONTINUATION = re.compile(rb"\\[ \t]*\n")


class Statements:
    """The lines of a file that are not empty.

    Attributes
    ----------
    text : bytes
        As the words' positions refer to it.
    codes : (buffer,) uint8
        The same bytes as an array.
    word_starts, word_ends : (W,) int64
        Positions of all words; a comment is none.
    first : (S,) int64
        The first word of each statement: its keyword.
    count : (S,) int64
        Words of each statement without the keyword.
    keyword : (S,) int64
        The keyword's bytes as a number, first byte lowest, for keywords of one or two bytes; else
        0. See `keyword_code`.
    line_end : (S,) int64
        Position of the line feed that ends the statement.
    """

    def __init__(self, text: bytes) -> None:
        self._original = text
        self._line_ends: np.ndarray | None = None
        if b"\\" in text:
            text = _CONTINUATION.sub(_join_line, text)
        if b"#" in text:
            text = _COMMENT.sub(_blank_comment, text)
        self.text = text
        self.codes = np.frombuffer(text, np.uint8)
        self._find_words()

    def _find_words(self) -> None:
        is_blank = _IS_BLANK[self.codes]
        changes = np.flatnonzero(is_blank[1:] != is_blank[:-1]) + 1
        if not is_blank[0]:
            changes = np.concatenate([[0], changes])
        self.word_starts, self.word_ends = changes[0::2], changes[1::2]
        line_ends = np.flatnonzero(self.codes == ord("\n"))
        words_before = np.searchsorted(self.word_starts, line_ends)
        count = np.diff(words_before, prepend=0)
        used = count > 0
        self.first = (words_before - count)[used]
        self.count = count[used] - 1
        self.line_end = line_ends[used]
        starts = self.word_starts[self.first]
        length = self.word_ends[self.first] - starts
        low = self.codes[starts].astype(np.int64)
        high = self.codes[np.minimum(starts + 1, len(self.codes) - 1)].astype(np.int64)
        self.keyword = np.where(length == 1, low, np.where(length == 2, low | high << 8, 0))

    def of(self, keyword: str) -> np.ndarray:
        """Return the numbers of the statements with a keyword of one or two letters."""
        return np.flatnonzero(self.keyword == keyword_code(keyword))

    def line(self, statement: int) -> int:
        """Return the line, from 1, that a statement begins in."""
        if self._line_ends is None:
            original = np.frombuffer(self._original, np.uint8)
            self._line_ends = np.flatnonzero(original == ord("\n"))
        start = int(self.word_starts[self.first[statement]])
        return 1 + int(np.searchsorted(self._line_ends, start))

    def keyword_text(self, statement: int) -> bytes:
        return self.word(int(self.first[statement]))

    def word(self, number: int) -> bytes:
        return self.text[self.word_starts[number] : self.word_ends[number]]

    def words(self, statement: int) -> list[bytes]:
        """Return the words of a statement after its keyword."""
        return self.rest(statement).split()

    def rest(self, statement: int) -> bytes:
        """Return what follows the keyword, without the blanks around it: names may hold blanks."""
        return self.text[self.word_ends[self.first[statement]] : self.line_end[statement]].strip()

    def words_of(self, statements: np.ndarray) -> list[bytes]:
        """Return all words after the keywords of some statements, in one list."""
        if len(statements) == 0:
            return []
        start = int(self.word_starts[self.first[statements[0]]])
        end = int(self.line_end[statements[-1]])
        # One copy of the text with everything else blanked is faster than a slice for each word.
        edges = np.empty(2 * len(statements), np.int64)
        edges[0::2] = self.word_ends[self.first[statements]] - start
        edges[1::2] = self.line_end[statements] - start
        lengths = np.diff(edges, prepend=0)
        wanted = np.repeat(np.arange(len(edges)) % 2 == 1, lengths)
        return np.where(wanted, self.codes[start:end], np.uint8(32)).tobytes().split()


def keyword_code(keyword: str) -> int:
    """Return the number that stands for a keyword of one or two letters."""
    return int.from_bytes(keyword.encode(), "little")


def _blank_comment(match: re.Match) -> bytes:
    """Blank what a '#' begins, unless the '#' is part of a word."""
    comment, text, start = match[0], match.string, match.start()
    if _begins_comment(text, start):
        return b" " * len(comment)
    later = _LATER_COMMENT.search(comment)
    kept = len(comment) if later is None else later.start()
    return comment[:kept] + b" " * (len(comment) - kept)


def _begins_comment(text: bytes, position: int) -> bool:
    """Names may hold a '#', and so do numbers like ``1.#QNAN``; else it always begins a comment."""
    before = text[position - 1 : position]
    if not before or before in _BLANKS:
        return True
    line_start = text.rfind(b"\n", 0, position) + 1
    is_numeric = text[line_start:position].lstrip()[:1] in (b"v", b"f", b"l", b"p", b"s")
    return is_numeric and before != b"."


def _join_line(match: re.Match) -> bytes:
    """A backslash at the end of a line continues it, but not that of a comment (a path, say)."""
    start = match.string.rfind(b"\n", 0, match.start()) + 1
    if match.string[start : match.start()].lstrip().startswith(b"#"):
        return match[0]
    return b" " * len(match[0])

"""Parses numbers from text, correctly rounded and independent of the locale.

In: text with only numbers and comments, or one word. Out: an array, or a float.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from ..._native import loaders as native

# Non-finite values as written by Microsoft's C runtimes.
_MICROSOFT = re.compile(rb"([+-]?)(?:\d\.#(INF|IND|QNAN|SNAN|QNB)\d*|nan\([a-z]*\))", re.IGNORECASE)
_WORD = re.compile(rb"\S+")


class NotANumberError(ValueError):
    """A text contains something other than numbers.

    Attributes
    ----------
    word : bytes
    position : int
        Its offset in the text.
    widths : (R,) int64
        Widths of the lines before; see `NumberRows`.
    """

    def __init__(self, word: bytes, position: int, widths: np.ndarray) -> None:
        super().__init__(word, position, widths)
        self.word, self.position, self.widths = word, position, widths


class NumberRows(NamedTuple):
    """The numbers of a text.

    Attributes
    ----------
    values : (N,) float64
    widths : (R,) int64
        Count of numbers in each non-empty line; empty if not counted.
    end : int
        The offset after the last line read.
    """

    values: np.ndarray
    widths: np.ndarray
    end: int


def read_numbers(
    text: bytes | memoryview, comments: int, rows: int | None = None, widths: bool = False
) -> NumberRows:
    """Read numbers separated by blanks.

    Parameters
    ----------
    text : bytes-like
        Its last byte must be a blank or line end: see `ended`.
    comments : int
        ``native.NO_COMMENTS``, ``HASH_COMMENTS`` or ``PLY_COMMENTS``.
    rows : int, optional
        Number of non-empty lines to read; by default all.
    widths : bool
        Whether to count the numbers in each line.

    Raises
    ------
    NotANumberError
    """
    values, counted, end, wrong = native.read_numbers(text, comments, rows, widths)
    found = np.zeros(0, np.int64) if counted is None else counted
    if wrong is not None:
        match = _WORD.match(text, wrong)
        assert match is not None  # anything but a number is a word
        word = match[0]
        if comments == native.HASH_COMMENTS:
            word = word.partition(b"#")[0]
        raise NotANumberError(word, wrong, found)
    return NumberRows(values, found, end)


def ended(text: bytes | memoryview) -> bytes | memoryview:
    """Return a text that ends in a blank or line end: itself, or a copy."""
    return text if bytes(text[-1:]).isspace() else bytes(text) + b"\n"


def parse_float(word: bytes) -> float:
    """Parse one float, also ``1.#QNAN`` and the like; raise ValueError otherwise."""
    try:
        return float(word)
    except ValueError:
        match = _MICROSOFT.fullmatch(word)
        if match is None:
            raise
        value = float("inf") if (match[2] or b"").upper() == b"INF" else float("nan")
        return -value if match[1] == b"-" else value

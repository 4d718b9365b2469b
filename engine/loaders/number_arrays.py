"""Numbers out of text, many at a time.

In: text of nothing but numbers. Out: an array, each number rounded correctly whatever the locale.
"""

from __future__ import annotations

import re
import warnings
from array import array

import numpy as np

# What the C runtime of old Microsoft compilers wrote for values that are not numbers.
_MICROSOFT = re.compile(rb"([+-]?)\d\.#(INF|IND|QNAN|SNAN|QNB)\d*", re.IGNORECASE)
_WORD = re.compile(rb"\S+")
_BLANKS = b" \t\r\n\v\f"


class NotANumberError(ValueError):
    """Something else than a number stands in a text.

    Attributes
    ----------
    word : bytes
    position : int
        Its offset in the text.
    """

    def __init__(self, word: bytes, position: int) -> None:
        super().__init__(word, position)
        self.word, self.position = word, position


def parse_text(text: bytes) -> np.ndarray:
    """Read a text of nothing but numbers and blanks: (N,) float64.

    Raises
    ------
    NotANumberError
    """
    if not text.strip(_BLANKS):
        return np.zeros(0, np.float64)
    try:
        # NumPy before 2.4 warns where later ones raise.
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)
            return np.fromstring(text, np.float64, sep=" ")
    except (ValueError, DeprecationWarning):
        # Either one of the few words that only Python takes for a number, or none at all.
        return _parse_words(text)


def _parse_words(text: bytes) -> np.ndarray:
    values, match = array("d"), None
    try:
        for match in _WORD.finditer(text):
            values.append(parse_float(match[0].replace(b"_", b"?")))
    except ValueError:
        raise NotANumberError(match[0], match.start()) from None
    return np.frombuffer(values, np.float64)


def parse_float(word: bytes) -> float:
    """Read one float, also ``1.#QNAN`` and the like; raises ValueError."""
    try:
        return float(word)
    except ValueError:
        match = _MICROSOFT.fullmatch(word)
        if match is None:
            raise
        value = float("inf") if match[2].upper() == b"INF" else float("nan")
        return -value if match[1] == b"-" else value

"""Numbers out of text, many at a time.

In: the bytes of a file, and where the numbers stand. Out: arrays. Integers are read column by
column with NumPy; floats by Python's own conversion, which rounds correctly whatever the locale.
"""

from __future__ import annotations

import re
import warnings
from array import array

import numpy as np

# More digits than this cannot be an index of anything; the value stays at the limit.
_MAX_DIGITS = 18
OUT_OF_RANGE = 10**_MAX_DIGITS

# What the C runtime of old Microsoft compilers wrote for values that are not numbers.
_MICROSOFT = re.compile(rb"([+-]?)\d\.#(INF|IND|QNAN|SNAN|QNB)\d*", re.IGNORECASE)


def parse_integers(
    text: np.ndarray, starts: np.ndarray, ends: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Read integers with an optional sign.

    Parameters
    ----------
    text : (B,) uint8
    starts, ends : (N,) int64
        Where each number begins and ends.

    Returns
    -------
    values : (N,) int64
        0 for an empty range; plus or minus 10**18 for numbers of more than 18 digits.
    sound : (N,) bool
        False where something else than an integer stands.
    """
    last = len(text) - 1
    first = text[np.minimum(starts, last)]
    is_negative = first == ord("-")
    digits_start = starts + (is_negative | (first == ord("+"))) * (ends > starts)
    count = ends - digits_start
    sound = (count > 0) | (ends == starts)
    values = np.zeros(len(starts), np.int64)
    for column in range(min(int(count.max(initial=0)), _MAX_DIGITS)):
        inside = count > column
        digit = text[np.minimum(digits_start + column, last)] - np.uint8(ord("0"))
        sound &= ~inside | (digit <= 9)
        values = np.where(inside, values * 10 + digit, values)
    values[count > _MAX_DIGITS] = OUT_OF_RANGE
    return np.where(is_negative, -values, values), sound


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


def parse_floats(words: list[bytes]) -> np.ndarray:
    """Read floats: (N,) float64.

    Raises
    ------
    ValueError
        ``error.args[1]`` is the index of the first word that is not a number.
    """
    try:
        return np.array(list(map(float, words)), np.float64)
    except ValueError:
        pass
    values = np.empty(len(words), np.float64)
    index = 0
    try:
        for index, word in enumerate(words):
            values[index] = parse_float(word)
    except ValueError:
        raise ValueError("not a number", index) from None
    return values


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

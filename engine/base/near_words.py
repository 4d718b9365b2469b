"""What a misspelt word probably means: the end of an error's message.

In: a word, and the words that are known. Out: a suggestion, or nothing.
"""

from __future__ import annotations

from collections.abc import Iterable

#: Minimum similarity of two words, 0 to 1, for a letter-by-letter comparison.
_LIKENESS = 0.6
#: Fewer letters begin too many words to mean one.
_LEAST_BEGINNING = 3


def meant(word: str, known: Iterable[str]) -> str:
    """Return the end of a message that suggests a known word, or ``""``."""
    close = nearest(word, known)
    return "" if close is None else f": did you mean {close}?"


def nearest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that is nearest to a word, or begins with it; None if none is close."""
    from difflib import get_close_matches

    words = list(known)
    similar = get_close_matches(word, words, 3, _LIKENESS)
    begun = [one for one in words if len(word) >= _LEAST_BEGINNING and one.startswith(word)]
    close = [one for one in similar if one in begun or _is_close(word, one)]
    return next(iter(close), None) or min(begun, key=len, default=None)


def _is_close(word: str, known: str) -> bool:
    """Return whether two words share two thirds of their letters.

    Similarity alone would match ``nonsense`` with ``scene``: they share four letters of eight.
    """
    from difflib import SequenceMatcher

    blocks = SequenceMatcher(None, word, known).get_matching_blocks()
    shared = sum(block.size for block in blocks)
    return 3 * shared >= 2 * max(len(word), len(known))

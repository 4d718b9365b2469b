"""What a misspelt word probably means: the end of an error's message.

In: a word, and the words that are known. Out: a suggestion, or nothing.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable

#: Minimum similarity of two words, 0 to 1, for a letter-by-letter comparison.
_LIKENESS = 0.6


def meant(word: str, known: Iterable[str]) -> str:
    """Return the end of a message that suggests a known word, or ``""``."""
    similar = difflib.get_close_matches(word, list(known), 3, _LIKENESS)
    close = [one for one in similar if _is_close(word, one)]
    return f": did you mean {close[0]}?" if close else ""


def _is_close(word: str, known: str) -> bool:
    """Return whether a word is a prefix of a known one, or shares two thirds of its letters.

    Similarity alone would match ``nonsense`` with ``scene``: they share four letters of eight.
    """
    blocks = difflib.SequenceMatcher(None, word, known).get_matching_blocks()
    shared = sum(block.size for block in blocks)
    return known.startswith(word) or 3 * shared >= 2 * max(len(word), len(known))

"""Where lines of text may be broken: between words, but not before or within French signs.

In: a text. Out: the places, or the text with spaces that do not break in the other places.
"""

from __future__ import annotations

import re

NO_BREAK = "\N{NO-BREAK SPACE}"
#: What stands before or after a space where no line ends.
_KEPT = r"[:;?!%](?:\s|$)|»"
_UNBROKEN = re.compile(f"(?<=«) | (?={_KEPT})")
_BREAK = re.compile(f"(?<!«) (?!{_KEPT})")


def unbroken(text: str) -> str:
    """Return a text whose colons and their like stay with the word before them."""
    return _UNBROKEN.sub(NO_BREAK, text)


def last_break(line: str, end: int) -> int:
    """Return the last place up to ``end`` where a line may be broken.

    If there is none, it is the last space; 0 if there is none either.
    """
    places = (match.start() for match in _BREAK.finditer(line, 1))
    allowed = [place for place in places if place <= end]
    return allowed[-1] if allowed else max(line.rfind(" ", 1, end + 1), 0)

"""Captions of steps: a pattern, and the numbers that stand in it, in whichever language.

A field is ``{name}``, ``{name:.2f}`` as in a format, or ``{name:none|one|many}``: what stands for
0, for 1 and for more, with # for the number. A value that is a text is translated like a pattern.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from ...base.line_breaks import NO_BREAK, unbroken

_FIELD = re.compile(r"\{(\w+)(?::([^{}]*))?\}")
MINUS = "\N{MINUS SIGN}"


class Caption:
    """A caption before its language is chosen.

    Parameters
    ----------
    pattern : str
        The English one, by which a lesson's file finds the French one.
    **values : int, float or str
        Of its fields.
    """

    def __init__(self, pattern: str, **values: float | str) -> None:
        self.pattern, self.values = pattern, values

    def text(self, language: str = "en", words: Mapping[str, str] | None = None) -> str:
        """Return the text; ``words`` holds what patterns and texts are in this language."""
        known = words or {}

        def field(match: re.Match) -> str:
            value, form = self.values[match[1]], match[2] or ""
            if isinstance(value, str):
                return known.get(value, value)
            if "|" in form:
                none, one, many = form.split("|")
                chosen = none if value == 0 else one if value == 1 else many
                return chosen.replace("#", number(value, "", language))
            return number(value, form, language)

        text = _FIELD.sub(field, known.get(self.pattern, self.pattern))
        return unbroken(text) if language == "fr" else text

    def __str__(self) -> str:
        return self.text()


def fields(pattern: str) -> set[str]:
    """Return the names of a pattern's fields."""
    return {name for name, _ in _FIELD.findall(pattern)}


def number(value: float, form: str, language: str) -> str:
    """Return a number as a language writes it: 40,188.5 or 40 188,5; with a minus sign."""
    is_long = isinstance(value, int) and abs(value) >= 10_000
    text = format(value, form or ("," if is_long else ""))
    if language == "fr":
        text = text.replace(",", NO_BREAK).replace(".", ",")
    return text.replace("-", MINUS)

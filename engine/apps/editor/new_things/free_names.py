"""Names that nothing else has.

In: the names that are taken. Out: others: "box", then "box 2".
"""

from __future__ import annotations

from collections.abc import Iterable

#: Numbers of as many digits or more are part of the name.
_DIGITS = 7


class FreeNames:
    """Finds names.

    Parameters
    ----------
    taken : iterable of str
    """

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = set(taken) - {""}
        self._last: dict[str, int] = {}

    def free(self, name: str) -> str:
        """Return a name as it is, or with the next number if it is taken; "" stays."""
        if name in self._taken:
            name = self._numbered(name)
        if name:
            self._taken.add(name)
        return name

    def _numbered(self, name: str) -> str:
        stem, count = _parts(name)
        count = max(self._last.get(stem, 1), count) + 1
        while f"{stem} {count}" in self._taken:
            count += 1
        self._last[stem] = count
        return f"{stem} {count}"


def _parts(name: str) -> tuple[str, int]:
    """Return a name without its number, and the number; 1 if it has none."""
    stem, _, number = name.rpartition(" ")
    is_number = number.isascii() and number.isdigit() and len(number) < _DIGITS
    return (stem, int(number)) if stem and is_number else (name, 1)

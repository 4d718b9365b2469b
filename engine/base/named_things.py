"""Things by name, of which a misspelt one is an error that suggests the nearest.

In: names and things. Out: a dict, whose errors are also those of any other dict.
"""

from __future__ import annotations

from typing import NoReturn, TypeVar

from ..errors import InvalidArgumentError
from .near_words import meant
from .numbers import shown

_MOST_NAMES = 40
Thing = TypeVar("Thing")


class _UnknownNameError(InvalidArgumentError, KeyError):
    """No such name: also a KeyError, which mappings promise."""

    __str__ = Exception.__str__  # a KeyError quotes its message


class NamedThings(dict[str, Thing]):
    """Things by their names; ``what`` says what they are, such as ``"joint"``."""

    def __init__(self, what: str) -> None:
        super().__init__()
        self.what = what

    def __missing__(self, name: object) -> NoReturn:
        hint = meant(name, self) if isinstance(name, str) else ""
        known = ", ".join(list(self)[:_MOST_NAMES]) + (", …" if len(self) > _MOST_NAMES else "")
        raise _UnknownNameError(
            f"there is no {self.what} {shown(name)}{hint} (there are: {known or 'none'})"
        )

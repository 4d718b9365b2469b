"""Task matrices: all combinations of some values.

In: values for each key, each with a text for names. Out: the combinations, with the last key's
values changing fastest; names from a pattern such as ``{model}_{seed:04}``.
"""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from ...errors import InvalidArgumentError

_PLACE = re.compile(r"\{(\w*)(?::0?(\d{1,2}))?\}")
_UNFIT = re.compile(r"[^\w.+@=,-]+")


class Value(NamedTuple):
    """One of a key's values.

    Attributes
    ----------
    value : object
    text : str
        What stands for it in names.
    """

    value: Any
    text: str


def value_of(key: str, value: Any, number: int) -> Value:
    """Return a value with its text: a file's name, a number, its own name, or its index.

    Parameters
    ----------
    key : str
    value : object
        As the task takes it.
    number : int
        Its place among the key's values.
    """
    text = str(number)
    if key in ("model", "script") and value is not None:
        text = os.path.splitext(os.path.basename(value))[0]
    elif isinstance(value, Mapping) and isinstance(value.get("name"), str):
        text = value["name"]
    elif isinstance(value, (int, str)) and not isinstance(value, bool):
        text = str(value)
    elif isinstance(value, Sequence) and all(type(part) is int for part in value):
        text = "x".join(map(str, value))
    return Value(value, _UNFIT.sub("-", text).strip("-.") or str(number))


def combinations(lists: Mapping[str, Sequence[Value]]) -> Iterator[dict[str, Value]]:
    """Yield all combinations of one value for each key."""
    for chosen in itertools.product(*lists.values()):
        yield dict(zip(lists, chosen, strict=True))


def name_from(pattern: str, texts: Mapping[str, str]) -> str:
    """Return a name; ``{key}`` is replaced by a text, ``{key:04}`` by one of four digits.

    Raises
    ------
    InvalidArgumentError
        No such key is known.
    """

    def filled(match: re.Match) -> str:
        key, width = match[1], int(match[2] or 0)
        if key not in texts:
            raise InvalidArgumentError(
                f"{match[0]} stands for nothing: known are {', '.join(texts)}"
            )
        return texts[key].zfill(width) if width else texts[key]

    return _PLACE.sub(filled, pattern)

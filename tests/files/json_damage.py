"""Valid JSON of another shape, and texts that are hardly JSON: what stands in damaged files.

In: a `random.Random` and a value. Out: the bytes of a file. Most are valid JSON in which something
is another thing, is missing, is there twice or stands elsewhere.
"""

from __future__ import annotations

import copy
import json
import random
from typing import Any

DEPTH = 100_000
#: What stands in the place of anything.
ODD = (
    None, True, False, 0, 1, -1, 3, 2**31, -(2**63), 2**64, 10**300, 0.5, -0.0, 1e308, -1e308,
    float("nan"), float("inf"), "", "x", "a\0b", "\ud800", "\u202e\x1b[31m", "../../x", "/", "0",
    "x" * 5000, [], {}, [[]], [{}], {"": {}}, {"x": 1}, [1, 2, 3], [None], ["x"], [[[[[[0]]]]]],
)  # fmt: skip
#: Whole files.
TEXTS = (
    b"", b" ", b"[]", b"{}", b"1", b"-0", b"null", b"true", b'"x"', b"[[]]", b"[{}]", b"[null]",
    b"NaN", b"-Infinity", b"1e999", b"[1e999]", b"9" * 5000, b"[" * DEPTH, b'{"a":' * DEPTH,
    b"[" * 900 + b"]" * 900, b'{"a":' * 900 + b"1" + b"}" * 900, b'{"a":1,"a":2}',
    b"\xff\xfe[\0]\0",
    b"\xef\xbb\xbf[]", b"\xef\xbb\xbf{}", b'"\xe9"', b"{\x00}", b"\x00" * 64, b"[1,]",
    b"{'a': 1}", b"[" + b"0," * 100_000 + b"0]", b'{"a"', b"[1] [2]", b'"\\ud800"',
)  # fmt: skip


def damaged(value: Any, choice: random.Random) -> bytes:
    """Return the bytes of a file that should hold ``value``."""
    if choice.random() < 0.1:
        return choice.choice(TEXTS)
    for _ in range(choice.choice((1, 1, 1, 2, 4))):
        value = _changed(value, choice)
    text = json.dumps(value)
    kind = choice.random()
    if kind < 0.03:
        text = text[: choice.randrange(len(text) + 1)]
    elif kind < 0.06:
        return text.encode(choice.choice(("utf-16", "utf-32", "utf-8-sig", "utf-16-le")))
    elif kind < 0.09 and text.startswith("{") and text != "{}":
        text = f'{{"{choice.choice(list(value) or [""])}": 0, {text[1:]}'.replace("\0", "")
    elif kind < 0.11:
        place = choice.randrange(len(text) + 1)
        text = text[:place] + choice.choice(("[" * DEPTH, "1" * 5000, "1e999")) + text[place:]
    return text.encode("utf-8", "surrogatepass")


def _changed(value: Any, choice: random.Random) -> Any:
    """Return a value one place of which is changed."""
    value = copy.deepcopy(value)
    places = list(_places(value))
    if not places or choice.random() < 0.05:
        return copy.deepcopy(choice.choice(ODD))
    holder, key = choice.choice(places)
    kind = choice.random()
    if kind < 0.6:
        holder[key] = copy.deepcopy(choice.choice(ODD))
    elif kind < 0.75:
        del holder[key]
    elif kind < 0.85:
        holder[key] = choice.choice(([holder[key]], {"x": holder[key]}))
    elif kind < 0.93:
        other, there = choice.choice(places)
        if isinstance(other, dict) and there in other or isinstance(other, list):
            held = other[there] if there in other or isinstance(other, list) else None
            holder[key] = copy.deepcopy(held)
    elif isinstance(holder, list):
        holder[key:key] = [copy.deepcopy(holder[key])] * choice.choice((1, 2, 100))
    else:
        holder[choice.choice(("x", "", "name", "1"))] = copy.deepcopy(choice.choice(ODD))
    return value


def _places(value: Any):
    """Yield (what holds it, key) of all that a value holds."""
    entries = value.items() if isinstance(value, dict) else ()
    if isinstance(value, list):
        entries = list(enumerate(value[:50]))
    for key, held in entries:
        yield value, key
        yield from _places(held)

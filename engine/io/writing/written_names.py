"""Encoding of names and text for model files.

In: text; a name may come from a path that is not UTF-8, or from JSON with unpaired surrogates. Out:
UTF-8, with such surrogates escaped as in Python; and names that fit one line of a file, with a
record of those that changed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable

# This many changed names are listed.
_MOST_TOLD = 5


def encoded(text: str) -> bytes:
    """Return any text as UTF-8."""
    return text.encode("utf-8", "backslashreplace")


def line_text(text: str) -> str:
    """Return a text that can be read back from a line of an OBJ, MTL or STL file.

    Line ends and runs of blanks become a blank; control characters, comment signs at the start and
    a backslash that would join the next line become ``_``.
    """
    text = re.sub(r"[\0-\x1f\x7f]", "_", " ".join(text.split()))
    text = re.sub(r"(^|\s)#", r"\1_", text)
    text = text[:-1] + "_" if text.endswith("\\") else text
    return encoded(text).decode()


def unique(names: Iterable[str]) -> list[str]:
    """Return the names made distinct, by numbers appended to repeated ones."""
    copies: dict[str, int] = {}  # for each used name, the last appended number
    result: list[str] = []
    for name in names:
        candidate = name
        while candidate in copies:
            copies[name] += 1
            candidate = f"{name}_{copies[name]}"
        copies[candidate] = 1
        result.append(candidate)
    return result


def renamed(kind: str, old: Iterable[str], new: Iterable[str]) -> list[str]:
    """Return a line that lists the names changed in the file, if any."""
    changes = [f"{a!r} is {b!r}" for a, b in zip(old, new, strict=True) if a not in ("", b)]
    if not changes:
        return []
    rest = len(changes) - _MOST_TOLD
    more = f" and {rest} more" if rest > 0 else ""
    return [f"{kind} that the format cannot name so: {', '.join(changes[:_MOST_TOLD])}{more}"]


def linkable_stem(path: str) -> str:
    """Return a name for side files that the model's text can refer to.

    It is the model's own name if readers can find such a file: names that look like absolute paths
    or options, contain several blanks in a row, or use another encoding are replaced.
    """
    stem = os.path.splitext(os.path.basename(path))[0]
    stem = "".join(c if c.isprintable() and c not in '\\"#' else "_" for c in stem)
    stem = re.sub(r"^[-~ ]|(?<=^[A-Za-z]):| (?= )| $", "_", stem)
    # With a number and an extension appended, file systems must still accept the name.
    return stem.encode()[:200].decode(errors="ignore") or "model"

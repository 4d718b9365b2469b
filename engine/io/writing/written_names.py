"""Text with names in it, as model files hold it.

In: text; a name may come from a path that is no UTF-8, or from JSON, with halves of surrogate
pairs that no encoding has. Out: UTF-8, those halves as Python escapes them; and names that one line
of a file can hold, with a record of those that had to change.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable

# So many changed names are reported one by one.
_MOST_TOLD = 5


def encoded(text: str) -> bytes:
    """Return text as UTF-8, whatever is in it."""
    return text.encode("utf-8", "backslashreplace")


def line_text(text: str) -> str:
    """Return text that reads back from a line of an OBJ, MTL or STL file.

    Line ends and runs of blanks become a blank; control characters, what would begin a comment and
    a backslash that would join the next line become ``_``.
    """
    text = re.sub(r"[\0-\x1f\x7f]", "_", " ".join(text.split()))
    text = re.sub(r"(^|\s)#", r"\1_", text)
    text = text[:-1] + "_" if text.endswith("\\") else text
    return encoded(text).decode()


def unique(names: Iterable[str]) -> list[str]:
    """Return the names, all different: numbers are put behind those that are taken."""
    copies: dict[str, int] = {}  # of each name that is taken, the last number behind it
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
    """Return a line that tells which names are others in the file, if any are."""
    changes = [f"{a!r} is {b!r}" for a, b in zip(old, new, strict=True) if a not in ("", b)]
    if not changes:
        return []
    rest = len(changes) - _MOST_TOLD
    more = f" and {rest} more" if rest > 0 else ""
    return [f"{kind} that the format cannot name so: {', '.join(changes[:_MOST_TOLD])}{more}"]


def linkable_stem(path: str) -> str:
    """Return a name for the files beside a model that the model's text can point to.

    It is that of the model where readers find such a file: not as an absolute path, an option, two
    words with several blanks between them, or a name in another encoding.
    """
    stem = os.path.splitext(os.path.basename(path))[0]
    stem = "".join(c if c.isprintable() and c not in '\\"#' else "_" for c in stem)
    stem = re.sub(r"^[-~ ]|(?<=^[A-Za-z]):| (?= )| $", "_", stem)
    # With a number and an extension behind it, still a name that file systems take.
    return stem.encode()[:200].decode(errors="ignore") or "model"

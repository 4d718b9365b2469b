"""The ways in which a file that is meant may be spelt.

In: a name as it stands in a file, from any system. Out: the spellings to look for on this one, and
the ends of a path that another machine had. Nothing here looks at a disk.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterator
from urllib.parse import unquote

# Encodings of names that are no UTF-8, besides Latin-1, in which they are told: of Japanese,
# Chinese, Korean, Western, Russian and Central European Windows, of Macs, and of archives that
# were unpacked as if they were of DOS. A name counts only if there is such a file.
_ENCODINGS = (
    *("cp932", "gb18030", "big5hkscs", "cp949", "euc_jp", "cp1252", "cp1251", "cp1250"),
    *("mac_roman", "cp437", "cp850"),
)
_FILE_URL = re.compile(r"file:(?://(?:localhost(?=/))?)?", re.IGNORECASE)
_DRIVE = re.compile(r"[A-Za-z]:")
# So many last parts of a long path are looked for.
_MOST_PARTS = 8


def is_absolute(name: str) -> bool:
    """Whether a name, as `spellings` gives it, is a path from the root of some system."""
    return name.startswith(("/", "~")) or _DRIVE.match(name) is not None


def spellings(name: str) -> Iterator[str]:
    """Yield what a name may be on this disk, with slashes; the likeliest first."""
    name = name.strip(" \t\r\n\v\f").strip('"')
    plain = _plain(name)
    yield plain
    if "%" in name and (decoded := _plain(unquote(name))) != plain:
        yield decoded
    if not name.isascii():
        for text in _in_other_encodings(name):
            yield _plain(text)


def ends(name: str) -> Iterator[str]:
    """Yield the last parts of a path, as many as are looked for, then ever fewer of them."""
    seen = set()
    for spelling in spellings(name):
        parts = [part for part in spelling.split("/") if part not in ("", ".", "..")]
        for first in range(max(len(parts) - _MOST_PARTS, 0), len(parts)):
            end = _DRIVE.sub("", "/".join(parts[first:]), count=1)
            if end and end not in seen:
                seen.add(end)
                yield end


def match_key(name: str) -> str:
    """Return what names have in common that differ by letter case or by composed letters alone."""
    folded = name.casefold()
    return folded if folded.isascii() else unicodedata.normalize("NFC", folded)


def _plain(name: str) -> str:
    """A name without the marks of a URL of a file, with slashes."""
    url = _FILE_URL.match(name)
    if url is not None:
        name = unquote(name[url.end() :])
        if _DRIVE.match(name[1:]):
            name = name[1:]
    return name.replace("\\", "/")


def _in_other_encodings(name: str) -> Iterator[str]:
    """Return what a name may have meant that isn't UTF-8 and was read as Latin-1."""
    try:
        letters = name.encode("latin-1")
    except UnicodeEncodeError:
        return
    yield os.fsdecode(letters)
    for encoding in _ENCODINGS:
        try:
            text = letters.decode(encoding)
        except UnicodeDecodeError:
            continue
        if text != name:
            yield text

"""Possible spellings of the name of a linked file.

In: a name in a file, from any system. Out: the spellings to search for on this system, and the
trailing parts of a path from another machine. This module does not access the disk.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from ...base.system import decoded_name

# Encodings of names that are not UTF-8, besides Latin-1, which is the fallback: of Japanese,
# Chinese, Korean, Western, Russian and Central European Windows, of Macs, and of archives unpacked
# as if they came from DOS. A decoded name counts only if such a file exists.
_ENCODINGS = (
    *("cp932", "gb18030", "big5hkscs", "cp949", "euc_jp", "cp1252", "cp1251", "cp1250"),
    *("mac_roman", "cp437", "cp850"),
)
_FILE_URL = re.compile(r"file:(?://(?:localhost(?=/))?)?", re.IGNORECASE)
_DRIVE = re.compile(r"[A-Za-z]:")
# This many trailing parts of a long path are searched.
_MOST_PARTS = 8


def is_absolute(name: str) -> bool:
    """Return whether a name from `spellings` is an absolute path of some system."""
    return name.startswith(("/", "~")) or _DRIVE.match(name) is not None


def spellings(name: str) -> Iterator[str]:
    """Yield possible spellings of a name on this disk, with slashes, most likely first."""
    name = name.strip(" \t\r\n\v\f").strip('"')
    plain = _plain(name)
    yield plain
    if "%" in name and (decoded := _plain(_unquoted(name))) != plain:
        yield decoded
    if not name.isascii():
        for text in _in_other_encodings(name):
            yield _plain(text)


def ends(name: str) -> Iterator[str]:
    """Yield trailing parts of a path, from the longest to the shortest."""
    seen = set()
    for spelling in spellings(name):
        parts = [part for part in spelling.split("/") if part not in ("", ".", "..")]
        for first in range(max(len(parts) - _MOST_PARTS, 0), len(parts)):
            end = _DRIVE.sub("", "/".join(parts[first:]), count=1)
            if end and end not in seen:
                seen.add(end)
                yield end


def match_key(name: str) -> str:
    """Return a key that ignores letter case and Unicode composition."""
    folded = name.casefold()
    return folded if folded.isascii() else unicodedata.normalize("NFC", folded)


def _unquoted(name: str) -> str:
    """Return a name without percent signs that stand for other characters."""
    from urllib.parse import unquote  # here, because it takes milliseconds

    return unquote(name)


def _plain(name: str) -> str:
    """Return a name without a file URL's prefix and suffix, with slashes."""
    url = _FILE_URL.match(name)
    if url is not None:
        name = _unquoted(name[url.end() :])
        if _DRIVE.match(name[1:]):
            name = name[1:]
    return name.replace("\\", "/")


def _in_other_encodings(name: str) -> Iterator[str]:
    """Return the possible meanings of a non-UTF-8 name that was decoded as Latin-1."""
    try:
        letters = name.encode("latin-1")
    except UnicodeEncodeError:
        return
    yield decoded_name(letters)
    for encoding in _ENCODINGS:
        try:
            text = letters.decode(encoding)
        except UnicodeDecodeError:
            continue
        if text != name:
            yield text

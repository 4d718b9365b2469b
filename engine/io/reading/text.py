"""Normalises text files: any line ends, byte-order marks, any encoding of names.

In: the bytes of a file. Out: bytes of an ASCII superset whose lines end in LF, without a byte-order
mark. Line numbers do not change.
"""

from __future__ import annotations

import codecs
import re

from ...errors import FileFormatError
from .sources import Source

_SHOWN = 40
_BLANKS = re.compile(r"[ \t\r\n\v\f]+")


def text_lines(source: Source) -> bytes:
    """Return a file's text with LF line ends; never empty, and the last line is ended too.

    Raises
    ------
    FileFormatError
        The content is binary, or damaged UTF-16.
    """
    data = checked_text(source)
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data if data.endswith(b"\n") else data + b"\n"


def checked_text(source: Source) -> bytes:
    """Return the bytes of a text without a byte-order mark; line ends are unchanged.

    Raises
    ------
    FileFormatError
        The content is binary, or damaged UTF-16.
    """
    data = source.data
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        try:
            data = data.decode("utf-16").encode("utf-8")
        except UnicodeError:
            raise FileFormatError("damaged UTF-16 text", source.path) from None
    elif data.startswith(codecs.BOM_UTF8):
        data = data[len(codecs.BOM_UTF8) :]
    if b"\0" in data:
        raise FileFormatError(f"not a text file (zero byte at offset {data.index(0)})", source.path)
    return data


def decoded(name: bytes) -> str:
    """Return a name as text: UTF-8, or else Latin-1."""
    try:
        return name.decode("utf-8")
    except UnicodeDecodeError:
        return name.decode("latin-1")


def words_of(text: str) -> list[str]:
    """Return the words of a decoded text, split at ASCII blanks only.

    Names in other encodings contain bytes that Python treats as blanks.
    """
    return [word for word in _BLANKS.split(text) if word]


def shown(text: str | bytes) -> str:
    """Return a quoted excerpt of a file for a one-line message."""
    if isinstance(text, bytes):
        text = decoded(text)
    return repr(text if len(text) <= _SHOWN else text[:_SHOWN] + "...")

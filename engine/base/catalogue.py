"""A catalogue of translated texts, read from gettext's PO format.

In: the text of a ``.po`` file. Out: translations by the English text, with the plural that a number
takes. Fuzzy entries and those without a translation are left out, as gettext does.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from gettext import c2py
from typing import NamedTuple

from ..errors import FileFormatError

_LINE = re.compile(
    r'(?:(?P<word>msgctxt|msgid|msgid_plural|msgstr|msgstr\[\d\])\s+)?"(?P<text>(?:[^"\\]|\\.)*)"'
)
_ESCAPED = re.compile(r"\\(.)")
_CHARACTERS = {"n": "\n", "t": "\t", '"': '"', "\\": "\\"}
_STARTS = ("msgctxt", "msgid")
_KEYS = (*_STARTS, "msgid_plural")
#: The rule of English, for catalogues that tell none.
_USUAL_PLURALS = "nplurals=2; plural=(n != 1);"


class Entry(NamedTuple):
    """A text and its translations.

    Attributes
    ----------
    line : int
        Where it begins.
    context : str
        What tells equal texts apart; usually empty.
    text, plural : str
        In English, for one thing and for several; the plural is empty if nothing is counted.
    translations : tuple of str
        One, or one for each plural of the language.
    """

    line: int
    context: str
    text: str
    plural: str
    translations: tuple[str, ...]


class Catalogue:
    """Translations into one language.

    Parameters
    ----------
    text : str
        Of a PO file. Its header may tell ``Plural-Forms``, ``X-Thousands-Mark`` and
        ``X-Decimal-Mark``.
    path : str
        Names the file in errors.

    Raises
    ------
    FileFormatError
        It is not such a file, an entry stands there twice, or plurals are missing.
    """

    def __init__(self, text: str, path: str) -> None:
        entries = read_entries(text, path)
        head = _head_of(entries)
        count, self._plural_of = _plurals(head.get("Plural-Forms", _USUAL_PLURALS), path)
        #: What commas and points in English numbers become, for `str.translate`.
        self.number_marks = str.maketrans(
            {",": head.get("X-Thousands-Mark", ","), ".": head.get("X-Decimal-Mark", ".")}
        )
        self._translations: dict[tuple[str, str], tuple[str, ...]] = {}
        for entry in filter(lambda entry: entry.text, entries):
            if entry.plural and len(entry.translations) != count:
                raise FileFormatError(f"{count} plurals are needed", path, entry.line)
            if (entry.context, entry.text) in self._translations:
                raise FileFormatError(f"{entry.text!r} is there already", path, entry.line)
            self._translations[entry.context, entry.text] = entry.translations

    def text(self, text: str, context: str = "") -> str:
        """Return the translation of a text; the text itself if there is none."""
        return self._translations.get((context, text), (text,))[0]

    def counted(self, one: str, many: str, count: int) -> str:
        """Return the translation of a text for a number of things."""
        forms = self._translations.get(("", one))
        if forms is None:
            return one if count == 1 else many
        return forms[self._plural_of(count)] if len(forms) > 1 else forms[0]


def read_entries(content: str, path: str) -> list[Entry]:
    """Return the translated entries of a PO file; that with the text "" is the header.

    Raises
    ------
    FileFormatError
    """
    entries: list[Entry] = []
    fields: dict[str, str] = {}
    start, word, is_fuzzy, comes_fuzzy = 1, "", False, False

    def finish() -> None:
        translations = tuple(value for name, value in fields.items() if name.startswith("msgstr"))
        if translations and all(translations) and not is_fuzzy:
            context, text, plural = (fields.get(name, "") for name in _KEYS)
            entries.append(Entry(start, context, text, plural, translations))

    for number, line in enumerate(content.splitlines(), 1):
        if line.startswith("#,"):
            comes_fuzzy |= "fuzzy" in line
        if not line.strip() or line.startswith("#"):
            continue
        match = _LINE.fullmatch(line.strip())
        if match is None or not (match["word"] or word):
            raise FileFormatError("not a line of a PO file", path, number)
        word = match["word"] or word
        if match["word"] in _STARTS and any(name.startswith("msgstr") for name in fields):
            finish()
            fields = {}
        if not fields:
            start, is_fuzzy, comes_fuzzy = number, comes_fuzzy, False
        if match["word"] in fields:
            raise FileFormatError(f"a second {word}", path, number)
        fields[word] = fields.get(word, "") + _ESCAPED.sub(_unescaped, match["text"])
    finish()
    return entries


def _unescaped(match: re.Match[str]) -> str:
    return _CHARACTERS.get(match[1], match[0])


def _head_of(entries: list[Entry]) -> dict[str, str]:
    """Return the header's lines by name."""
    text = next((entry.translations[0] for entry in entries if not entry.text), "")
    pairs = (line.partition(":") for line in text.splitlines())
    # A mark may be a space, which no-break spaces are to Python.
    return {name: value.removeprefix(" ") for name, _, value in pairs}


def _plurals(rule: str, path: str) -> tuple[int, Callable[[int], int]]:
    """Return how many plurals a language has, and the function that chooses one."""
    match = re.fullmatch(r"\s*nplurals\s*=\s*(\d+)\s*;\s*plural\s*=\s*([^;]+);?\s*", rule)
    if match is None:
        raise FileFormatError(f"Plural-Forms: {rule!r} is no rule", path)
    try:
        return int(match[1]), c2py(match[2])
    except ValueError as error:
        raise FileFormatError(f"Plural-Forms: {error}", path) from None

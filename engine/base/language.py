"""The language of the texts in windows: chosen for a time, English outside of it.

In: a language, and texts in English, which are the keys of its catalogue. Out: the texts in that
language; those that the catalogue lacks stay English. A window chooses its language while it is
open, so that pictures of the library never depend on the locale.
"""

from __future__ import annotations

import contextlib
import functools
import os
import re
import string
from collections.abc import Iterator, Mapping
from numbers import Real
from typing import TYPE_CHECKING, Any, cast

from ..errors import InvalidArgumentError
from .catalogue import Catalogue
from .command_key import with_command_key
from .system_languages import system_languages

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

ENGLISH = "en"
_ENDING = ".po"
#: Names of the variables that tell the locale of messages, the first one counts.
_LOCALE = ("LC_ALL", "LC_MESSAGES", "LANG")
_NO_LOCALE = ("", "C", "POSIX")  # also with an encoding, such as ".UTF-8"
_KEY = "key"

_chosen: Catalogue | None = None


def languages() -> tuple[str, ...]:
    """Return the languages that texts can have: English, and those with a catalogue."""
    names = (entry.name for entry in _folder().iterdir())
    return ENGLISH, *sorted(name.removesuffix(_ENDING) for name in names if name.endswith(_ENDING))


def usual_language(environment: Mapping[str, str] = os.environ) -> str:
    """Return the language of a locale, or of the system's settings where no variable names one.

    It is English if there is no catalogue for it.
    """
    locale = next(filter(None, (environment.get(name, "") for name in _LOCALE)), "")
    told = [locale] if locale else system_languages()
    if not told or told[0].partition(".")[0] in _NO_LOCALE:
        return ENGLISH
    # LANGUAGE is a list, and comes before the locale.
    wanted = environment["LANGUAGE"].split(":") if environment.get("LANGUAGE") else told
    known = languages()
    names = (re.split("[_.@-]", name)[0] for name in wanted)
    return next((name for name in names if name in known), ENGLISH)


@contextlib.contextmanager
def speaking(language: str) -> Iterator[None]:
    """Translate texts into a language within the block.

    Raises
    ------
    InvalidArgumentError
        There is no catalogue for the language.
    """
    global _chosen
    before = _chosen
    _chosen = None if language == ENGLISH else read_catalogue(language)
    try:
        yield
    finally:
        _chosen = before


@functools.cache
def read_catalogue(language: str) -> Catalogue:
    """Return the catalogue of a language.

    Raises
    ------
    InvalidArgumentError
        There is none.
    FileFormatError
    """
    if language not in languages()[1:]:
        known = ", ".join(languages())
        raise InvalidArgumentError(f"language must be one of {known}, not {language!r}")
    path = _folder() / f"{language}{_ENDING}"
    return Catalogue(path.read_text(encoding="utf-8"), str(path))


def _folder() -> Traversable:
    from importlib.resources import files

    return files("engine3d.data") / "languages"


def translated(text: str, /, **values: Any) -> str:
    """Return a text in the chosen language.

    Parameters
    ----------
    text : str
        In English; with values, a template such as ``"saved {name}"``.
    **values
        What the template's fields become, by `str.format`; numbers get the language's marks.
    """
    template = text if _chosen is None else _chosen.text(text)
    return _FILLER.vformat(template, (), values) if values else template


def translated_choice(option: str, value: str, /) -> str:
    """Return a value of an option, such as "front" of "cull", in the chosen language.

    Parameters
    ----------
    option : str
        The context of the value in the catalogue: "none" has many translations.
    value : str
        In English.
    """
    return value if _chosen is None else _chosen.text(value, option)


def translated_count(one: str, many: str, count: int, /, **values: Any) -> str:
    """Return a text for a number of things in the chosen language.

    Parameters
    ----------
    one, many : str
        Templates in English, for one thing and for several: ``"{count} part"``,
        ``"{count} parts"``.
    count : int
        Also the value of ``{count}``.
    **values
        As for `translated`.
    """
    if _chosen is None:
        template = one if count == 1 else many
    else:
        template = _chosen.counted(one, many, count)
    return _FILLER.vformat(template, (), values | {"count": count})


def translated_number(number: float, spec: str = "", /) -> str:
    """Return a number, written by a format such as ``",d"``, with the marks of the language."""
    text = format(number, spec)
    return text if _chosen is None else text.translate(_chosen.number_marks)


def translated_keys(keys: str) -> str:
    """Return keys such as ``"Ctrl+Shift+Z"`` by the names on keyboards of the chosen language."""
    keys = with_command_key(keys)
    if _chosen is None:
        return keys
    # The last one may be the plus itself.
    *modifiers, key = keys[:-1].split("+") if len(keys) > 1 else [""]
    names = [*modifiers, key + keys[-1:]]
    return "+".join(_chosen.text(name, _KEY) for name in names)


class _Filler(string.Formatter):
    """Fills templates, and writes numbers with the marks of the chosen language."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if isinstance(value, Real):
            return translated_number(cast(float, value), format_spec)
        return format(value, format_spec)


_FILLER = _Filler()

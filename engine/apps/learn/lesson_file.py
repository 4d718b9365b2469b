"""Reads the files of lessons: all texts of a lesson in both languages, in one place.

In: `NN_name.md` beside a lesson's program: sections that begin with ``## name`` or
``## name language``. Out: a `LessonFile`. The window, the terminal, HTML and the pages of
docs/course show what it holds.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

LANGUAGES = ("en", "fr")
_SECTION = re.compile(r"^## ([a-z]+)(?: (en|fr))?\n", re.M)
_FENCE = re.compile(r"```python\n(.*?)```", re.S)
# The numbers of Fowler, Noll and Vo's hash of 32 bits (FNV-1a).
_OFFSET, _PRIME = 2166136261, 16777619
_THOUSANDS = re.compile(r"-?[1-9]\d{0,2}(,\d{3})+(\.\d+)?")


@dataclass(frozen=True)
class Parameter:
    """What a pupil may change of a lesson.

    Attributes
    ----------
    name : str
        Of the keyword argument of the lesson's `steps`.
    values : tuple of int, float or str
        In the order in which the keys go through them.
    labels : dict
        What it is called, by language.
    """

    name: str
    values: tuple[float | str, ...]
    labels: Mapping[str, str]


@dataclass(frozen=True)
class LessonFile:
    """The texts of a lesson.

    Attributes
    ----------
    name : str
        Such as ``"03_lines"``.
    texts : dict
        Sections by name and language, such as ``("idea", "fr")``.
    code : tuple of str
        The lines of a program that runs by itself.
    captions : dict
        French patterns by the English ones.
    marked : dict
        Which lines of `code` a step explains, from 0, by the English pattern of its caption.
    parameters : tuple of Parameter
    check : int
        Hash of the exercise's answer: see `hash_of`.
    """

    name: str
    texts: Mapping[tuple[str, str], str]
    code: tuple[str, ...]
    captions: Mapping[str, str]
    marked: Mapping[str, range]
    parameters: tuple[Parameter, ...]
    check: int

    @property
    def number(self) -> int:
        """From 1."""
        return int(self.name[:2])

    def title(self, language: str) -> str:
        """Return its number and title."""
        return f"{self.number}. {self.texts['title', language]}"

    def words(self, language: str) -> Mapping[str, str]:
        """Return what captions and words are in a language, by the English ones."""
        return self.captions if language == "fr" else {}

    def is_right(self, answer: str) -> bool:
        """Whether an answer, as it was typed, is that of the exercise."""
        plain = plain_answer(answer)
        return plain is not None and hash_of(self.name, plain) == self.check


def read_lesson(path: Path) -> LessonFile:
    """Read the file of a lesson.

    Raises
    ------
    ValueError
        A section is missing, or is not written as it should be.
    """
    parts = _SECTION.split(path.read_text(encoding="utf-8"))
    names = zip(parts[1::3], parts[2::3], parts[3::3], strict=True)
    sections = {(name, language or ""): text.strip("\n") for name, language, text in names}
    try:
        code = _FENCE.search(sections["code", ""])
        rows = _rows(sections["steps", ""])
        return LessonFile(
            path.stem,
            sections,
            tuple(code[1].splitlines()) if code else (),
            {row["en"]: row["fr"] for row in rows},
            {row["en"]: _lines(row["code"]) for row in rows if "code" in row},
            tuple(map(_parameter, _rows(sections.get(("parameters", ""), "")))),
            int(sections["check", ""], 16),
        )
    except KeyError as error:
        raise ValueError(f"{path.name}: {error} is missing") from error


def _rows(text: str) -> list[dict[str, str]]:
    """Return paragraphs of lines ``key: value``."""
    paragraphs = [part.splitlines() for part in text.split("\n\n") if part.strip()]
    return [dict(line.split(": ", 1) for line in lines if line) for lines in paragraphs]


def _lines(words: str) -> range:
    """Return lines such as 4-6 or 4, counted from 1, as indices."""
    first, _, last = words.partition("-")
    return range(int(first) - 1, int(last or first))


def _parameter(row: dict[str, str]) -> Parameter:
    labels = {language: row[language] for language in LANGUAGES}
    return Parameter(row["name"], tuple(map(_value, row["values"].split())), labels)


def _value(word: str) -> float | str:
    try:
        return ast.literal_eval(word)
    except (SyntaxError, ValueError):
        return word


def plain_answer(answer: str) -> str | None:
    """Return a typed number in the one way in which it is checked; None if it is none.

    A decimal point may be a comma, and commas may part thousands; the page of HTML does the same.
    """
    plain = answer.strip()
    if _THOUSANDS.fullmatch(plain):
        plain = plain.replace(",", "")
    try:
        number = float(plain.replace(",", "."))
    except ValueError:
        return None
    return str(int(number)) if number.is_integer() else f"{number:g}"


def hash_of(name: str, answer: str) -> int:
    """Return the hash by which an answer is known without being told: FNV-1a, 32 bits."""
    value = _OFFSET
    for byte in f"{name}:{answer}".encode():
        value = (value ^ byte) * _PRIME % 2**32
    return value

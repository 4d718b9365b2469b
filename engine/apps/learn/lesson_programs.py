"""Runs the programs of lessons: which there are, and the steps of one with its parameters.

The programs are those of `engine3d.lessons`, installed as data. They run as scripts and import each
other, so their folder is on the import path.
"""

from __future__ import annotations

import importlib
import inspect
import runpy
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from types import ModuleType

import numpy as np

from .captions import Caption
from .lesson_file import LessonFile, read_lesson


@dataclass(frozen=True)
class Listing:
    """Lines of text that a step shows in place of a picture."""

    lines: tuple[str, ...]


@dataclass(frozen=True)
class Step:
    """What a lesson shows at once.

    Attributes
    ----------
    caption : str
        In the pupil's language.
    shown : tuple of ndarray or Listing
        Pictures are (H, W, 3) uint8, side by side.
    marked : range
        The lines of the lesson's code that it explains, from 0.
    """

    caption: str
    shown: tuple[np.ndarray | Listing, ...]
    marked: range


def find_programs() -> list[Path]:
    """Return the programs of the lessons, in order."""
    folder = Path(str(files("engine3d.lessons")))
    return sorted(folder.glob("[0-9][0-9]_*.py"))


@cache
def texts_of(program: Path) -> LessonFile:
    """Return the texts of a lesson."""
    return read_lesson(program.with_suffix(".md"))


def shared_by_lessons(program: Path) -> ModuleType:
    """Return the module that the lessons share, from their folder."""
    if str(program.parent) not in sys.path:
        sys.path.insert(0, str(program.parent))
    return importlib.import_module("lesson")


@cache
def steps_function(program: Path) -> Callable:
    """Return the function of a lesson's program that yields its steps."""
    shared_by_lessons(program)
    return runpy.run_path(str(program))["steps"]


def first_values(program: Path) -> dict[str, float | str]:
    """Return the values of a lesson's parameters that hold if nobody changes them."""
    defaults = inspect.signature(steps_function(program)).parameters
    return {one.name: defaults[one.name].default for one in texts_of(program).parameters}


def steps_of(
    program: Path, language: str, values: Mapping[str, float | str] | None = None
) -> Iterator[Step]:
    """Yield the steps of a lesson.

    Parameters
    ----------
    program : Path
    language : {"en", "fr"}
        Of the captions.
    values : dict, optional
        Of its parameters, by name.
    """
    texts = texts_of(program)
    for caption, *shown in steps_function(program)(**(values or {})):
        told = caption if isinstance(caption, Caption) else Caption(caption)
        yield Step(
            told.text(language, texts.words(language)),
            tuple(shown),
            texts.marked.get(told.pattern, range(0)),
        )

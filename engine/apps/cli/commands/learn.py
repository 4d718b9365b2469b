"""``engine3d learn``: shows the lessons of the course, step by step in a window.

The lessons are programs in `engine3d.lessons`, installed as data. They run as scripts and import
each other, so their folder is on the import path.
"""

from __future__ import annotations

import argparse
import ast
import functools
import importlib
import os
import runpy
import subprocess
import sys
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from types import ModuleType

import numpy as np

from ....errors import DisplayError
from ...viewer.lesson_window import Lesson, LessonWindow
from ...viewer.window import Window
from ..arguments import meant
from ..options.language_options import language_of
from ..usage import UsageError
from . import french_lessons

SIZE = (1200, 720)


#: Texts of the window and the command, by language.
KEYS = {
    "en": "Arrows: steps. N and P: lessons. Q: leave. The program: {}",
    "fr": french_lessons.KEYS,
}
STEP = {"en": "step {} - arrows: steps, N P: lessons", "fr": french_lessons.STEP}


def learn(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    programs = find_programs()
    language = language_of(args)
    if args.list:
        for number in range(len(programs)):
            say(title_of(programs, number, language))
        return 0
    number = choose(args.lesson, programs)
    if args.path:
        print(programs[number])
        return 0
    if args.output is not None:
        if os.path.exists(args.output) and not os.path.isdir(args.output):
            raise UsageError(f"-o FOLDER: {args.output} is not a folder")
        return write(programs[number], args.output, language)
    show(programs, number, language)
    return 0


def say(text: str) -> None:
    """Print a line; letters missing in the terminal's encoding become question marks."""
    encoding = sys.stdout.encoding or "utf-8"
    print(text.encode(encoding, "replace").decode(encoding))


def find_programs() -> list[Path]:
    """Return the programs of the lessons, in order."""
    folder = Path(str(files("engine3d.lessons")))
    return sorted(folder.glob("[0-9][0-9]_*.py"))


def title_of(programs: list[Path], number: int, language: str = "en") -> str:
    """Return a lesson's number and title: its program's first sentence, or the French title."""
    if language == "fr":
        return french_lessons.title_in_french(number)
    program = programs[number]
    docstring = ast.get_docstring(ast.parse(program.read_text(encoding="utf-8"))) or ""
    return f"{number + 1:2}. {docstring.splitlines()[0].rstrip('.')}"


def choose(wanted: str, programs: list[Path]) -> int:
    """Return the index of a lesson given by number or name, such as 3 or lines."""
    names = [program.stem for program in programs]
    for number, name in enumerate(names):
        if wanted in (name, name[3:], name[:2], str(number + 1)):
            return number
    hint = meant(wanted, [name[3:] for name in names])
    raise UsageError(f"no lesson {wanted}{hint} (engine3d learn --list has them all)")


def write(program: Path, folder: str, language: str) -> int:
    """Write the pictures of a lesson to a folder; return the exit status."""
    if language == "en":
        command = [sys.executable, str(program), "-o", folder]
        return subprocess.run(command).returncode
    steps = ((french_lessons.caption_in_french(step[0]), *step[1:]) for step in steps_of(program))
    shared_by_lessons(program).save(Path(folder) / f"{program.stem}.png", steps)
    return 0


def show(programs: list[Path], number: int, language: str) -> None:
    """Show lessons in a window, starting with a given one.

    Raises
    ------
    DisplayError
        There is no screen.
    """
    lessons = [
        Lesson(title_of(programs, k, language).strip(), functools.partial(draw, program, language))
        for k, program in enumerate(programs)
    ]
    try:
        with Window(SIZE, lessons[number].title, wait=True) as window:
            say(KEYS[language].format(programs[number]))
            LessonWindow(window, lessons, number, STEP[language]).run()
    except DisplayError as error:
        raise DisplayError(f"{error}; -o FOLDER writes the pictures of a lesson") from error


def shared_by_lessons(program: Path) -> ModuleType:
    """Return the module that the lessons share, from their folder."""
    if str(program.parent) not in sys.path:
        sys.path.insert(0, str(program.parent))
    return importlib.import_module("lesson")


def steps_of(program: Path) -> Iterator[tuple]:
    """Yield the steps of a lesson from its program: a caption, then pictures."""
    shared_by_lessons(program)
    yield from runpy.run_path(str(program))["steps"]()


def draw(program: Path, language: str) -> Iterator[np.ndarray]:
    """Yield the steps of a lesson, each with its side pictures and caption."""
    for caption, *pictures in steps_of(program):
        if language == "fr":
            caption = french_lessons.caption_in_french(caption)
        yield shared_by_lessons(program).block(caption, *pictures)

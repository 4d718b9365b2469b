"""``engine3d learn``: the lessons of the course, step by step in a window.

The lessons are programs of `engine3d.lessons`, which is installed as data. They are run as scripts,
and import each other as such, so their folder is a place to import from.
"""

from __future__ import annotations

import argparse
import ast
import importlib
import runpy
import subprocess
import sys
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path

import numpy as np

from ..errors import DisplayError
from ..viewer.lesson_window import Lesson, LessonWindow
from ..viewer.window import Window
from .suggestions import meant
from .usage import UsageError

SIZE = (1200, 720)


def learn(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    programs = find_programs()
    if args.list:
        for program in programs:
            print(title_of(program))
        return 0
    number = choose(args.lesson, programs)
    if args.path:
        print(programs[number])
        return 0
    if args.output is not None:
        return subprocess.run([sys.executable, programs[number], "-o", args.output]).returncode
    show(programs, number)
    return 0


def find_programs() -> list[Path]:
    """Return the programs of the lessons, in their order."""
    folder = Path(str(files("engine3d.lessons")))
    return sorted(folder.glob("[0-9][0-9]_*.py"))


def title_of(program: Path) -> str:
    """Return the number of a lesson and the first sentence of its program."""
    docstring = ast.get_docstring(ast.parse(program.read_text(encoding="utf-8"))) or ""
    return f"{int(program.stem[:2]):2}. {docstring.splitlines()[0].rstrip('.')}"


def choose(wanted: str, programs: list[Path]) -> int:
    """Return the index of a lesson that is given by number or name, such as 3 or lines."""
    names = [program.stem for program in programs]
    for number, name in enumerate(names):
        if wanted in (name, name[3:], name[:2], str(number + 1)):
            return number
    hint = meant(wanted, [name[3:] for name in names])
    raise UsageError(f"no lesson {wanted}{hint} (engine3d learn --list has them all)")


def show(programs: list[Path], number: int) -> None:
    """Show lessons in a window, one of them first.

    Raises
    ------
    DisplayError
        There is no screen.
    """
    if str(programs[0].parent) not in sys.path:
        sys.path.insert(0, str(programs[0].parent))
    lessons = [Lesson(title_of(program).strip(), lambda p=program: draw(p)) for program in programs]
    print("Arrows: steps. N and P: lessons. Q: leave. The program:", programs[number])
    try:
        with Window(*SIZE, lessons[number].title, wait=True) as window:
            LessonWindow(window, lessons, number).run()
    except DisplayError as error:
        raise DisplayError(f"{error}; -o FOLDER writes the pictures of a lesson") from error


def draw(program: Path) -> Iterator[np.ndarray]:
    """Yield the steps of a lesson, each with what lies beside it and its caption."""
    block = importlib.import_module("lesson").block
    steps = runpy.run_path(str(program))["steps"]
    for step in steps():
        yield block(*step)

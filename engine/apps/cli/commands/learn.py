"""``engine3d learn``: shows the lessons of the course in a window, in a terminal or as HTML."""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

from ....base.files.atomic_write import atomic_write
from ....base.language import ENGLISH
from ....errors import DisplayError
from ....io.output.animation_files import numbered_path
from ...learn.lesson_file import LANGUAGES
from ...learn.lesson_programs import find_programs, shared_by_lessons, steps_function, texts_of
from ...learn.words import say
from ..arguments import meant
from ..options.language_options import language_of
from ..outputs import check_folder
from ..quietness import remark
from ..usage import UsageError

PAGES = (".html", ".htm")


def learn(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    programs = find_programs()
    chosen = language_of(args)
    language = chosen if chosen in LANGUAGES else ENGLISH
    if args.list:
        for program in programs:
            write_line(texts_of(program).title(language))
        return 0
    number = choose(args.lesson, programs)
    program = programs[number]
    if args.path:
        print(program)
    elif args.code:
        for line in texts_of(program).code:
            write_line(line)
    elif args.check is not None:
        return check(program, args.check, language)
    elif args.output is not None:
        write(program, args.output, language)
    else:
        show(args, programs, number, language)
    return 0


def write_line(text: str) -> None:
    """Print a line; letters missing in the terminal's encoding become question marks."""
    encoding = sys.stdout.encoding or "utf-8"
    print(text.encode(encoding, "replace").decode(encoding))


def choose(wanted: str, programs: list[Path]) -> int:
    """Return the index of a lesson given by number or name, such as 3 or lines."""
    names = [program.stem for program in programs]
    for number, name in enumerate(names):
        if wanted in (name, name[3:], name[:2], str(number + 1)):
            return number
    hint = meant(wanted, [name[3:] for name in names])
    raise UsageError(f"no lesson {wanted}{hint} (engine3d learn --list has them all)")


def check(program: Path, file: str, language: str) -> int:
    """Tell whether a pupil's program prints the answer of the exercise; return the exit status."""
    command = [sys.executable, file]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, errors="replace")
    if done.returncode != 0:  # what is wrong has been printed
        return 1
    numbers = re.findall(r"-?(?:[1-9]\d{0,2}(?:,\d{3})+|\d+)(?:[.,]\d+)?", done.stdout)
    is_right = bool(numbers) and texts_of(program).is_right(numbers[-1])
    verdict = say("right" if is_right else "wrong" if numbers else "none", language)
    write_line(f"{numbers[-1]}: {verdict}" if numbers else verdict)
    return 0 if is_right else 1


def write(program: Path, output: str, language: str) -> None:
    """Write a lesson as a page of HTML, or its pictures to a folder."""
    if output.lower().endswith(PAGES):
        write_page(program, output, language)
        return
    if os.path.exists(output) and not os.path.isdir(output):
        raise UsageError(f"-o FOLDER or FILE.html: {output} is not a folder")
    shared = shared_by_lessons(program)
    caption_of = shared.captions_of(program.stem, language)
    shared.save(Path(output) / f"{program.stem}.png", steps_function(program)(), caption_of)


def write_page(program: Path, output: str, language: str) -> None:
    """Write a lesson as a page of HTML."""
    from ...learn.page_html import lesson_html

    check_folder(output)
    page = lesson_html(program, language)
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(output) as file:
        file.write(page.encode("utf-8"))


def show(args: argparse.Namespace, programs: list[Path], number: int, language: str) -> None:
    """Show the course; where there is no screen, write the lesson as a page and say so."""
    from ...learn.course_session import Session
    from ...learn.learn_window import LearnWindow

    session = Session(programs, number, language)
    try:
        window = open_window(args, session.title)
    except DisplayError as error:
        if args.terminal:
            raise
        path = numbered_path(Path(), programs[number].stem, ".html")
        remark(f"{error}: writing the lesson to {path} instead")
        write_page(programs[number], str(path), language)
        return
    with window:
        LearnWindow(window, session).run()


def open_window(args: argparse.Namespace, title: str):
    """Return a window, or the terminal that replaces it."""
    if args.terminal:
        from ...terminal.terminal_window import TerminalWindow

        return TerminalWindow()
    from ...learn.page_picture import USUAL_SIZE
    from ...viewer.program_window import ProgramWindow

    return ProgramWindow(None, USUAL_SIZE, title, ui_scale=args.ui_scale, wait=True)

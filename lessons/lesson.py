"""What the lessons share: their arguments, the sheet of their pictures, and the lessons before.

A lesson is a program of its own. Its function `steps(width, height)` yields what it draws, step
after step, as `(caption, picture, ...)`: the picture so far, and beside it what explains it.
Pictures are arrays (H, W, 3) uint8, RGB, top row first, or `listing(lines)` of text. A caption with
numbers is `told("{count} pixels", count=3)`. The texts in both languages, and what may be changed,
are in the file `NN_name.md` beside the lesson.
"""

import argparse
import functools
import importlib.util
import inspect
import subprocess
import sys
from importlib.resources import files
from pathlib import Path

import numpy as np

import engine3d as e3d
from engine3d.apps.learn.captions import Caption
from engine3d.apps.learn.lesson_file import LANGUAGES, read_lesson
from engine3d.apps.learn.lesson_programs import Listing

FOLDER = Path(__file__).resolve().parent
MODELS = files("engine3d.data") / "models"
PAPER, INK = (30, 33, 40), (235, 235, 230)
MARGIN = 8
TYPE = 13  # pixels of the em
LEAST, MOST = 32, 2000  # pixels along a side
told = Caption
DIFFER = "{differ:no pixel differs|# pixel differs|# pixels differ}"  # in captions


def listing(lines):
    """Return lines of text, as what a step shows."""
    return Listing(tuple(lines))


def blank(width, height, color=PAPER):
    """Return a picture of one colour."""
    picture = np.empty((height, width, 3), np.uint8)
    picture[:] = color
    return picture


def magnify(picture, times):
    """Return a picture whose every pixel is a square, with a dark line between neighbours."""
    large = picture.repeat(times, axis=0).repeat(times, axis=1)
    large[::times] = large[::times] // 2
    large[:, ::times] = large[:, ::times] // 2
    return large


def as_picture(shown):
    """Return what a step shows as a picture: lines of text are written."""
    if not isinstance(shown, Listing):
        return shown
    mono, text = e3d.Font("mono", TYPE), "\n".join(shown.lines)
    width, height = mono.text_size(text)
    canvas = e3d.Canvas((width + 2 * MARGIN, height + 2 * MARGIN))
    canvas.clear(PAPER)
    canvas.text(MARGIN, MARGIN, text, INK, font=mono)
    return canvas.pixels[:, :, :3].copy()


@functools.cache
def earlier(name):
    """Return the module of another lesson: `earlier("03_lines").bresenham`."""
    spec = importlib.util.spec_from_file_location(f"lesson_{name}", FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def captions_of(name, language):
    """Return a function from a caption of a lesson to its text in a language."""
    words = read_lesson(FOLDER / f"{name}.md").words(language)

    def text_of(caption):
        caption = caption if isinstance(caption, Caption) else Caption(caption)
        return caption.text(language, words)

    return text_of


def block(caption, *shown):
    """Return what one step shows side by side, with its caption below."""
    sans, pictures = e3d.Font("sans", TYPE), [as_picture(one) for one in shown]
    width = sum(picture.shape[1] + MARGIN for picture in pictures) + MARGIN
    height = max(picture.shape[0] for picture in pictures) + 2 * MARGIN
    lines = sans.wrapped(str(caption), max(width - 2 * MARGIN, 8 * TYPE))
    page = np.full((height + sans.line_height * len(lines), width, 4), 255, np.uint8)
    page[:, :, :3] = PAPER
    left = MARGIN
    for picture in pictures:
        rows, columns = picture.shape[:2]
        page[MARGIN : MARGIN + rows, left : left + columns, :3] = picture
        left += columns + MARGIN
    e3d.Canvas(page).text(MARGIN, height - MARGIN // 2, "\n".join(lines), INK, font=sans)
    return page


def rows_of(blocks, widest):
    """Return blocks in rows, as many in a row as fit."""
    rows = [[]]
    for one in blocks:
        if rows[-1] and sum(b.shape[1] for b in rows[-1]) + one.shape[1] > widest:
            rows.append([])
        rows[-1].append(one)
    return rows


def sheet(blocks, widest=1040):
    """Lay blocks out in as few rows as fit, which are about equally long."""
    rows = rows_of(blocks, widest)
    while len(rows_of(blocks, widest - MARGIN)) == len(rows) and widest > MARGIN:
        widest -= MARGIN
    rows = rows_of(blocks, widest)
    width = max(sum(b.shape[1] for b in row) for row in rows)
    page = np.full((sum(max(b.shape[0] for b in row) for row in rows), width, 4), 255, np.uint8)
    page[:, :, :3] = PAPER
    top = 0
    for row in rows:
        left = 0
        for one in row:
            page[top : top + one.shape[0], left : left + one.shape[1]] = one
            left += one.shape[1]
        top += max(b.shape[0] for b in row)
    return page


def save(path, steps, text_of=str):
    """Draw all steps, and write their sheet to a file; return it."""
    blocks = [block(text_of(caption), *shown) for caption, *shown in steps]
    page = sheet(blocks)
    path.parent.mkdir(parents=True, exist_ok=True)
    e3d.Canvas(page).image().save(path)
    print(f"{path}: {len(blocks)} steps")
    return page


def size(argument):
    """Return (width, height) of an argument such as 320x240."""
    sides = tuple(int(side) for side in argument.split("x"))
    if len(sides) != 2 or not all(LEAST <= side <= MOST for side in sides):
        raise ValueError
    return sides


def positive(argument):
    """Return the number of an argument that must be above 0."""
    number = float(argument)
    if not 0 < number < float("inf"):
        raise ValueError
    return number


def add_options(parser, steps, numbers, parameters, others):
    """Add the options of a lesson: those of all lessons, its parameters, what else it can do."""
    parser.add_argument("-o", "--out", default="out", type=Path, help="folder (default: out)")
    parser.add_argument("--window", action="store_true", help="show them in a window as well")
    parser.add_argument("--size", type=size, metavar="WxH", help="of each picture, in pixels")
    parser.add_argument("--language", choices=LANGUAGES, default="en", help="of the captions")
    if "model" in inspect.signature(steps).parameters:
        parser.add_argument("--model", help="another model file")
    for option, meaning in numbers.items():
        parser.add_argument(f"--{option}", type=positive, metavar="NUMBER", help=meaning)
    for one in parameters:
        kind, meaning = type(one.values[0]), one.labels["en"].replace("%", "%%")
        parser.add_argument(f"--{one.name}", type=kind, choices=one.values, help=meaning)
    for option, function in others.items():
        summary = inspect.getdoc(function).splitlines()[0].rstrip(".")
        meaning = summary[:1].lower() + summary[1:]
        parser.add_argument(f"--{option}", action="store_true", help=meaning)


def main(file, steps, numbers=None, **others):
    """Run a lesson: write its pictures to a folder, or do one of the other things it can do.

    file: the lesson's `__file__`. numbers: what those parameters of `steps` mean that are options
    with any value, such as `{"chunk": "side of a chunk"}` for `--chunk NUMBER`. others: a function
    for each further option, such as `time=measure` for `--time`; it takes the model, too, if
    `steps` does.
    """
    name = Path(file).stem
    parser = argparse.ArgumentParser(prog=f"python lessons/{name}.py")
    parameters = read_lesson(FOLDER / f"{name}.md").parameters
    add_options(parser, steps, numbers or {}, parameters, others)
    given = parser.parse_args()
    model = {"model": given.model} if getattr(given, "model", None) else {}
    changeable = [*(numbers or ()), *(one.name for one in parameters)]
    values = {n: getattr(given, n) for n in changeable if getattr(given, n) is not None}
    chosen = [function for option, function in others.items() if getattr(given, option)]
    try:
        for function in chosen:
            function(**model)
        if not chosen:
            path = given.out / f"{name}.png"
            drawn = steps(*(given.size or ()), **model, **values)
            page = save(path, drawn, captions_of(name, given.language))
            if given.window:
                e3d.show(page, title=name)
    except (OSError, e3d.Engine3DError, subprocess.CalledProcessError) as error:
        sys.exit(f"{parser.prog}: {error}")

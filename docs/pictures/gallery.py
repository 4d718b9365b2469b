"""Draws the pictures of docs/gallery.md, and README.md's first, by the programs that stand there.

In: the pages. Out: a picture for each of its sections that has a program or a command, by the name
of the file that it writes. A block of Python runs as it is, a block of the shell has commands of
engine3d; both in an empty folder.
"""

from __future__ import annotations

import os
import re
import shlex
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from engine3d.apps.cli import main as engine3d

DOCS = Path(__file__).resolve().parents[1]
_FIRST = "Five lines\n"
BLOCK = re.compile(r"^```(python|sh)\n(.*?)^```", re.M | re.S)
_SAVED = re.compile(r"\b([\w-]+)\.png\b")


def programs() -> dict[str, list[tuple[str, str]]]:
    """Return the blocks of each section, as (language, text), by the name of its picture."""
    found = {}
    sections = (DOCS / "gallery.md").read_text(encoding="utf-8").split("\n## ")[1:]
    readme = (DOCS.parent / "README.md").read_text(encoding="utf-8").split("\n## ")
    for section in (*sections, *(one for one in readme if one.startswith(_FIRST))):
        blocks = BLOCK.findall(section)
        names = [name for _, text in blocks for name in _SAVED.findall(text)]
        if names:
            found[names[-1]] = blocks
    return found


def draw(name: str) -> np.ndarray:
    """Return the picture that a section's blocks write, as (H, W, 3) uint8."""
    from PIL import Image

    with empty_folder():
        _run(name)
        with Image.open(f"{name}.png") as image:
            return np.array(image.convert("RGB"))


@contextmanager
def empty_folder() -> Iterator[None]:
    """Work in a new folder, which is deleted afterwards."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(before)


def _run(name: str) -> None:
    values: dict = {}
    for language, text in programs()[name]:
        if language == "python":
            exec(compile(text, f"program of {name}", "exec"), values)
        else:
            _command(text)


def _command(text: str) -> None:
    for line in text.replace("\\\n", " ").splitlines():
        words = shlex.split(line, comments=True)
        if words and engine3d(words[1:]) != 0:
            raise RuntimeError(f"failed: {line}")

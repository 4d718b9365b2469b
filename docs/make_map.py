"""Prints what the files of the source hold: the first sentence of each, folder by folder.

    python docs/make_map.py [FOLDER...]       all of engine/, csrc/ and tests/, or these folders

In: the files as they are. Out: Markdown, a table for each folder. The site has it as a page.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from itertools import groupby, takewhile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("engine", "csrc", "tests")
SUFFIXES = (".py", ".pyx", ".pxi", ".c", ".h", ".inl")
HEAD = re.compile(
    r'\s*(?:# cython:[^\n]*\s+)?(?:"""(.*?)"""|/\*(.*?)\*/|((?:#(?: [^\n]*)?\n)+))', re.S
)
INTRODUCTION = """\
# The map

Every file with its first sentence: `docs/make_map.py` reads them when the site is built.
[Architecture](../architecture.md) tells how the rooms lie on one another.
"""


def sources(folder: Path) -> list[Path]:
    """The files below a folder, those of a folder together, without what Cython made."""
    found = [path for path in folder.rglob("*") if path.suffix in SUFFIXES]
    by_hand = [p for p in found if not (p.suffix == ".c" and p.with_suffix(".pyx").exists())]
    return sorted(by_hand, key=lambda path: (path.parent, path.name))


def first_sentence(path: Path) -> str:
    """What a file begins with: the first sentence of its docstring or comment, or nothing."""
    head = HEAD.match(path.read_text(encoding="utf-8"))
    if not head:
        return ""
    lines = [line.strip(" \t*#") for line in next(filter(None, head.groups())).splitlines()]
    paragraph = " ".join(takewhile(bool, lines))
    return re.split(r"(?<=[.!?])\s+(?=\S)", paragraph)[0]


def cell(sentence: str) -> str:
    """A sentence as a cell of a table: what would be marks of Markdown stays what it is."""
    return re.sub(r"([|<*_])", r"\\\1", sentence.replace("``", "`"))


def tables(folders: list[Path]) -> Iterator[str]:
    for folder in folders:
        for place, files in groupby(sources(folder), key=lambda path: path.parent):
            rows = {path.name: first_sentence(path) for path in files}
            yield f"## {place.relative_to(ROOT).as_posix()}/\n"
            of_folder = rows.pop("__init__.py", "")
            if of_folder:
                yield f"{of_folder}\n"
            if rows:
                yield "| File | What it holds |\n|---|---|"
                yield "".join(f"| `{name}` | {cell(text)} |\n" for name, text in rows.items())


def page() -> str:
    return "\n".join([INTRODUCTION, *tables([ROOT / name for name in FOLDERS])])


if __name__ == "__main__":
    named = [Path(word).resolve() for word in sys.argv[1:]]
    print("\n".join(tables(named)) if named else page())

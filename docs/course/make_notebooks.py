"""Makes a notebook of each lesson, in English and in French.

    python docs/course/make_notebooks.py FOLDER     FOLDER/en/03_lines.ipynb and so on

In: the programs of lessons/ and their pages. Out: for each page a notebook (nbformat 4.5) with its
text and the whole program, a cell per function, those that the page explains below their
explanation; and a cell that draws the steps. It needs engine3d and nothing else but Jupyter.
"""

from __future__ import annotations

import argparse
import ast
import json
import re
import runpy
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
COURSE = runpy.run_path(str(FOLDER / "make.py"))
PREPARE = """\
import sys
from importlib.resources import files

sys.path.insert(0, str(files("engine3d.lessons")))  # where the lessons find each other"""
SHOW = """\
from lesson import block, captions_of

import engine3d as e3d

caption_of = captions_of("{name}", "{language}")
for caption, *shown in steps():
    display(e3d.Canvas(block(caption_of(caption), *shown)).image())"""


def chunks_of(program: str) -> list[str]:
    """Return a program in pieces: what stands before the first function, then one each.

    What follows a function, such as a constant, stays with it; the call of `main` is left out.
    """
    tree = ast.parse(program)
    definitions = [n for n in tree.body if isinstance(n, ast.FunctionDef | ast.ClassDef)]
    starts = [node.lineno - 1 for node in definitions]
    lines = program.splitlines()
    bounds = [tree.body[0].end_lineno, *starts, tree.body[-1].lineno - 1]
    return ["\n".join(lines[a:b]).strip("\n") for a, b in zip(bounds, bounds[1:], strict=False)]


def parts_of(page: str) -> tuple[str, str, str]:
    """Return a page in three: title and idea, the program, and what follows."""
    sections = re.split(r"^(?=## )", page, flags=re.M)
    title = sections[0].partition("\n")[0]
    return f"{title}\n\n{sections[1]}", sections[2], "".join(sections[3:])


def explained(section: str) -> list[tuple[str, str, str]]:
    """Return the quotes of a section: the text before each, its language, its code."""
    found = re.split(r"^```(\w+)\n(.*?)^```\n", section, flags=re.M | re.S)
    return list(zip(found[0::3], found[1::3], found[2::3], strict=False))


def cells_of(page: str, program: str, show: str) -> list[tuple[str, str]]:
    """Return the cells of a notebook: ("markdown" or "code", text).

    `show` is the cell that draws the steps.
    """
    idea, middle, rest = parts_of(page)
    chunks, emitted = chunks_of(program), 0
    cells = [("markdown", idea), ("code", PREPARE)]
    for text, language, code in explained(middle):
        holding = [k for k, chunk in enumerate(chunks) if k >= emitted and code in f"{chunk}\n"]
        if holding:
            place = holding[0]
            cells += [("code", chunk) for chunk in chunks[emitted:place]]
            cells += [("markdown", text), ("code", chunks[place])]
            emitted = place + 1
        else:
            cells.append(("markdown", f"{text}```{language}\n{code}```"))
    cells += [("code", chunk) for chunk in chunks[emitted:]]
    after = re.split(r"^```\w+\n.*?^```\n", middle, flags=re.M | re.S)[-1]
    cells += [("markdown", after), ("code", show), ("markdown", rest)]
    return [(kind, text) for kind, text in cells if text.strip()]


def notebook(name: str, language: str) -> dict:
    """Return the notebook of a lesson as what JSON holds."""
    page = (FOLDER / language / f"{name}.md").read_text(encoding="utf-8")
    program = (COURSE["LESSONS"] / f"{name}.py").read_text(encoding="utf-8")
    show = SHOW.format(name=name, language=language)
    cells = []
    for number, (kind, text) in enumerate(cells_of(page, program, show)):
        cell = {"cell_type": kind, "id": f"{language}-{name}-{number}", "metadata": {}}
        cell["source"] = text.strip("\n").splitlines(keepends=True)
        if kind == "code":
            cell |= {"execution_count": None, "outputs": []}
        cells.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}


def main() -> None:
    parser = argparse.ArgumentParser(description="Make notebooks of the lessons.")
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    for language in COURSE["WORDS"]:
        (folder / language).mkdir(parents=True, exist_ok=True)
        for name in COURSE["lesson_names"]():
            path = folder / language / f"{name}.ipynb"
            text = json.dumps(notebook(name, language), indent=1, ensure_ascii=False)
            path.write_text(f"{text}\n", encoding="utf-8")


if __name__ == "__main__":
    main()

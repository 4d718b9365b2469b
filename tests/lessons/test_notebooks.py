"""The notebooks of the lessons have all of their code, and draw what the lessons draw."""

import ast
import json
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

COURSE = Path(__file__).resolve().parents[2] / "docs" / "course"
SCRIPT = COURSE / "make_notebooks.py"
make = runpy.run_path(str(SCRIPT))
LESSONS, NAMES = make["COURSE"]["LESSONS"], make["COURSE"]["lesson_names"]()


def cells(name, language, kind):
    found = make["notebook"](name, language)["cells"]
    return ["".join(cell["source"]) for cell in found if cell["cell_type"] == kind]


def definitions(text):
    tree = ast.parse(text)
    return [node.name for node in tree.body if isinstance(node, ast.FunctionDef | ast.ClassDef)]


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_has_the_whole_program_and_the_whole_page(name):
    program = (LESSONS / f"{name}.py").read_text(encoding="utf-8")
    for language in ("en", "fr"):
        code, texts = cells(name, language, "code"), cells(name, language, "markdown")
        assert definitions("\n".join(code)) == definitions(program)
        page = (COURSE / language / f"{name}.md").read_text(encoding="utf-8").splitlines()
        whole = "\n".join([*code, *texts])
        lost = [line for line in page[5:] if line not in whole and not line.startswith("    py")]
        assert [line for line in lost if not line.startswith("```")] == []
        assert texts[0].startswith(page[0])
    english, french = (cells(name, language, "code") for language in ("en", "fr"))
    assert french == [code.replace(f'("{name}", "en")', f'("{name}", "fr")') for code in english]
    assert french != english


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "fr"])
@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_runs_and_draws_the_picture(name, language, monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path])
    shown = []
    names = {"display": lambda image: shown.append(np.asarray(image))}
    for code in cells(name, language, "code"):
        exec(compile(code, name, "exec"), names)
    from lesson import sheet

    with Image.open(make["COURSE"]["picture_path"](name, language)) as kept:
        assert np.array_equal(sheet(shown)[:, :, :3], np.asarray(kept.convert("RGB")))


def test_the_script_writes_notebooks(tmp_path):
    subprocess.run([sys.executable, SCRIPT, tmp_path], check=True)
    paths = sorted(tmp_path.rglob("*.ipynb"))
    assert [f"{path.parent.name}/{path.stem}" for path in paths] == [
        f"{language}/{name}" for language in ("en", "fr") for name in NAMES
    ]
    for path in paths:
        book = json.loads(path.read_text(encoding="utf-8"))
        assert (book["nbformat"], book["nbformat_minor"]) == (4, 5)
        ids = [cell["id"] for cell in book["cells"]]
        assert len(set(ids)) == len(ids) > 6
        assert all(cell["source"] for cell in book["cells"])

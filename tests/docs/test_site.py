"""The examples of the site run, and every page has its place in the site."""

import ast
import re
import runpy
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from engine3d import Canvas, Frame

DOCS = Path(__file__).resolve().parents[2] / "docs"
EXAMPLES = sorted((DOCS / "examples").glob("*/plot_*.py"))
MAX_LINES = 40


def test_there_are_many_examples_and_each_has_a_number():
    numbers = [path.stem.split("_")[1] for path in EXAMPLES]
    assert len(EXAMPLES) >= 30 and len(set(numbers)) == len(numbers)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run_and_draw(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = runpy.run_path(str(path))
    drawn = [np.asarray(x) for x in names.values() if isinstance(x, (Frame, Image.Image))]
    drawn += [x.pixels for x in names.values() if isinstance(x, Canvas)]
    drawn += [np.asarray(Image.open(path).convert("RGB")) for path in tmp_path.iterdir()]
    assert drawn, "nothing to show: the page would have no picture"
    for pixels in drawn:
        assert pixels.std() > 1.0, "a blank picture"
        assert pixels.shape[0] * pixels.shape[1] <= 640 * 480, "examples are small and quick"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_short_and_say_what_they_show(path):
    text = path.read_text(encoding="utf-8")
    assert text.count("\n") <= MAX_LINES
    title, rule, blank, first = text.split("\n")[1:5]
    assert len(title) == len(rule) and not blank and first.startswith("This ")


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_use_models_that_every_installation_has(path):
    setup = (DOCS.parent / "setup.py").read_text(encoding="utf-8")
    left_out = ast.literal_eval(re.search(r"^SOURCE_ONLY = (\[.*?\])", setup, re.M | re.S)[1])
    named = re.findall(r'"(\w+\.\w+)"', path.read_text(encoding="utf-8"))
    assert not [one for one in named for kind in left_out if fnmatch(f"models/{one}", kind)]


def test_every_page_has_its_place_in_the_site():
    folders = ("", "exactness/", "tutorials/", "viewer/")
    pages = {page.stem for folder in folders for page in DOCS.glob(f"{folder}*.md")} - {"index"}
    parents = ("index.md", "guides.md", "inside.md")
    parents += tuple(f"{name}/index.md" for name in ("api", "exactness", "tutorials", "viewer"))
    texts = [(DOCS / name).read_text(encoding="utf-8") for name in parents]
    placed = {
        line.rpartition("/")[2]
        for text in texts
        for line in text.split("```{toctree}")[1].splitlines()
    }
    assert pages <= placed, "name it in a toctree, such as that of docs/guides.md or docs/inside.md"

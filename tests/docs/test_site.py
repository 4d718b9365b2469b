"""The examples of the site run, and every page has its place in the site."""

import runpy
from pathlib import Path

import pytest

import engine3d

DOCS = Path(__file__).resolve().parents[2] / "docs"
EXAMPLES = sorted((DOCS / "examples").glob("plot_*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run_and_draw(path):
    names = runpy.run_path(str(path))
    drawn = [x for x in names.values() if isinstance(x, (engine3d.Frame, engine3d.Canvas))]
    assert drawn, "nothing to show: the page would have no picture"
    for picture in drawn:
        pixels = picture.color if isinstance(picture, engine3d.Frame) else picture.pixels
        assert pixels.std() > 1.0, "a blank picture"


def test_every_page_has_its_place_in_the_site():
    folders = (DOCS, DOCS / "exactness", DOCS / "tutorials")
    pages = {page.stem for folder in folders for page in folder.glob("*.md")} - {"index"}
    parents = ("index.md", "guides.md", "inside.md")
    parents += tuple(f"{name}/index.md" for name in ("api", "exactness", "tutorials"))
    texts = [(DOCS / name).read_text(encoding="utf-8") for name in parents]
    placed = {
        line.rpartition("/")[2]
        for text in texts
        for line in text.split("```{toctree}")[1].splitlines()
    }
    assert pages <= placed, "name it in a toctree, such as that of docs/guides.md or docs/inside.md"

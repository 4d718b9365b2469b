"""The pages of the documentation name files and links that exist."""

import re
import shlex
from collections import Counter
from pathlib import Path

import pytest
from page_extras import missing_extra

from engine3d import box, save_mesh
from engine3d.apps.cli import main
from engine3d.apps.cli.parser import make_parser
from engine3d.apps.viewer.window import Window
from engine3d.events import CloseRequested

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "data" / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
PAGES += sorted((ROOT / "docs" / "viewer").glob("*.md"))
RULES = sorted((ROOT / "docs" / "exactness").glob("*.md"))
TUTORIALS = sorted((ROOT / "docs" / "tutorials").glob("*.md"))
FOLDERS = [ROOT, *(ROOT / name for name in ("benchmarks", "data", "docs"))]
FOLDERS += [
    path
    for name in ("csrc", "engine", "tests")
    for path in (ROOT / name, *(ROOT / name).glob("**/"))
]
FILE_NAME = re.compile(r"`((?:[\w.-]+/)*[\w-]+\.(?:py|pyx|c|h|inl|md|pxd))`")


def page_id(page):
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", [*PAGES, *RULES, *TUTORIALS], ids=page_id)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
        path = target.partition("#")[0]
        if path and "://" not in target:
            assert (page.parent / path).exists(), target


@pytest.mark.parametrize(
    "name", ["architecture.md", "core.md", "rasteriser.md", "hacking.md", "canvas.md"]
)
def test_files_that_pages_name_exist(name):
    names = FILE_NAME.findall((ROOT / "docs" / name).read_text(encoding="utf-8"))
    assert names
    for file in names:
        if "NAME" not in file:
            assert any((folder / file).exists() for folder in FOLDERS), f"{name}: {file}"


def test_what_the_page_of_the_rasteriser_names_exists():
    text = (ROOT / "docs" / "rasteriser.md").read_text(encoding="utf-8")
    names = set(re.findall(r"`(\w*_\w+)`", text))
    names.update(*re.findall(r"`(e3d_\w+)\.(\w+)`", text))
    sources = [path for path in (ROOT / "csrc").rglob("*") if path.suffix in (".c", ".h", ".inl")]
    words = set(re.findall(r"\w+", " ".join(path.read_text(encoding="utf-8") for path in sources)))
    plan = re.findall(r"^    X\((\w+)", (ROOT / "csrc/frame/pass/plan.h").read_text(), re.M)
    missing = names - words - {item.lower() for item in plan}
    assert len(names) > 50
    assert not missing, "renamed or gone: say so in docs/rasteriser.md"


def commands(page):
    """The engine3d commands of a page's indented lines, without comments, as lists of words."""
    lines = re.findall(r"^    (engine3d [^|\n]+)", page.read_text(encoding="utf-8"), re.M)
    return [shlex.split(line, comments=True)[1:] for line in lines]


@pytest.mark.parametrize("page", PAGES[1:], ids=page_id)
def test_commands_parse(page):
    for words in commands(page):
        make_parser().parse_args(words)


def test_the_recipe_for_thumbnails_draws_them(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for folder in ("", "a", "a/b"):
        (tmp_path / "models" / folder).mkdir(parents=True, exist_ok=True)
        save_mesh(box(), tmp_path / "models" / folder / "box.ply")
    (words,) = (
        w for w in commands(ROOT / "docs" / "recipes.md") if w[0] == "render" and "models/" in w
    )
    assert main(words) == 0 and capsys.readouterr().err == "engine3d: 3 drawn\n"
    drawn = sorted(path.as_posix() for path in Path("thumbnails").rglob("*.*"))
    assert drawn == [f"thumbnails/{folder}box.webp" for folder in ("a/b/", "a/", "")]


@pytest.fixture
def closing_windows(monkeypatch):
    """Windows open on SDL's dummy driver, and their user closes them after a moment."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    take, times = Window.events, Counter()

    def events(window, timeout=0.0):
        times[id(window)] += 1
        # Where nothing moves, windows wait for a quarter of a second and more.
        received = take(window, min(timeout, 0.02))
        return [*received, *[CloseRequested()] * (times[id(window)] > 20)]

    monkeypatch.setattr(Window, "events", events)


@pytest.mark.parametrize("page", PAGES[1:], ids=page_id)
def test_python_examples_run(page, tmp_path, monkeypatch, closing_windows):
    monkeypatch.chdir(tmp_path)
    names, text = {}, page.read_text(encoding="utf-8")
    if missing := missing_extra(text):
        pytest.skip(f"pip install {missing}")
    for block in re.findall(r"^```python\n(.*?)^```", text, re.M | re.S):
        exec(compile(block, page.name, "exec"), names)


def test_the_column_of_a_table_becomes_a_picture(tmp_path, monkeypatch):
    pytest.importorskip("pandas")
    text = (ROOT / "docs" / "numbers.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for block in re.findall(r"^```python\n(.*?)^```", text, re.M | re.S):
        exec(compile(block, "numbers.md", "exec"), {})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["heat.ply", "heat.png"]

"""The pages of the documentation name files and links that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "data" / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FOLDERS = [ROOT, ROOT / "docs", ROOT / "data", ROOT / "engine", ROOT / "tests"]
FOLDERS += [ROOT / "csrc", *(path for path in (ROOT / "csrc").rglob("*") if path.is_dir())]
FOLDERS += [path for path in (ROOT / "engine").iterdir() if path.is_dir()]
FILE_NAME = re.compile(r"`((?:[\w.-]+/)*[\w-]+\.(?:py|pyx|c|h|inl|md|pxd))`")


def page_id(page):
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", PAGES, ids=page_id)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
        path = target.partition("#")[0]
        if path and "://" not in target:
            assert (page.parent / path).exists(), target


@pytest.mark.parametrize("name", ["architecture.md", "hacking.md", "canvas.md"])
def test_files_that_pages_name_exist(name):
    names = FILE_NAME.findall((ROOT / "docs" / name).read_text(encoding="utf-8"))
    folders = [*FOLDERS, ROOT / "benchmarks", ROOT / "tests" / "unit"]
    assert names
    for file in names:
        if "NAME" not in file:
            assert any((folder / file).exists() for folder in folders), f"{name}: {file}"

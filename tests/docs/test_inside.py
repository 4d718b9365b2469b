"""The pages for those who change the source are short, and what they are made from is there."""

import re
import runpy
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
ARCHITECTURE = (DOCS / "architecture.md").read_text(encoding="utf-8")
RULES = sorted((DOCS / "exactness").glob("[0-9]*.md"))
MAX_WORDS = 1500
MAX_WORDS_OF_CELL = 25
MAX_LINE = 300  # characters

MAP = runpy.run_path(str(DOCS / "make_map.py"))
CODE = runpy.run_path(str(DOCS / "reference_code.py"))


def rules_of(page):
    return [int(n) for n in re.findall(r"^## R(\d+)$", page.read_text(encoding="utf-8"), re.M)]


def test_the_architecture_is_short():
    assert len(ARCHITECTURE.split()) <= MAX_WORDS
    cells = [
        cell for line in ARCHITECTURE.splitlines() if line[:1] == "|" for cell in line.split("|")
    ]
    assert len(cells) > 50
    assert [cell for cell in cells if len(cell.split()) > MAX_WORDS_OF_CELL] == []


@pytest.mark.parametrize("folder", MAP["FOLDERS"])
def test_files_begin_with_what_they_hold(folder):
    paths = MAP["sources"](DOCS.parent / folder)
    assert len(paths) > 100
    silent = [str(p) for p in paths if not re.search(r"\w.*[.!?…:]$", MAP["first_sentence"](p))]
    assert silent == [], "begin each with a sentence that says what it holds"


def test_the_map_prints_a_folder(capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["make_map.py", str(DOCS.parent / "tests" / "docs")])
    runpy.run_path(str(DOCS / "make_map.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "## tests/docs/"
    assert f"| `test_inside.py` | {__doc__} |" in lines


def test_no_rule_stands_twice():
    rules = [rule for page in RULES for rule in rules_of(page)]
    assert len(rules) > 140 and len(set(rules)) == len(rules)


def test_rules_have_short_lines():
    lines = [line for page in RULES for line in page.read_text(encoding="utf-8").splitlines()]
    assert [line for line in lines if len(line) > MAX_LINE] == []


def test_each_rule_has_its_code():
    rules = {rule for page in RULES for rule in rules_of(page)}
    assert rules - CODE["code_of_rules"]().keys() == set(), "cite it where it is computed"


def test_the_code_of_a_rule_is_the_references():
    page = CODE["with_code"]("# Surface\n\n## R21\n\nPosition.\n\n## R22\n\nNormal.\n")
    before, after = page.split("## R22")
    assert "static void find_position(" in before and "find_normal(" not in before
    assert "static void find_normal(" in after and "/* csrc/reference/surface.c */" in after

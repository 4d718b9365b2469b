"""docs/glossary.md has few words, each with one meaning, and the code uses them."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "glossary.md"
MAX_TERMS = 120


def rows():
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if "|" in line]


ROWS = rows()[2:]
TERMS = [row[0] for row in ROWS]


def source():
    """What the project wrote, but for the glossary, in small letters."""
    files = [
        *ROOT.glob("docs/*.md"),
        *ROOT.glob("docs/viewer/*.md"),
        *ROOT.glob("docs/exactness/*.md"),
        *ROOT.glob("engine/**/*.py"),
    ]
    files += [path for path in ROOT.glob("csrc/**/*") if path.suffix in (".c", ".h", ".inl")]
    return "".join(path.read_text(encoding="utf-8") for path in files if path != PAGE).lower()


def test_rows_are_whole_and_in_order():
    assert 80 < len(TERMS) <= MAX_TERMS
    assert all(len(row) == 3 and all(row) for row in ROWS)
    assert [term.lower() for term in TERMS] == sorted({term.lower() for term in TERMS})


def test_each_term_has_one_meaning():
    several = [row[0] for row in ROWS if ";" in row[1] or " also" in row[1]]
    assert several == [], "rename one of them in the source"


def test_each_term_is_used():
    text = source()
    patterns = {
        term: re.sub(r"[ -]", r"[\\s_*-]+", re.escape(term.lower()).replace("\\", ""))
        for term in TERMS
    }
    unused = [
        term for term, pattern in patterns.items() if not re.search(rf"(?<![a-z]){pattern}", text)
    ]
    assert unused == [], "delete them from docs/glossary.md"

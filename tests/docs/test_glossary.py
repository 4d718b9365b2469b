"""docs/glossary.md explains the words of the code, and no others."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "glossary.md"
HEADERS = [*ROOT.glob("csrc/pipeline/*/*.h"), *ROOT.glob("csrc/kernels/types/*.h")]
# What ends the name of a type and says nothing of what it is about.
FORMS = "array|buffer|float|in|job|memory|out|progress|row|set|state|style|table|word"


def rows():
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if "|" in line]


def singular(word):
    for ending, one in (("vertices", "vertex"), ("ies", "y"), ("ss", "ss"), ("s", "")):
        if word.endswith(ending):
            return word.removesuffix(ending) + one
    return word


ROWS = rows()[2:]
TERMS = [row[0] for row in ROWS]


def noun_of(name):
    """The words of a type's name without e3d_ and what only says how it is stored."""
    words = [singular(word) for word in name.split("_")[1:]]
    while len(words) > 1 and re.fullmatch(FORMS, words[-1]):
        words.pop()
    return words


def types():
    text = "".join(path.read_text(encoding="utf-8") for path in HEADERS)
    found = re.findall(r"^typedef (?:struct|enum) (e3d_\w+) \{", text, re.M)
    return sorted({*found, *re.findall(r"^typedef \w+ (e3d_\w+)(?:\[.*\])?;", text, re.M)})


def source():
    """What the project wrote, but for the glossary, in small letters."""
    files = [
        *ROOT.glob("docs/*.md"),
        *ROOT.glob("docs/exactness/*.md"),
        *ROOT.glob("engine/**/*.py"),
    ]
    files += [path for path in ROOT.glob("csrc/**/*") if path.suffix in (".c", ".h", ".inl")]
    return "".join(path.read_text(encoding="utf-8") for path in files if path != PAGE).lower()


def test_rows_are_whole_and_in_order():
    assert len(TERMS) > 80
    assert all(len(row) == 3 and all(row) for row in ROWS)
    assert [term.lower() for term in TERMS] == sorted({term.lower() for term in TERMS})


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


@pytest.mark.parametrize("name", types())
def test_each_type_has_a_term(name):
    terms = {term.lower() for term in TERMS}
    words = noun_of(name)
    assert words[-1] in terms or " ".join(words) in terms, "explain it in docs/glossary.md"


def test_nouns_of_types():
    assert len(types()) > 70
    assert noun_of("e3d_kept_memory") == ["kept"]
    assert noun_of("e3d_pixel_rows") == ["pixel"]
    assert noun_of("e3d_to_do") == ["to", "do"]
    assert noun_of("e3d_drawn_cluster")[-1] == "cluster"
    assert noun_of("e3d_histories") == ["history"]

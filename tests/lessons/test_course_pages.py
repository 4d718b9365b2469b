"""The pages quote the lessons truly, alike in both languages; their links and tables hold."""

import re
import runpy
import shlex
import sys
from pathlib import Path

import pytest

import engine3d
from engine3d.apps.cli.parser import make_parser

ROOT = Path(__file__).resolve().parents[2]
LESSONS, COURSE = ROOT / "lessons", ROOT / "docs" / "course"
make = runpy.run_path(str(COURSE / "make.py"))
NAMES = make["lesson_names"]()
SECTIONS = {language: list(headings.values()) for language, headings in make["HEADINGS"].items()}
PROGRAM, TASKS = 1, 4  # of the sections


def page(language, name):
    return (COURSE / language / f"{name}.md").read_text(encoding="utf-8")


def sections(text):
    """The headings of a page, and what stands below each."""
    parts = re.split(r"^## (.*)\n", text, flags=re.M)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def quotes(text):
    """The code that a page quotes, as (language, lines)."""
    return re.findall(r"^```(\w+)\n(.*?)^```", text, re.M | re.S)


def terms(text):
    """The rows of a page's last table."""
    rows = sections(text).popitem()[1].strip().splitlines()
    return [tuple(cell.strip() for cell in row.strip("|").split("|")) for row in rows]


@pytest.mark.parametrize("name", NAMES)
def test_pages_quote_the_lesson(name):
    programs = [path for path in sorted(LESSONS.glob(f"{name}.*")) if path.suffix in (".py", ".c")]
    sources = "".join(path.read_text(encoding="utf-8") for path in programs)
    found = [
        quotes(sections(page(language, name))[headings[PROGRAM]])
        for language, headings in SECTIONS.items()
    ]
    assert found[0] == found[1] != []
    for kind, code in found[0]:
        assert kind in ("python", "c")
        assert f"\n{code}" in sources, code


@pytest.mark.parametrize("name", NAMES)
def test_pages_have_the_same_parts_in_both_languages(name):
    exercises, vocabulary, commands = [], [], []
    for language, headings in SECTIONS.items():
        text = page(language, name)
        assert list(sections(text)) == headings
        assert text.startswith(f"# {int(name[:2])}. ")
        picture = f"{name}.png" if language == "en" else f"{language}/{name}.png"
        assert text.count(f"](../pictures/{picture})") == 1
        exercises.append(re.findall(r"^(\d)\. ", sections(text)[headings[TASKS]], re.M))
        vocabulary.append(terms(text)[2:])
        commands.append(re.findall(r"^    (python .*?\w)(?:  .*)?$", text, re.M))
    assert exercises[0] == exercises[1] and 3 <= len(exercises[0]) <= 5
    assert vocabulary[0] == [row[::-1] for row in vocabulary[1]] and len(vocabulary[0]) >= 3
    assert len(commands[0]) == len(commands[1]) >= 1


@pytest.mark.parametrize("name", NAMES)
def test_commands_of_a_page_are_those_of_the_lesson(name, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", [name, "--help"])
    monkeypatch.syspath_prepend(str(LESSONS))
    with pytest.raises(SystemExit):
        runpy.run_path(str(LESSONS / f"{name}.py"), run_name="__main__")
    offered = set(re.findall(r"--[\w-]+", capsys.readouterr().out))
    for language in SECTIONS:
        lines = re.findall(r"^    python (lessons/\S+)([^#\n]*)", page(language, name), re.M)
        assert {path for path, _ in lines} == {f"lessons/{name}.py"}
        assert set(re.findall(r"--[\w-]+", " ".join(words for _, words in lines))) <= offered


def test_links_and_lists_are_up_to_date():
    texts = make["texts"]()
    assert len(texts) == 2 * (len(NAMES) + 1)
    stale = [path for path, text in texts.items() if path.read_text(encoding="utf-8") != text]
    assert stale == [], "python docs/course/make.py"


@pytest.mark.parametrize("path", [*COURSE.rglob("*.md"), LESSONS / "README.md"], ids=str)
def test_links_lead_somewhere(path):
    targets = re.findall(r"\]\(([^)\s]+)\)", path.read_text(encoding="utf-8"))
    assert targets
    for target in targets:
        if "://" not in target:
            assert (path.parent / target.partition("#")[0]).exists(), target


def test_pictures_belong_to_lessons():
    for folder in (COURSE / "pictures", COURSE / "pictures" / "fr"):
        assert sorted(path.stem for path in folder.glob("*.png")) == NAMES


def shown_by():
    """The second cells of the tables that tell what shows what."""
    text = (COURSE / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (.*?) \| (.*) \|$", text, re.M)
    return [cell for what, cell in rows if what != "What"]


def test_the_table_of_the_courses_names_every_lesson():
    cells = shown_by()
    numbers = re.findall(r"(?:^|of )(\d+)", "\n".join(cells), re.M)
    assert len(cells) > 30
    assert {int(number) for number in numbers} == set(range(1, len(NAMES) + 1))


def test_what_the_table_of_the_courses_names_exists():
    code = re.findall(r"`([^`]+)`", "\n".join(shown_by()))
    words = {word for text in code for word in re.findall(r"e3d\.(\w+)", text)}
    assert words and all(hasattr(engine3d, word) for word in words)
    scripts = {word for text in code for word in re.findall(r"\w+/\w+\.py", text)}
    assert scripts and all((ROOT / script).exists() for script in scripts)
    commands = [shlex.split(text)[1:] for text in code if text.startswith("engine3d ")]
    for words in commands:
        make_parser().parse_args(words)
    assert len(commands) > 5

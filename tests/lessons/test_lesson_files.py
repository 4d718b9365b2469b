"""The files of lessons: they fit the programs, and the lines to type run by themselves."""

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

from engine3d.apps.learn.captions import Caption, fields
from engine3d.apps.learn.lesson_file import LANGUAGES, read_lesson
from engine3d.apps.learn.lesson_programs import (
    find_programs,
    first_values,
    steps_function,
    texts_of,
)
from engine3d.apps.learn.page_picture import CODE_COLUMNS

SOLUTIONS = Path(__file__).resolve().parents[2] / "docs" / "course" / "solutions"
PROGRAMS = find_programs()
each_lesson = pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.stem)


@each_lesson
def test_a_lesson_has_all_texts_in_both_languages(program):
    texts = texts_of(program)
    for section in (
        "title",
        "shown",
        "commands",
        "idea",
        "exercise",
        "program",
        "observe",
        "tasks",
    ):
        for language in LANGUAGES:
            assert texts.texts[section, language].strip()
    assert "solution" not in {section for section, _ in texts.texts}
    assert texts.parameters, "something to play with"


@each_lesson
def test_lines_are_marked_where_there_are_lines(program):
    texts = texts_of(program)
    assert 2 <= len(texts.code) <= 28
    assert all(len(line) <= CODE_COLUMNS for line in texts.code)
    assert texts.marked
    for marked in texts.marked.values():
        assert 0 <= marked.start < marked.stop <= len(texts.code)


@each_lesson
def test_captions_are_known_in_french_for_all_values(program):
    """Of small pictures: what is said depends on the numbers, not on the pixels."""
    texts, usual = texts_of(program), first_values(program)
    for english, french in texts.captions.items():
        assert fields(english) == fields(french)
    seen = set()
    for parameter in texts.parameters:
        assert usual[parameter.name] in parameter.values
        assert all(parameter.labels[language] for language in LANGUAGES)
        for value in parameter.values:
            for caption, *_ in steps_function(program)(64, 48, **{parameter.name: value}):
                told = caption if isinstance(caption, Caption) else Caption(caption)
                assert told.pattern in texts.captions, told.pattern
                words = {value for value in told.values.values() if isinstance(value, str)}
                assert all(word in texts.captions or not word.isalpha() for word in words)
                told.text("fr", texts.words("fr"))
                seen |= {told.pattern, *words}
            if isinstance(value, str):
                seen.add(value)
    assert seen >= texts.marked.keys()


def run(code, folder):
    return subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True)


@each_lesson
def test_the_lines_to_type_run_in_an_empty_folder(program, tmp_path):
    done = run("\n".join(texts_of(program).code), tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout or list(tmp_path.iterdir())


@each_lesson
def test_the_solution_gives_the_answer(program, tmp_path):
    done = run((SOLUTIONS / program.name).read_text("utf-8"), tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    texts, answer = texts_of(program), float(done.stdout)
    assert texts.is_right(done.stdout) and texts.is_right(f" {answer:.1f} ".replace(".", ","))
    assert texts.is_right(f"{answer:,.0f}") == answer.is_integer()
    for wrong in (str(answer + 1), str(-answer), "", "x", "nan"):
        assert not texts.is_right(wrong)


def test_solutions_belong_to_lessons():
    assert [path.name for path in sorted(SOLUTIONS.iterdir())] == [path.name for path in PROGRAMS]


def test_a_file_that_lacks_something_is_refused(tmp_path):
    path = tmp_path / "01_x.md"
    path.write_text("## code\n\n```python\nprint(1)\n```\n\n## check\n\n00000000\n")
    with pytest.raises(ValueError, match="01_x.md: .*steps.* is missing"):
        read_lesson(path)


def test_programs_take_what_their_files_name():
    for program in PROGRAMS:
        taken = inspect.signature(steps_function(program)).parameters
        assert {parameter.name for parameter in texts_of(program).parameters} <= set(taken)


def test_the_teachers_page_has_the_answers_and_leads_to_the_solutions():
    for language in LANGUAGES:
        page = (SOLUTIONS.parent / language / "teacher.md").read_text("utf-8")
        rows = re.findall(
            r"^\| \[(.*?)\]\((\w+)\.md\) .*\| (\S+) \| \[.*?\]\((.*?)\) \|$", page, re.M
        )
        assert len(rows) == len(PROGRAMS)
        for (title, name, answer, solution), program in zip(rows, PROGRAMS, strict=True):
            texts = texts_of(program)
            assert (title, name) == (texts.title(language), program.stem)
            assert texts.is_right(answer)
            assert solution == f"../solutions/{program.name}"
            pupils = (SOLUTIONS.parent / language / f"{name}.md").read_text("utf-8")
            assert "solutions/" not in pupils and "teacher" not in pupils

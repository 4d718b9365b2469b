"""``engine3d learn``: which lessons there are, and what it shows, prints and writes."""

import re
from importlib.resources import files
from pathlib import Path

import pytest

from engine3d.apps.cli import main
from engine3d.apps.learn.learn_window import LearnWindow

pytestmark = pytest.mark.usefixtures("no_screen")
LESSONS = sorted(
    path for path in files("engine3d.lessons").iterdir() if re.match(r"\d\d_.*\.py$", path.name)
)


def test_the_list_has_every_lesson(capsys):
    assert main(["learn", "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(LESSONS) == 24
    assert all(re.fullmatch(r"\d+\. \w.*[^.]", line) for line in lines)


@pytest.mark.parametrize("name", ["3", "03", "lines", "03_lines"])
def test_a_lesson_is_found_by_number_and_name(name, capsys):
    assert main(["learn", name, "--path"]) == 0
    assert Path(capsys.readouterr().out.strip()).samefile(LESSONS[2])


@pytest.mark.parametrize(
    ("name", "hint"), [("99", ""), ("0", ""), ("linse", ": did you mean lines?")]
)
def test_others_are_not(name, hint, capsys):
    assert main(["learn", name]) == 2
    expected = f"engine3d: error: no lesson {name}{hint} (engine3d learn --list has them all)\n"
    assert capsys.readouterr().err == expected


@pytest.fixture(autouse=True)
def english(monkeypatch):
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", "en_GB.UTF-8")


def test_titles_are_in_the_language_of_the_locale(capsys, monkeypatch):
    assert main(["learn", "--list", "--language", "fr"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("1. Un modèle, ce sont des listes\n")
    monkeypatch.setenv("LANG", "fr_FR.UTF-8")
    assert main(["learn", "--list"]) == 0
    assert capsys.readouterr().out == said
    assert main(["learn", "--list", "--language", "en"]) == 0
    assert "A model is lists" in capsys.readouterr().out


def test_the_code_is_printed(capsys):
    assert main(["learn", "lines", "--code"]) == 0
    code = capsys.readouterr().out
    compile(code, "lines.py", "exec")
    assert code.startswith("def dda(")


@pytest.mark.parametrize(
    ("program", "status", "said"),
    [
        ("print('of', 101, 'lines', 50)", 0, "50: Right!\n"),
        ("print(50, 51)", 1, "51: Not yet: try again.\n"),
        ("print('many')", 1, "That is no number.\n"),
        ("1 / 0", 1, ""),
    ],
)
def test_a_program_of_ones_own_is_checked(program, status, said, tmp_path, capfd):
    (tmp_path / "mine.py").write_text(program)
    assert main(["learn", "lines", "--check", "mine.py"]) == status
    out, err = capfd.readouterr()
    assert out == said and ("ZeroDivisionError" in err) == (said == "")


def test_pictures_go_to_a_folder(tmp_path, capfd):
    assert main(["learn", "lists", "-o", "pictures"]) == 0
    assert (tmp_path / "pictures" / "01_lists.png").stat().st_size > 1000
    assert capfd.readouterr().out == f"{Path('pictures', '01_lists.png')}: 7 steps\n"
    english = (tmp_path / "pictures" / "01_lists.png").read_bytes()
    assert main(["learn", "lists", "-o", "images", "--language", "fr"]) == 0
    assert capfd.readouterr().out == f"{Path('images', '01_lists.png')}: 7 steps\n"
    assert (tmp_path / "images" / "01_lists.png").read_bytes() != english


def test_a_page_of_html_is_written_where_it_is_asked_for(tmp_path, capsys):
    assert main(["learn", "lists", "-o", "new/lesson.html", "--language", "fr"]) == 0
    page = (tmp_path / "new" / "lesson.html").read_text("utf-8")
    assert "<h1>1. Un modèle, ce sont des listes</h1>" in page
    assert capsys.readouterr() == ("", "")


def test_without_a_screen_the_lesson_is_written_as_html(tmp_path, capsys):
    assert main(["learn", "1"]) == 0
    (page,) = tmp_path.iterdir()
    assert page.suffix == ".html" and page.stem.startswith("01_lists")
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert err.startswith("engine3d: no screen") and f"writing the lesson to {page.name}" in err


def test_a_file_is_no_folder(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["learn", "1", "-o", "file"]) == 2
    assert "-o FOLDER or FILE.html: file is not a folder" in capsys.readouterr().err


def test_the_window_begins_with_the_lesson_that_is_asked_for(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    titles = []
    monkeypatch.setattr(LearnWindow, "run", lambda window: titles.append(window._window.title))
    assert main(["learn", "9"]) == 0
    assert main(["learn", "9", "--language", "fr"]) == 0
    assert titles == ["9. The y-buffer", "9. Le y-buffer"]

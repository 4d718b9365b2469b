"""``engine3d learn``: which lessons there are, and what it shows and writes."""

import re
from pathlib import Path

import pytest

from engine3d.cli import learn, main
from engine3d.viewer.lesson_window import LessonWindow

pytestmark = pytest.mark.usefixtures("no_screen")
LESSONS = sorted((Path(__file__).resolve().parents[2] / "lessons").glob("[0-9][0-9]_*.py"))


def test_the_list_has_every_lesson(capsys):
    assert main(["learn", "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(LESSONS) == 24
    assert all(re.fullmatch(r"[ \d]\d\. \w.*[^.]", line) for line in lines)


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


def test_pictures_go_to_a_folder(tmp_path, capfd):
    assert main(["learn", "lists", "-o", "pictures"]) == 0
    assert (tmp_path / "pictures" / "01_lists.png").stat().st_size > 1000
    assert capfd.readouterr().out == "pictures/01_lists.png: 7 steps\n"


def test_without_a_screen_it_says_what_else_to_do(capsys):
    assert main(["learn", "2"]) == 1
    assert "-o FOLDER writes the pictures" in capsys.readouterr().err


def test_the_window_shows_the_steps(monkeypatch):
    """On SDL's dummy driver: the first lesson is the one asked for, and all can be gone through."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    seen = []

    def run(window):
        window._go_on()
        seen.append((window._window.title, window._number, window._step, len(window._lessons)))
        picture = window._steps[window._step]
        seen.append((picture.shape[2], picture.std() > 1.0))
        window._show()
        seen.append(window._window.title)

    monkeypatch.setattr(LessonWindow, "run", run)
    assert main(["learn", "9"]) == 0
    title = learn.title_of(LESSONS[8]).strip()
    assert seen[0] == (title, 8, 1, 24) and seen[1] == (4, True)
    assert seen[2].startswith(f"{title} - step 2")

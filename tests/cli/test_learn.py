"""``engine3d learn``: which lessons there are, and what it shows and writes."""

import re
from pathlib import Path

import pytest

from engine3d.apps.cli import main
from engine3d.apps.cli.commands import french_lessons, learn
from engine3d.apps.viewer.lesson_window import LessonWindow

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


@pytest.fixture(autouse=True)
def english(monkeypatch):
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", "en_GB.UTF-8")


def test_french_titles_are_those_of_the_pages(capsys, monkeypatch):
    pages = LESSONS[0].parents[1] / "docs" / "course" / "fr"
    headings = [(pages / f"{lesson.stem}.md").read_text("utf-8") for lesson in LESSONS]
    titles = [f"{heading.splitlines()[0].lstrip('# '):}" for heading in headings]
    assert main(["learn", "--list", "--language", "fr"]) == 0
    said = capsys.readouterr().out
    assert [line.strip() for line in said.splitlines()] == titles
    monkeypatch.setenv("LANG", "fr_FR.UTF-8")
    assert main(["learn", "--list"]) == 0
    assert capsys.readouterr().out == said
    assert main(["learn", "--list", "--language", "en"]) == 0
    assert "A model is lists" in capsys.readouterr().out


def test_numbers_of_a_caption_stay_in_their_order():
    caption = "forward, 256 lights: 40188 shadings instead of 19200; 0 pixels differ"
    french = (
        "direct, 256 lumières : 40188 calculs d'éclairage au lieu de 19200 ; 0 pixels diffèrent"
    )
    assert french_lessons.caption_in_french(caption) == french
    at = french_lessons.caption_in_french("after 44 steps, at (1.9, -2.5)")
    assert at == "après 44 pas, en (1.9, -2.5)"
    assert french_lessons.caption_in_french("something else") == "something else"


def test_french_texts_have_glyphs_and_as_many_numbers():
    letters = set(map(chr, range(32, 127))) | set("àâçèéêëîïôùûœÀÇÉ")
    for english, french in french_lessons.CAPTIONS.items():
        assert set(french) <= letters, french
        assert english.count("{}") == french.count("{}"), english


@pytest.mark.slow
@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_every_caption_is_known_in_french(lesson):
    for caption, *_ in learn.steps_of(lesson):
        assert french_lessons._NUMBER.sub("{}", caption) in french_lessons.CAPTIONS, caption


def test_pictures_go_to_a_folder(tmp_path, capfd):
    assert main(["learn", "lists", "-o", "pictures"]) == 0
    assert (tmp_path / "pictures" / "01_lists.png").stat().st_size > 1000
    assert capfd.readouterr().out == "pictures/01_lists.png: 7 steps\n"
    english = (tmp_path / "pictures" / "01_lists.png").read_bytes()
    assert main(["learn", "lists", "-o", "images", "--language", "fr"]) == 0
    assert capfd.readouterr().out == "images/01_lists.png: 7 steps\n"
    assert (tmp_path / "images" / "01_lists.png").read_bytes() != english


def test_without_a_screen_it_says_what_else_to_do(capsys):
    assert main(["learn", "2"]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("engine3d: error: no screen") and err.count("\n") == 1
    assert "-o FOLDER writes the pictures" in err


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
    title = learn.title_of(LESSONS, 8).strip()
    assert seen[0] == (title, 8, 1, 24) and seen[1] == (4, True)
    assert seen[2].startswith(f"{title} - step 2")
    assert main(["learn", "9", "--language", "fr"]) == 0
    assert seen[3][0] == "9. Le y-buffer"
    assert seen[5] == "9. Le y-buffer - étape 2 - flèches : étapes, N P : leçons"

"""Three views of a lesson: as a picture, as lines of text, as HTML. Each has all of its texts."""

import base64
import html
import io
import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

from engine3d.apps.learn.course_session import Session
from engine3d.apps.learn.lesson_programs import find_programs, steps_of, texts_of
from engine3d.apps.learn.page_html import lesson_html
from engine3d.apps.learn.page_picture import (
    ACCENT,
    INK,
    PAPER,
    QUIET,
    beside_or_below,
    draw_page,
    enlarged,
)
from engine3d.apps.learn.page_text import text_page

PROGRAMS = find_programs()
SIZE = (1240, 720)


def plain(lines):
    """Lines without codes; one that goes to a column leaves a gap."""
    shown = [re.sub(r"\x1b\[[0-9;]*m", "", line) for line in lines]
    return [re.sub(r"\x1b\[\d+G", "  ", line) for line in shown]


def words(text):
    return re.sub(r"\*\*|`", "", text).split()


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_picture_fills_its_part_and_the_code_is_marked(language):
    session = Session(PROGRAMS, 2, language)
    session.draw_all()
    session.press("Right")
    page = draw_page(session, SIZE)
    assert page.pixels.shape == (720, 1240, 4) and page.overflow == 0
    drawn = np.argwhere((page.pixels[40:560, :640, :3] != PAPER).any(axis=2))
    assert (drawn.max(axis=0) - drawn.min(axis=0))[1] > 560
    other = draw_page(session, SIZE).pixels
    assert (page.pixels == other).all()
    session.press("Right")
    after = draw_page(session, SIZE).pixels
    assert (page.pixels[150:500, 650:] != after[150:500, 650:]).any()


def test_the_mouse_changes_values_and_goes_to_the_next_lesson():
    session, copied = Session(PROGRAMS, 2, "en"), []
    session.press("End")
    page = draw_page(session, SIZE, copy=lambda: copied.append(1))
    boxes = [box for box, _ in page.places]
    assert len(boxes) == 4  # two arrows, what comes next, the code
    for left, top, right, bottom in boxes:
        assert 0 <= left < right <= SIZE[0] and 0 <= top < bottom <= SIZE[1]
    assert page.press(*[side + 2 for side in boxes[1][:2]])
    assert session.values == {"directions": 24}
    assert page.press(*[side + 2 for side in boxes[3][:2]]) and copied == [1]
    assert page.press(*[side + 2 for side in boxes[2][:2]])
    assert session.title == "4. Wireframe"
    assert not page.press(1, 1)


def test_a_low_window_moves_its_texts():
    session = Session(PROGRAMS, 0, "fr")
    page = draw_page(session, (1000, 400))
    moved = draw_page(session, (1000, 400), scroll=page.overflow)
    assert page.overflow > 5 and moved.overflow == page.overflow
    assert (page.pixels != moved.pixels).any()


@pytest.mark.parametrize("size", [(64, 64), (300, 200), (3000, 2000)])
@pytest.mark.parametrize("scale", [0.5, 1.0, 1.5, 4.0])
def test_a_page_has_any_size(size, scale):
    for number in (0, 9):
        session = Session(PROGRAMS, number, "en")
        assert draw_page(session, size, scale).pixels.shape == (size[1], size[0], 4)


def test_letters_grow_with_the_window():
    session = Session(PROGRAMS, 2, "en")
    small, large = (draw_page(session, size).pixels for size in (SIZE, (2480, 1440)))
    assert (large[1440 - 40 :, :2480, :3] == QUIET).all(axis=2).sum() > 100
    heads = [(pixels[:40, :400, :3] == ACCENT).all(axis=2) for pixels in (small, large)]
    widths = [np.flatnonzero(head.any(axis=0)).max() for head in heads]
    assert 1.8 < widths[1] / widths[0] < 2.4


def test_help_and_the_end_are_pages():
    session = Session(PROGRAMS, 23, "en")
    step = draw_page(session, SIZE).pixels
    session.press("H")
    keys = draw_page(session, SIZE).pixels
    session.press("H")
    session.press("N")
    end = draw_page(session, SIZE).pixels
    assert (step != keys).any() and (keys != end).any()
    assert (end[40:300, :600, :3] == INK).all(axis=2).sum() > 100


@pytest.mark.parametrize("factor", [0.5, 1.0, 1.7, 3.0])
def test_pictures_are_enlarged_by_any_factor(factor):
    picture = np.zeros((20, 30, 3), np.uint8)
    picture[:, 15:] = 200
    large = enlarged(picture, factor)
    assert large.shape == (int(20 * factor), int(30 * factor), 3)
    assert (large[:, : int(15 * factor) - 1] == 0).all()
    assert (large[:, int(15 * factor) + 1 :] == 200).all()


def test_pictures_stand_as_they_are_largest():
    wide, high = np.zeros((10, 40, 3), np.uint8), np.zeros((40, 10, 3), np.uint8)
    assert beside_or_below([wide, wide], (400, 400), 0).shape == (200, 400, 3)
    assert beside_or_below([high, high], (400, 400), 0).shape == (400, 200, 3)


@pytest.mark.parametrize("language", ["en", "fr"])
def test_a_terminal_gets_the_same_texts(language):
    session = Session(PROGRAMS, 2, language)
    session.draw_all()
    lines, overflow = text_page(session, (100, 60), 0)
    text = " ".join(plain(lines))
    texts = session.texts
    assert len(lines) == 60 and overflow == 0
    for section in ("idea", "exercise"):
        assert all(word in text for word in words(texts.texts[section, language]))
    assert all(line in text for line in texts.code)
    assert session.step.caption in text and session.place in lines[0]


def test_a_low_terminal_moves_its_lines():
    session = Session(PROGRAMS, 0, "fr")
    lines, overflow = text_page(session, (80, 24), 0)
    moved, _ = text_page(session, (80, 24), overflow)
    assert len(lines) == len(moved) == 24 and overflow > 10
    assert "Votre réponse" in "".join(plain(moved)) and "Votre réponse" not in "".join(plain(lines))


@pytest.fixture(scope="module", params=["en", "fr"])
def page(request):
    return request.param, lesson_html(PROGRAMS[2], request.param)


def test_html_holds_pictures_code_and_exercise(page):
    language, text = page
    assert not re.findall(r"(?:src|href)=\"(?!data:)", text) and "http" not in text
    texts = texts_of(PROGRAMS[2])
    body = html.unescape(re.sub(r"<[^>]+>", "", text))
    assert all(line in body for line in texts.code)
    for section in ("idea", "exercise"):
        assert all(word in body for word in words(texts.texts[section, language]))
    steps = list(steps_of(PROGRAMS[2], language))
    figures = re.findall(r'<figure data-variant="" data-marked="(\d+)-(\d+)">(.*?)</figure>', text)
    assert len(figures) == len(steps)
    for step, (start, end, figure) in zip(steps, figures, strict=True):
        assert (int(start), int(end)) == (step.marked.start, step.marked.stop)
        assert html.escape(step.caption) in figure
        data = re.search(r"base64,([^\"]+)", figure)[1]
        with Image.open(io.BytesIO(base64.b64decode(data))) as image:
            assert (np.asarray(image) == step.shown[0]).all()


def test_html_has_every_value_of_the_parameter(page):
    _, text = page
    variants = set(re.findall(r'data-variant="(.*?)"', text))
    assert variants == {"", "directions=8", "directions=24", "directions=32"}
    assert set(re.findall(r'<option value="(.*?)"', text)) == variants
    assert " selected>16<" in text


@pytest.mark.skipif(shutil.which("node") is None, reason="needs node")
def test_html_checks_the_answer_as_the_window_does(page):
    _, text = page
    data = json.loads(re.search(r"^const data = (.*);$", text, re.M)[1])
    function = re.search(r"^function hash.*?^}", text, re.M | re.S)[0]
    script = f"{function}; console.log(hash('{data['name']}:50'), hash('{data['name']}:51'))"
    done = subprocess.run(["node", "-e", script], capture_output=True, text=True, check=True)
    right, wrong = map(int, done.stdout.split())
    assert right == data["check"] != wrong
    assert ">50<" not in text


@pytest.mark.skipif(shutil.which("node") is None, reason="needs node")
def test_the_script_of_html_is_one(page, tmp_path):
    _, text = page
    (tmp_path / "page.js").write_text(re.search(r"<script>(.*)</script>", text, re.S)[1], "utf-8")
    subprocess.run(["node", "--check", tmp_path / "page.js"], check=True)

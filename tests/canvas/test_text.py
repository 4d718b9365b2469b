"""Text of the canvas: the font's sheet, scale, lines, clipping, backgrounds."""

import re
import unicodedata
from pathlib import Path

import numpy as np
import pytest

from engine3d.errors import InvalidArgumentError
from engine3d.rendering.canvas import Canvas, text_size

WHITE = (255, 255, 255)
PRINTABLE = "".join(chr(code) for code in range(32, 127))
FRENCH = "àâçèéêëîïôùûœÀÇÉ"
SHEET = Path(__file__).parents[2] / "csrc" / "extras" / "canvas" / "font.c"


def drawn(string, width=None, height=None, at=(0, 0), **style):
    columns, rows = text_size(string, style.get("scale", 1))
    canvas = Canvas((width or columns, height or rows))
    canvas.text(*at, string, WHITE, **style)
    return canvas.pixels[..., 0] > 0


def sheet_glyphs():
    """The glyphs of the sheet in font.c, in the order of their codes: (112, 14, 8) of bool."""
    rows = re.findall(r'^ {8}"([#. ]+)",$', SHEET.read_text("utf-8"), re.MULTILINE)
    bands = np.array([list(row + " ") for row in rows]).reshape(-1, 14, 8, 9)
    return (bands.transpose(0, 2, 1, 3) == "#").reshape(-1, 14, 9)[..., :8]


def test_every_glyph_is_the_sheet_s():
    glyphs = sheet_glyphs()
    assert glyphs.shape == (112, 14, 8)
    for code, glyph in zip(range(32, 127), glyphs, strict=False):
        assert np.array_equal(drawn(chr(code)), glyph), chr(code)
    for letter, glyph in zip(FRENCH, glyphs[96:], strict=True):
        assert np.array_equal(drawn(letter), glyph), letter


@pytest.mark.parametrize("letter", FRENCH.replace("œ", ""))
def test_a_letter_with_an_accent_is_the_letter_and_a_mark_apart_from_it(letter):
    plain = drawn(unicodedata.normalize("NFD", letter)[0])
    accented = drawn(letter)
    body = slice(2, 11) if letter.isupper() else slice(5, 11)
    assert np.array_equal(accented[body], plain[body])
    assert (accented != plain).any() and not accented[:, 7].any()


def test_glyphs_differ_and_only_space_is_empty():
    glyphs = [drawn(character) for character in PRINTABLE + FRENCH + "\u00bf"]
    assert len({glyph.tobytes() for glyph in glyphs}) == 112
    assert [glyph.any() for glyph in glyphs] == [False] + [True] * 111


def test_glyphs_stand_on_one_line_apart_from_each_other():
    for character in PRINTABLE:
        glyph = drawn(character)
        if character.isalnum():
            assert not glyph[:2].any() and not glyph[:, 7].any()
            assert glyph[10].any() and (not glyph[11:].any() or character in "Qgjpqy")
    assert all(drawn(character)[11:].any() for character in "gjpqy")


@pytest.mark.parametrize(
    "other", ["\u00f1", "\x80", "\x8f", "\u2713", "\U0001f600", "\x00", "\x7f", "\r", "\udc80"]
)
def test_other_characters_show_one_hollow_box(other):
    assert np.array_equal(drawn(other), sheet_glyphs()[95])


@pytest.mark.parametrize("scale", [2, 3, 7])
def test_scale_makes_squares(scale):
    squares = np.ones((scale, scale), bool)
    assert np.array_equal(drawn("Rg%\n@", scale=scale), np.kron(drawn("Rg%\n@"), squares))


def test_lines_and_tabs():
    text = drawn("ab\nc")
    assert np.array_equal(text[:14, :8], drawn("a")) and np.array_equal(text[:14, 8:], drawn("b"))
    assert np.array_equal(text[14:, :8], drawn("c")) and not text[14:, 8:].any()
    assert np.array_equal(drawn("a\tb"), drawn("a   b"))


def test_text_size():
    assert text_size("") == (0, 14)
    assert text_size("abc") == (24, 14)
    assert text_size("abc\nabcde\n", 2) == (80, 84)


def test_position_is_the_pixel_that_holds_it():
    here = drawn("x", 30, 30, at=(5, 6))
    assert np.array_equal(here, drawn("x", 30, 30, at=(5.9, 6.9)))
    assert np.array_equal(here[6:20, 5:13], drawn("x"))


def test_clipped_text_is_the_whole_text_inside():
    whole = drawn("Clipped\ntext", scale=2)
    for x in range(-20, 30, 3):
        part = drawn("Clipped\ntext", 40, 30, at=(-x, -7), scale=2)
        expected = np.zeros((30, 40), bool)
        shown = whole[7:37, max(x, 0) : x + 40]
        expected[:, max(-x, 0) :][:, : shown.shape[1]] = shown
        assert np.array_equal(part, expected)


@pytest.mark.parametrize("text", [5, b"text", None])
def test_what_is_no_text(text):
    with pytest.raises(InvalidArgumentError, match="string must be a str"):
        Canvas((9, 9)).text(0, 0, text, WHITE)
    with pytest.raises(InvalidArgumentError, match="string must be a str"):
        text_size(text)


@pytest.mark.parametrize("at", [(np.nan, 0), (0, np.inf), (1e300, 0), (0, -1e300), (-(2**31), 5)])
def test_hostile_positions_draw_nothing(at):
    canvas = Canvas((30, 30))
    canvas.text(*at, "text" * 100, WHITE, scale=4096, background=(9, 9, 9))
    assert not canvas.pixels[..., 0].any()


def test_translucent_text_is_even():
    canvas = Canvas((200, 30))
    canvas.text(0, 0, PRINTABLE[:12], (255, 255, 255, 100), scale=2)
    assert set(np.unique(canvas.pixels[..., 0])) == {0, 100}


def test_background_is_a_box_around_the_cells():
    canvas = Canvas((60, 60))
    canvas.text(10, 12, "ab\nc", WHITE, scale=1, background=(0, 0, 200))
    blue = canvas.pixels[..., 2] > 0
    rows, columns = np.flatnonzero(blue.any(axis=1)), np.flatnonzero(blue.any(axis=0))
    assert (rows[0], rows[-1], columns[0], columns[-1]) == (10, 12 + 28 + 1, 8, 10 + 16 + 1)
    assert blue[10:42, 8:28].all()
    canvas.clear()
    canvas.text(10, 12, "", WHITE, background=(0, 0, 200))
    assert not canvas.pixels[..., 2].any()

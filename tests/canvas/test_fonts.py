"""Fonts of outlines: their alphas beside exact areas, layout, lines that fit, what they lack."""

import copy
import math
import pickle
from importlib.resources import files
from threading import Thread

import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont

import engine3d as e3d
from engine3d.errors import InvalidArgumentError
from engine3d.rendering.fonts.font import _read

FACES = ("sans", "mono")
#: A size at which small letters are a whole number of pixels high: 67.
EXACT = 125
CHARACTERS = "agkxQR&@08%ÀéœßñŁΩπЖяё≤→²µ…“"


def drawn(string, font, at=(0, 0), size=None, color=(255, 255, 255)):
    width, height = size or font.text_size(string)
    canvas = e3d.Canvas((width, height))
    canvas.text(*at, string, color, font=font)
    return canvas.pixels[..., 0].astype(int)


def by_freetype(character, face, width, height, baseline):
    """The alphas of a glyph by Pillow's FreeType, without hints, its origin at (40, baseline)."""
    path = files("engine3d.data") / "fonts" / f"{face}.ttf"
    font = ImageFont.truetype(str(path), EXACT, layout_engine=ImageFont.Layout.BASIC)
    picture = Image.new("L", (width, height))
    ImageDraw.Draw(picture).text((40, baseline), character, 255, font, "ls")
    return np.asarray(picture).astype(int)


@pytest.mark.parametrize("face", FACES)
def test_characters_look_as_freetype_draws_them(face):
    """FreeType's hints move stems by half a pixel; another glyph differs by 10 and more."""
    font, size = e3d.Font(face, EXACT), (220, 200)
    for character in CHARACTERS:
        ours = drawn(character, font, (40, 0), size)
        if face == "sans" and character in "≤→":  # Noto Sans lacks them
            assert np.array_equal(ours, drawn(character, e3d.Font("mono", EXACT), (40, 0), size))
            continue
        apart = np.abs(ours - by_freetype(character, face, *size, round(0.97 * EXACT)))
        assert ours.any() and apart.mean() < 2.5, (character, apart.mean())
        if character == "x":  # no hints move it: corners at whole pixels
            assert apart.max() <= 1


def crossings(outline, scale, y):
    """Where a row crosses an outline's curves: (x, winding), exactly but for floats."""
    found, first = [], 0
    for end in outline.ends.tolist():
        points = (outline.points[first:end] * scale).tolist()
        flags = outline.on_curve[first:end].tolist()
        first = end
        ring = []
        for k, (point, flag) in enumerate(zip(points, flags, strict=True)):
            if not flag and not flags[k - 1]:
                ring.append((np.mean([points[k - 1], point], axis=0), 1))
            ring.append((np.array(point), flag))
        start = next(k for k, (_, flag) in enumerate(ring) if flag)
        ring = ring[start:] + ring[:start] + [ring[start]]
        k = 0
        while k + 1 < len(ring):
            step = 1 if ring[k + 1][1] else 2
            a, b = ring[k][0], ring[k + step][0]
            control = ring[k + 1][0] if step == 2 else (a + b) / 2
            found += curve_crossings(a, control, b, y)
            k += step
    return sorted(found)


def curve_crossings(a, control, b, y):
    square, linear, constant = a - 2 * control + b, 2 * (control - a), a - (0, y)
    roots = solve(float(square[1]), float(linear[1]), float(constant[1]))
    return [
        (square[0] * t * t + linear[0] * t + a[0], 1 if 2 * square[1] * t + linear[1] > 0 else -1)
        for t in roots
        if 0 <= t < 1
    ]


def solve(square, linear, constant):
    """The real roots of a quadratic."""
    if abs(square) < 1e-9:
        return [-constant / linear] if linear else []
    inner = linear * linear - 4 * square * constant
    root = math.sqrt(max(inner, 0.0))
    return [(-linear - root) / (2 * square), (-linear + root) / (2 * square)] if inner > 0 else []


def exact_alphas(outline, scale, left, baseline, size, rows_a_pixel=32):
    """Coverage of pixels: filled between crossings where the winding is not 0."""
    width, height = size
    cover = np.zeros((height, width))
    edges = np.arange(width + 1.0)
    for row in range(height * rows_a_pixel):
        y = baseline - (row + 0.5) / rows_a_pixel
        winding, begun = 0, 0.0
        for x, sign in crossings(outline, scale, y):
            if winding == 0:
                begun = x + left
            winding += sign
            if winding == 0:
                inside = np.clip(edges, begun, x + left)
                cover[row // rows_a_pixel] += np.diff(inside)
    return 255 * cover / rows_a_pixel


@pytest.mark.parametrize(("face", "size"), [("sans", 15), ("mono", 22.5)])
@pytest.mark.parametrize("character", "gR@é")
def test_alphas_are_the_shares_of_pixels_that_curves_enclose(face, size, character):
    font, source = e3d.Font(face, size), _read(face)
    high = round(source.x_height * size / source.units_per_em)
    scale = np.array([size / source.units_per_em, high / source.x_height])
    outline = source.outline(source.glyphs[ord(character)])
    box = 28, 30
    exact = exact_alphas(outline, scale, 6.25, round(0.97 * size), box)
    ours = drawn(character, font, (6.25, 0), box)
    assert np.abs(ours - exact).max() <= 6 and ours.max() > 150
    assert np.abs(ours - exact)[exact > 0].mean() < 1.5


@pytest.mark.parametrize("face", FACES)
@pytest.mark.parametrize("size", [11, 12.5, 13, 15, 16, 23.4])
def test_small_letters_are_sharp_above_and_below(face, size):
    font = e3d.Font(face, size)
    rows = np.flatnonzero(drawn("xzvxz", font, (2, 0)).max(axis=1))
    assert rows[-1] == round(0.97 * font.size) - 1
    assert len(rows) == max(round(0.536 * font.size), 1)


@pytest.mark.parametrize("face", FACES)
def test_every_glyph_lies_within_its_line(face):
    font = e3d.Font(face, 20)
    for code in [*range(33, 127), *range(0xA1, 0x100), *range(0x391, 0x3CF), *range(0x400, 0x460)]:
        character = chr(code)
        if character in "΢\xad":
            continue
        whole = drawn(character, font, (40, 40), (120, 120))
        assert whole.any(), hex(code)
        assert not whole[:38].any() and not whole[40 + font.line_height + 1 :].any(), hex(code)


def test_glyphs_are_as_wide_as_the_sum_of_their_advances():
    sans, mono = e3d.Font("sans", 15), e3d.Font("mono", 15)
    assert sans.width("ii") < sans.width("MM")
    assert (
        abs(sans.width("Mi" * 50) - 50 * (sans.width("M" * 100) + sans.width("i" * 100)) / 100) <= 1
    )
    assert mono.width("iiii") == mono.width("MMMM") == 4 * 9
    assert sans.width("0000") == sans.width("1897")
    assert sans.text_size("ab\nc") == (sans.width("ab"), 2 * sans.line_height)
    assert sans.width("") == 0 and sans.width("a\tb") == sans.width("a   b")


def test_lines_stand_below_each_other():
    font = e3d.Font("sans", 17)
    both = drawn("Ag\nBj", font, (3, 0), (60, 60))
    assert np.array_equal(
        both[: font.line_height], drawn("Ag", font, (3, 0), (60, font.line_height))
    )
    below = drawn("Bj", font, (3, 0), (60, 60 - font.line_height))
    assert np.array_equal(both[font.line_height :], below)


def test_origins_lie_at_quarters_of_a_pixel():
    font = e3d.Font("sans", 14)
    pictures = [drawn("k", font, (5 + k / 16, 3), (30, 30)) for k in range(17)]
    kinds = [0, 0, *[1] * 4, *[2] * 4, *[3] * 4, 4, 4, 4]
    for picture, kind in zip(pictures, kinds, strict=True):
        assert np.array_equal(picture, pictures[kind * 4])
    assert np.array_equal(pictures[16][:, 1:], pictures[0][:, :-1])
    assert len({picture.tobytes() for picture in pictures}) == 5


def test_clipped_text_is_the_whole_text_inside():
    font = e3d.Font("mono", 21)
    whole = drawn("Clipped\ntext", font)
    for x in range(-40, 60, 7):
        part = drawn("Clipped\ntext", font, (x, -7), (50, 30))
        padded = np.zeros((200, 400), int)
        padded[: whole.shape[0], 100 : 100 + whole.shape[1]] = whole
        assert np.array_equal(part, padded[7:37, 100 - x : 150 - x])


def test_alphas_multiply_the_colour_s():
    font = e3d.Font("sans", 40)
    whole = drawn("Sg", font)
    half = drawn("Sg", font, color=(255, 255, 255, 128))
    assert np.array_equal(half, (2 * 128 * whole + 255) // 510)


@pytest.mark.parametrize("character", ["\U0001f600", "漢", "\x00", "\udc80", "\u0378"])
def test_what_the_fonts_lack_shows_one_box(character):
    for face in FACES:
        font = e3d.Font(face, 24)
        assert np.array_equal(drawn(character, font), drawn("\U000f0000", font))
        assert drawn(character, font).any()


def test_characters_that_no_font_has_share_one_picture():
    font = e3d.Font("sans", 60)
    font.width("".join(map(chr, range(0x4E00, 0x4F00))))
    assert font._glyphs.count == 1
    assert font.fitted("x" * 100_000, 200).endswith("x…")


def test_a_font_made_before_draws_the_same():
    used, fresh = e3d.Font("sans", 19), e3d.Font("sans", 19)
    used.width("zyxwvutsrqponmlkjihgfedcba")
    assert np.array_equal(drawn("badge", used), drawn("badge", fresh))


def test_threads_share_a_font():
    font, shown = e3d.Font("sans", 15), []
    texts = ["".join(chr(33 + (k * j) % 90) for j in range(40)) for k in range(1, 9)]

    def draw(text):
        shown.append((text, drawn(text, font)))

    threads = [Thread(target=draw, args=(text,)) for text in texts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for text, picture in shown:
        assert np.array_equal(picture, drawn(text, e3d.Font("sans", 15)))


@pytest.mark.parametrize("width", range(1, 300, 23))
def test_lines_that_fit(width):
    font = e3d.Font("sans", 14)
    text = "How a frame is drawn: triangles, then\npixels, andaverylongwordthatfitsnowhere at all"
    lines = font.wrapped(text, width)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "").replace("\n", "")
    assert all(font.width(line) <= width or len(line) == 1 for line in lines)
    short = font.fitted(text.split("\n")[0], width)
    assert font.width(short) <= width
    assert short in ("", text.split("\n")[0]) or short.endswith("…")


def test_backgrounds_have_the_text_s_size():
    font = e3d.Font("sans", 16)
    canvas = e3d.Canvas((120, 80))
    canvas.text(10, 12, "ab\nc", "white", font=font, background=(0, 0, 200))
    rows, columns = (np.flatnonzero((canvas.pixels[..., 2] > 0).any(axis=k)) for k in (1, 0))
    width, height = font.text_size("ab\nc")
    assert (rows[0], rows[-1]) == (10, 12 + height + 1)
    assert (columns[0], columns[-1]) == (8, 10 + width + 1)


@pytest.mark.parametrize("at", [(np.nan, 0), (0, np.inf), (1e300, 0), (0, -1e300), (-(2**31), 5)])
def test_hostile_positions_draw_nothing(at):
    canvas = e3d.Canvas((30, 30))
    canvas.text(*at, "text" * 100, "white", font=e3d.Font("sans", 512))
    assert not canvas.pixels[..., 0].any()


@pytest.mark.parametrize("size", [3.9, 513, np.nan, "12", None, -5])
def test_sizes_that_no_font_has(size):
    with pytest.raises(InvalidArgumentError, match="size|number"):
        e3d.Font("sans", size)


def test_wrong_fonts_are_told():
    canvas = e3d.Canvas((30, 30))
    with pytest.raises(InvalidArgumentError, match='"sans"|sans'):
        e3d.Font("serif", 12)
    with pytest.raises(InvalidArgumentError, match="font must be a Font"):
        canvas.text(0, 0, "a", "white", font="sans")
    with pytest.raises(InvalidArgumentError, match="without a scale"):
        canvas.text(0, 0, "a", "white", font=e3d.Font("sans", 12), scale=2)


def test_fonts_are_copied_by_face_and_size():
    font = e3d.Font("mono", 12.3)
    for other in (copy.copy(font), copy.deepcopy(font), pickle.loads(pickle.dumps(font))):
        assert (other.face, other.size) == (font.face, font.size) == ("mono", 787 / 64)
        assert np.array_equal(drawn("copied", other), drawn("copied", font))


@pytest.mark.parametrize("width", range(80, 400, 20))
def test_no_line_begins_or_ends_within_french_signs(width):
    text = "Voici : « le moteur » ; que reste-t-il ? 3 % ! Rien, ni « lui », ni « elle »."
    lines = e3d.Font("sans", 14).wrapped(text, width)
    assert " ".join(lines) == text
    assert all(line[0] not in ":;?!%»" and line[-1] != "«" for line in lines)
    assert e3d.Font("sans", 14).wrapped("moteur » et", 50) == ["moteur", "» et"]

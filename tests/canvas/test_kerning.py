"""Kerning: pairs of the original face, other programs' widths, sums of advances, caret places."""

import itertools
import random
from importlib.resources import files

import numpy as np
import pytest
from PIL import ImageFont, features

import engine3d as e3d
from engine3d.rendering.fonts.font import _read

#: As NotoSans-Regular.ttf 2.004 has them in its GPOS table, in 1/1000 em.
ORIGINAL = {
    "AV": -40,
    "VA": -40,
    "AT": -70,
    "To": -70,
    "Ty": -20,
    "T.": -60,
    "L'": -80,
    "L’": -80,
    "LT": -20,
    "r.": -160,
    "P,": -130,
    "Р.": -130,
    "Γα": -70,
    "f)": 40,
    "f”": 60,
    "—T": -40,
    "d'": 0,
    "11": 0,
    "7.": 0,
    "4°": 0,
    "A ": 0,
    " V": 0,
}
SIZES = (11, 14.3, 16, 64, 512)
FACE = _read("sans")
#: Characters of both faces, some with more pairs than others, and ends of words.
LETTERS = "AVTLYPWFKvoyera.,'”—-() 17ΓαΡРТУа→≤éÀÖœ"
TEXTS = [
    "".join(random.Random(seed).choices(LETTERS, k=random.Random(-seed).randrange(2, 40)))
    for seed in range(40)
]


def kerning(first, second):
    """The kerning of two characters of the face, in units."""
    pairs, (a, b) = FACE.kerning, (FACE.glyphs.get(ord(c)) for c in (first, second))
    return 0 if a is None or b is None else int(pairs.values[pairs.rows[a] + pairs.columns[b]])


def in_parts(units, size):
    """Units of the font in 1/256 pixel, the nearest, halves up."""
    return (2 * units * round(size * 64) * 4 + 1000) // 2000


def places(text, size):
    """Where each character of a line begins, and where it ends, in 1/256 pixel."""
    steps = []
    for first, second in itertools.pairwise([*text, None]):
        glyph = FACE.glyphs.get(ord(first))
        face, glyph = (FACE, glyph) if glyph else (_read("mono"), _read("mono").glyphs[ord(first)])
        steps.append(in_parts(face.advance(glyph), size))
        steps[-1] += in_parts(kerning(first, second), size) if second else 0
    return [0, *itertools.accumulate(steps)]


@pytest.mark.parametrize("pair", ORIGINAL)
def test_pairs_are_those_of_the_original_face(pair):
    assert kerning(*pair) == ORIGINAL[pair]
    # In pixels at 512: within the rounding of three widths.
    font = e3d.Font("sans", 500)
    apart = font.width(pair) - font.width(pair[0]) - font.width(pair[1])
    assert abs(apart - ORIGINAL[pair] / 2) <= 2


def test_thousands_of_pairs_are_kerned_accented_letters_too():
    assert kerning("T", "ö") < 0 and kerning("À", "V") == kerning("A", "V")
    pairs = FACE.kerning
    assert np.count_nonzero(pairs.values[pairs.rows[:, None] + pairs.columns]) > 5000


@pytest.mark.skipif(not features.check("raqm"), reason="this Pillow has no HarfBuzz")
def test_widths_of_pairs_are_harfbuzz_s():
    path = str(files("engine3d.data") / "fonts" / "sans.ttf")
    shaped = ImageFont.truetype(path, FACE.units_per_em, layout_engine=ImageFont.Layout.RAQM)
    marks = "\"'.,;:-()[]“”’«»?!"
    letters = [c for c in map(chr, FACE.glyphs) if c.isalpha()]
    scripts = [
        [c for c in letters if low <= ord(c) < high]
        for low, high in ((0, 0x370), (0x370, 0x400), (0x400, 0x500))
    ]
    pairs = list(ORIGINAL)
    for script in scripts:  # which HarfBuzz never mixes
        random_ones = random.Random(3).choices([*script, *marks], k=2000)
        pairs += map("".join, itertools.pairwise(random_ones))
    kerned = 0
    for a, b in pairs:
        apart = shaped.getlength(a + b) - sum(FACE.advance(FACE.glyphs[ord(c)]) for c in (a, b))
        assert apart == kerning(a, b), (a, b)
        kerned += apart != 0
    assert kerned > 30


@pytest.mark.parametrize("size", SIZES)
def test_widths_are_sums_of_what_the_pen_moves(size):
    font = e3d.Font("sans", size)
    for text in TEXTS:
        assert font.width(text) == -(-places(text, size)[-1] // 256), text


@pytest.mark.parametrize("size", [11, 16, 23.4])
def test_texts_are_drawn_where_they_are_measured(size):
    font = e3d.Font("sans", size)
    for text in TEXTS:
        whole, letters = (e3d.Canvas((font.width(text) + 20, 2 * font.line_height)) for _ in "ab")
        whole.text(3.25, 2, text, "white", font=font)
        for character, place in zip(text, places(text, size), strict=False):
            letters.text(3.25 + place / 256, 2, character, "white", font=font)
        assert np.array_equal(whole.pixels, letters.pixels), text


def test_no_pair_spans_lines_or_faces():
    font = e3d.Font("sans", 40)
    broken, apart = (e3d.Canvas((80, 120)) for _ in "ab")
    broken.text(4, 0, "A\nV\nA", "white", font=font)
    for line, character in enumerate("AVA"):
        apart.text(4, line * font.line_height, character, "white", font=font)
    assert np.array_equal(broken.pixels, apart.pixels)
    assert font.text_size("A\nV") == (font.width("A"), 2 * font.line_height)
    for text in ("T→", "→T", "漢T", "T漢"):
        assert abs(font.width(text) - sum(map(font.width, text))) <= 1


def test_mono_has_no_kerning():
    font = e3d.Font("mono", 20)
    assert {font.width(pair) for pair in ORIGINAL} == {font.width("ii")}


@pytest.mark.parametrize("size", [4, 11, 16])
def test_a_longer_part_of_a_text_is_wider(size):
    """Carets go right with each character; so do the cut texts among which `fitted` searches."""
    characters = [chr(code) for code in FACE.glyphs]
    advances = {c: in_parts(FACE.advance(FACE.glyphs[ord(c)]), size) for c in characters}
    values = [in_parts(value, size) for value in FACE.kerning.values.tolist()]
    narrowest = min(advances[c] for c in characters if advances[c])
    assert narrowest + min(values) > 0
    for text in TEXTS:
        carets = [e3d.Font("sans", size).width(text[:end]) for end in range(len(text) + 1)]
        assert carets == sorted(carets)
        cut = [e3d.Font("sans", size).width(text[:end] + "…") for end in range(len(text) + 1)]
        assert cut == sorted(cut), text


@pytest.mark.parametrize("width", range(20, 200, 15))
def test_kerned_lines_fit(width):
    font = e3d.Font("sans", 15)
    for text in ("AVAVAVA To Ty LTLT", "Town, Yacht. Avenue-Way (of) LAVA"):
        assert all(font.width(line) <= width for line in font.wrapped(text, width))
        short = font.fitted(text, width)
        assert font.width(short) <= width
        if short not in ("", text):  # not one letter more would have fitted
            kept = len(short) - 1
            assert font.width(text[: kept + 1] + "…") > width or text[kept] == " "

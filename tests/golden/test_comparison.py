"""What differs is found, counted and shown; what is allowed passes, no more."""

import numpy as np
import pytest
from golden.samples import changed, colors, slope

from engine3d import InvalidArgumentError
from engine3d.apps.golden.comparison import compare, root_mean_square
from engine3d.apps.golden.difference_picture import difference_picture
from engine3d.apps.golden.display import displayed
from engine3d.apps.golden.flip import mean_flip
from engine3d.apps.golden.matching import looks_different


def test_equal():
    difference = compare(colors(), colors())
    assert difference.different == 0 and difference.box is None and str(difference) == "equal"


def test_one_pixel():
    difference = compare(changed(colors(), by=(0, 0, 9, 0)), colors())
    assert difference.different == 1 and difference.total == 48
    assert difference.box == (3, 2, 4, 3)
    assert difference.mask[2, 3] and difference.mask.sum() == 1
    assert difference.largest == (9 if colors()[2, 3, 2] < 247 else 247)
    assert str(difference).startswith("1 of 48 pixels differ by up to ")
    assert str(difference).endswith("within (3, 2) to (3, 2)")


def test_root_mean_square():
    assert root_mean_square(colors(), colors()) == 0.0
    black, white = np.zeros((4, 5, 4), np.uint8), np.full((4, 5, 4), 255, np.uint8)
    assert root_mean_square(black, white) == root_mean_square(white, black) == 1.0
    assert root_mean_square(changed(black, by=51), black) == pytest.approx(0.2 / 20**0.5)
    assert root_mean_square(black, white[1:]) == 1.0


def test_tolerance_is_per_channel():
    pixels = np.full((2, 2, 4), 100, np.uint8)
    other = pixels + np.array([2, -2, 1, 0]).astype(np.uint8)
    assert compare(other, pixels, 1).different == 4
    assert compare(other, pixels, 2).different == 0


def test_unsigned_numbers_do_not_wrap_around():
    assert compare(np.array([[0]], np.uint8), np.array([[255]], np.uint8)).largest == 255
    assert compare(np.array([[0]], np.uint16), np.array([[65535]], np.uint16), 2).different == 1
    wide = np.array([[2**63 - 1]], np.int64)
    assert compare(wide, wide - 1).different == 1
    assert compare(np.array([[True]]), np.array([[False]])).largest == 1


def test_bits_of_floats_count_unless_something_is_allowed():
    a, b = (np.array([[value]], np.float32) for value in (0.0, -0.0))
    assert compare(a, b).different == 1 and compare(a, b).largest == 0
    assert compare(a, b, 1e-9).different == 0
    nan, infinite = (np.array([[value]], np.float32) for value in (np.nan, np.inf))
    assert compare(nan, nan).different == 0 and compare(infinite, infinite, 1).different == 0
    assert compare(nan, a, 5).different == 1 and compare(nan, a).largest == np.inf
    assert compare(infinite, a, 5).largest == np.inf


def test_sizes():
    difference = compare(colors(6, 8), colors(9, 5))
    assert difference.kinds == "it is 8x6 RGBA, not 5x9 RGBA"
    assert difference.mask.shape == (9, 8)
    assert difference.mask[:, 5:].all() and difference.mask[6:].all()
    same = compare(np.zeros((6, 8), np.uint8), np.zeros((9, 5), np.uint8))
    assert not same.mask[:6, :5].any()


@pytest.mark.parametrize("channels", [1, 2, 3])
def test_ways_to_write_the_same_colors_are_equal(channels):
    few = colors(channels=channels)
    rgba = displayed(few)
    assert compare(few, rgba).different == 0
    assert compare(few * np.uint16(257), rgba).different == 0
    assert compare(few, changed(rgba)).different == 1


def test_other_types_differ_everywhere():
    difference = compare(np.zeros((2, 3), np.float32), np.zeros((2, 3), np.int32))
    assert difference.different == 6
    assert str(difference) == "it is 3x2 float32, not 3x2 int32"
    assert compare(np.zeros((2, 3, 2)), np.zeros((2, 3, 3))).different == 6


def test_the_picture_of_a_difference():
    grey = np.full((40, 60, 4), 128, np.uint8)
    other = grey.copy()
    other[10, 20] = 129, 128, 128, 128
    other[30, 50] = 255, 255, 255, 255
    picture = difference_picture(grey, compare(other, grey)).astype(int)
    assert (picture[..., 3] == 255).all()
    little, much = picture[10, 20], picture[30, 50]
    assert little[0] > 250 and little[1] > 160 and much[1] < 60 < 200 < much[0]
    halo = picture[12, 22].tolist()
    assert halo == [255, 178, 198, 255] and picture[8, 18].tolist() == halo
    assert picture[13, 20].tolist() != halo and picture[10, 23].tolist() != halo
    plain = picture[0, 0]
    assert plain[0] == plain[1] == plain[2] > 230


def test_a_difference_in_a_corner_is_shown():
    grey = np.zeros((5, 7, 4), np.uint8)
    for y, x in ((0, 0), (4, 6), (0, 6), (4, 0)):
        picture = difference_picture(grey, compare(changed(grey, x, y, 255), grey))
        assert picture.shape == (5, 7, 4)
        assert picture[y, x].tolist() == [214, 0, 40, 255]


# As reg-cli compares


def yiq_distance(a, b):
    """The weighted square of a distance in YIQ, in plain numbers."""
    (r, g, b_), (R, G, B) = (
        [255 + (c - 255) * color[3] / 255 for c in map(float, color[:3])] for color in (a, b)
    )
    r, g, b_ = r - R, g - G, b_ - B
    y = r * 0.29889531 + g * 0.58662247 + b_ * 0.11448223
    i = r * 0.59597799 - g * 0.27417610 - b_ * 0.32180189
    q = r * 0.21147017 - g * 0.52261711 + b_ * 0.31114694
    return 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q


@pytest.mark.parametrize("threshold", [0.0, 0.1, 0.3])
def test_matching_measures_in_yiq(threshold):
    a, b = colors(seed=1), colors(seed=2)
    a[0], b[1] = b[0], a[1]
    found = looks_different(a, b, threshold, True)
    limit = 35215 * threshold**2
    expected = [
        [yiq_distance(one, other) > limit for one, other in zip(row, other_row, strict=True)]
        for row, other_row in zip(a, b, strict=True)
    ]
    assert found.tolist() == expected
    assert found.any() and not found.all()


def test_black_and_white_are_as_far_apart_as_can_be():
    black, white = (np.full((1, 1, 4), 255, np.uint8) for _ in range(2))
    black[..., :3] = 0
    assert looks_different(black, white, 0.95, True).all()
    assert not looks_different(black, white, 1.0, True).any()


def test_antialiasing_is_left_out_unless_it_counts():
    a, b = slope(0.0), slope(0.3)
    strict, loose = (looks_different(a, b, 0.0, count) for count in (True, False))
    assert strict.sum() > 20 and loose.sum() < strict.sum() / 3
    assert not (loose & ~strict).any()
    b[15, 5] = 255, 0, 0, 255  # inside of the area
    assert looks_different(a, b, 0.0, False)[15, 5]


def test_flip_where_it_is_installed(monkeypatch):
    pytest.importorskip("flip_evaluator", reason="needs flip-evaluator")
    a, b = colors(32, 32), colors(32, 32, seed=1)
    assert mean_flip(a, a) == 0.0 and 0.1 < mean_flip(a, b) <= 1.0


def test_flip_names_its_extra(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "flip_evaluator", None)
    with pytest.raises(InvalidArgumentError, match=r"engine3d\[flip\]"):
        mean_flip(colors(), colors())

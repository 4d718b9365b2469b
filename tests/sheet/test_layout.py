"""Panels fill the sheet, apart from each other, at the largest scale that fits."""

import itertools

import pytest

from engine3d.apps.sheet.layout import Padding, Reach, Rectangle, lay_out
from engine3d.errors import InvalidArgumentError

AREA, PADDING, GAP = Rectangle(10, 20, 800, 600), Padding(50, 30, 20, 50), 8
SHAPES = {
    "cube": [Reach(1, 1)] * 4,
    "needle": [Reach(100, 0.1), Reach(50, 40), Reach(100, 0.1), Reach(0.1, 0.1)],
    "plane": [Reach(3, 2), Reach(2, 2), Reach(3, 0), Reach(2, 0)],
    "point": [Reach(0, 0)] * 4,
    "huge": [Reach(1e30, 2e30)] * 5,
    "many": [Reach(1 + k % 3, 2) for k in range(11)],
}


def meet(a, b):
    return (
        a.x < b.x + b.width
        and b.x < a.x + a.width
        and a.y < b.y + b.height
        and b.y < a.y + a.height
    )


@pytest.mark.parametrize("columns", [None, 2])
@pytest.mark.parametrize("shape", SHAPES)
def test_panels_are_within_and_apart(shape, columns):
    rectangles, scale = lay_out(AREA, SHAPES[shape], PADDING, GAP, columns)
    assert len(rectangles) == len(SHAPES[shape]) and scale > 0
    for one in rectangles:
        assert one.x >= AREA.x and one.x + one.width <= AREA.x + AREA.width
        assert one.y >= AREA.y and one.y + one.height <= AREA.y + AREA.height
    for a, b in itertools.combinations(rectangles, 2):
        assert not meet(a, b)


@pytest.mark.parametrize("shape", ["cube", "needle", "plane", "huge", "many"])
def test_what_is_to_scale_fits_its_panel(shape):
    rectangles, scale = lay_out(AREA, SHAPES[shape], PADDING, GAP, None)
    for reach, one in zip(SHAPES[shape], rectangles, strict=True):
        assert reach.width * scale <= one.width - PADDING.left - PADDING.right + 1
        assert reach.height * scale <= one.height - PADDING.top - PADDING.bottom + 1


def test_the_scale_is_the_largest():
    (one,), scale = lay_out(AREA, [Reach(2, 1)], PADDING, GAP, None)
    assert one == AREA
    assert scale == pytest.approx((800 - 70) / 2)


def test_views_of_a_column_and_of_a_row_are_aligned():
    top, iso, front, right = lay_out(AREA, SHAPES["cube"], PADDING, GAP, 2)[0]
    assert (top.x, top.width) == (front.x, front.width)
    assert (front.y, front.height) == (right.y, right.height)
    assert iso.x == right.x and iso.y == top.y


def test_a_long_part_gets_more_room():
    reaches = [Reach(10, 1), Reach(1, 1), Reach(10, 1), Reach(1, 1)]
    top, _, _, right = lay_out(AREA, reaches, PADDING, GAP, 2)[0]
    assert top.width > 2 * right.width


def test_too_small_a_sheet():
    with pytest.raises(InvalidArgumentError, match="too few for 4 views"):
        lay_out(Rectangle(0, 0, 150, 100), SHAPES["cube"], PADDING, GAP, 2)

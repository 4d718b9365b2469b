"""Lines of the canvas against exact oracles: every octant, clipped, thick, joined, hostile."""

import numpy as np
import pytest
from canvas.oracles import convex_masks, line_mask, thick_line_corners

from engine3d.rendering.canvas import Canvas

WHITE = (255, 255, 255)
INT32 = (-(2**31), 2**31 - 1)


def drawn(columns, rows, *ends, **style):
    canvas = Canvas((columns, rows))
    canvas.line(*ends, WHITE, **style)
    return canvas.pixels[..., 0] > 0


def random_lines(seed, count, low, high):
    return np.random.default_rng(seed).integers(low, high, (count, 4), endpoint=True).tolist()


@pytest.mark.parametrize("dx", range(-9, 10))
def test_bresenham_in_every_direction(dx):
    for dy in range(-9, 10):
        ends = 12, 12, 12 + dx, 12 + dy
        assert np.array_equal(drawn(25, 25, *ends), line_mask(*ends, 25, 25)), ends


def test_bresenham_clipped_is_the_whole_line_inside():
    for ends in random_lines(1, 3000, -60, 90):
        assert np.array_equal(drawn(23, 31, *ends), line_mask(*ends, 23, 31)), ends


@pytest.mark.parametrize("reach", [10**3, 10**6, 2**30])
def test_bresenham_of_far_ends(reach):
    for ends in random_lines(reach, 1500, -reach, reach):
        assert np.array_equal(drawn(40, 30, *ends), line_mask(*ends, 40, 30)), ends


def test_bresenham_of_far_ends_that_meet_the_canvas():
    rng = np.random.default_rng(3)
    hits = 0
    for _ in range(1500):
        x, y = rng.integers(0, 40, 2).tolist()
        dx, dy = rng.integers(-(2**30), 2**30, 2).tolist()
        ends = x - dx, y - dy, x + dx, y + dy
        expected = line_mask(*ends, 40, 40)
        hits += expected.any()
        assert np.array_equal(drawn(40, 40, *ends), expected), ends
    assert hits > 1400


def test_bresenham_over_all_of_int32():
    low, high = INT32
    for ends in [
        (low, low, high, high),
        (high, low, low, high),
        (low, 3, high, 4),
        (3, high, 4, low),
        (low, low, high, low + 1),
        (low, 0, high, 12),
    ]:
        assert np.array_equal(drawn(16, 12, *ends), line_mask(*ends, 16, 12)), ends


@pytest.mark.parametrize("style", [{}, {"algorithm": "dda"}, {"width": 3}, {"width": 4.3}])
def test_both_directions_give_the_same_pixels(style):
    for x0, y0, x1, y1 in random_lines(4, 1000, -20, 60):
        forward = drawn(40, 40, x0, y0, x1, y1, **style)
        assert np.array_equal(forward, drawn(40, 40, x1, y1, x0, y0, **style)), (x0, y0, x1, y1)


def test_dda_is_bresenham_but_for_ties():
    for x0, y0, x1, y1 in random_lines(5, 3000, -50, 90):
        run = max(abs(x1 - x0), abs(y1 - y0))
        dda = drawn(40, 40, x0, y0, x1, y1, algorithm="dda")
        bresenham = drawn(40, 40, x0, y0, x1, y1)
        if run % 2 == 1 or run & (run - 1) == 0:  # no ties, or a slope without rounding
            assert np.array_equal(dda, bresenham), (x0, y0, x1, y1)
        else:
            rise = min(abs(x1 - x0), abs(y1 - y0))
            ties = sum((2 * k * rise) % (2 * run) == run for k in range(run + 1))
            assert np.count_nonzero(dda != bresenham) <= 2 * ties


def test_dda_clipped_is_the_whole_line_inside():
    for x0, y0, x1, y1 in random_lines(6, 1000, 0, 119):
        whole = drawn(120, 120, x0, y0, x1, y1, algorithm="dda")
        part = drawn(30, 20, x0 - 50, y0 - 60, x1 - 50, y1 - 60, algorithm="dda")
        assert np.array_equal(part, whole[60:80, 50:80])


def test_ends_are_the_pixels_that_hold_them():
    assert np.array_equal(drawn(20, 20, 2.99, 3.01, 15.5, 9.999), drawn(20, 20, 2, 3, 15, 9))
    assert np.array_equal(drawn(20, 20, -0.01, 3, 15, 9), drawn(20, 20, -1, 3, 15, 9))


@pytest.mark.parametrize("width", [1.001, 1.5, 2, 3, 4.25, 7, 30])
def test_thick_line_is_its_parallelogram(width):
    for ends in random_lines(int(width * 8), 400, -30, 70):
        corners = thick_line_corners(*ends, width)
        expected = convex_masks(np.array([corners]), 44, 36)[0]
        assert np.array_equal(drawn(44, 36, *ends, width=width), expected), ends


@pytest.mark.parametrize("width", [1.5, 3, 8])
def test_thick_line_is_as_wide_as_it_says_at_any_angle(width):
    for angle in np.radians(np.arange(1.1, 180.0, 7.3)):
        x, y = np.rint(300 * np.array([np.cos(angle), np.sin(angle)])).astype(int)
        area = drawn(660, 660, 330 - x, 330 - y, 330 + x, 330 + y, width=width).sum()
        longer = 1 + 1 / (2 * max(abs(x), abs(y)))  # half a pixel at both ends
        assert area / (2 * np.hypot(x, y) * longer) == pytest.approx(width, rel=0.02), angle


def test_thick_line_of_no_length_is_a_dot():
    assert np.argwhere(drawn(9, 9, 4, 4, 4, 4, width=3)).tolist() == [[3, 4], [4, 4], [5, 4]]


def test_translucent_thick_line_draws_each_pixel_once():
    canvas = Canvas((60, 60))
    for ends in random_lines(9, 50, 5, 55):
        canvas.clear()
        canvas.line(*ends, (255, 255, 255, 100), width=6)
        assert set(np.unique(canvas.pixels[..., 0])) == {0, 100}


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("style", [{}, {"algorithm": "dda"}, {"width": 5}])
def test_ends_that_are_not_finite_draw_nothing(bad, style):
    for k in range(4):
        ends = [1, 2, 8, 9]
        ends[k] = bad
        assert not drawn(10, 10, *ends, **style).any()


@pytest.mark.parametrize("style", [{}, {"algorithm": "dda"}, {"width": 3}])
def test_huge_ends_are_moved_to_the_limit(style):
    assert drawn(10, 10, -1e300, 4, 1e300, 4, **style)[4].all()
    assert drawn(10, 10, 5, 2.0**31, 5, -(2.0**40), **style)[:, 5].all()
    diagonal = drawn(10, 10, -1e18, -1e18, 1e18, 1e18, **style)
    assert diagonal[np.arange(10), np.arange(10)].all()


def test_huge_width_fills_the_canvas():
    assert drawn(10, 10, -3, -2, 14, 12, width=1e300).all()
    assert drawn(10, 10, -3, -2, 14, 12, width=np.inf).all()


def test_lines_are_the_single_calls():
    ends = np.array(random_lines(10, 200, -10, 60))
    colors = np.random.default_rng(10).integers(0, 256, (200, 4), np.uint8)
    together, one_by_one = Canvas((50, 50)), Canvas((50, 50))
    together.lines(ends, colors)
    together.lines(ends.reshape(-1, 2, 2)[:20], (9, 8, 7), width=3)
    for line, color in zip(ends, colors, strict=True):
        one_by_one.line(*line, color)
    for line in ends[:20]:
        one_by_one.line(*line, (9, 8, 7), width=3)
    assert np.array_equal(together.pixels, one_by_one.pixels)


@pytest.mark.parametrize("algorithm", ["bresenham", "dda"])
def test_polyline_draws_shared_pixels_once(algorithm):
    points = [(3, 3), (20, 5), (22, 20), (4, 25)]
    opened, closed = Canvas((30, 30)), Canvas((30, 30))
    opened.polyline(points, (255, 255, 255, 100), algorithm=algorithm)
    closed.polyline(points, (255, 255, 255, 100), closed=True, algorithm=algorithm)
    expected = Canvas((30, 30))
    for a, b in zip(points[:-1], points[1:], strict=True):
        expected.line(*a, *b, (100, 100, 100), algorithm=algorithm)
    assert np.array_equal(opened.pixels, expected.pixels)
    expected.line(*points[-1], *points[0], (100, 100, 100), algorithm=algorithm)
    assert np.array_equal(closed.pixels, expected.pixels)


def test_polyline_is_interrupted_by_nan():
    canvas, expected = Canvas((30, 30)), Canvas((30, 30))
    points = [(2, 2), (9, 4), (np.nan, 3), (12, 12), (20, 25), (25, np.inf), (1, 1)]
    canvas.polyline(points, (255, 255, 255, 100))
    expected.line(2, 2, 9, 4, (100, 100, 100))
    expected.line(12, 12, 20, 25, (100, 100, 100))
    assert np.array_equal(canvas.pixels, expected.pixels)


def test_polyline_of_few_points():
    canvas = Canvas((5, 5))
    canvas.polyline([], WHITE)
    canvas.polyline([(1, 1)], WHITE)
    canvas.polyline(np.empty((0, 2)), WHITE, closed=True)
    assert not canvas.pixels[..., 0].any()

"""Polygons and discs with smooth edges: the share of each pixel that is covered."""

import math

import numpy as np
import pytest

from engine3d.errors import InvalidArgumentError
from engine3d.rendering.canvas import Canvas

WHITE = (255, 255, 255)
FINE = 16  # samples of a pixel's side, at the middles of the cells that corners are rounded to


def alphas(draw, size=(24, 20)):
    canvas = Canvas(size)
    draw(canvas)
    return canvas.pixels[..., 0].astype(int)


def shares(inside, size=(24, 20)):
    """The share of each pixel's samples that a function of positions tells to be inside, of 255."""
    width, height = size
    y, x = (np.indices((height * FINE, width * FINE)) + 0.5) / FINE
    return 255 * inside(x, y).reshape(height, FINE, width, FINE).mean(axis=(1, 3))


def test_a_rectangle_between_pixels_is_exact():
    drawn = alphas(lambda c: c.polygon([(2.5, 3.25), (9.0, 3.25), (9.0, 7.0), (2.5, 7.0)], WHITE))
    assert drawn[3, 4] == 191 and drawn[5, 2] == 128 and drawn[5, 5] == 255
    assert drawn[3, 2] == 96 and drawn.sum() == pytest.approx(255 * 6.5 * 3.75, abs=8)


@pytest.mark.parametrize("seed", range(5))
def test_triangles_cover_their_share_of_each_pixel_in_either_winding(seed):
    corners = np.random.default_rng(seed).integers(-80, 460, (3, 2)) / 16

    def inside(x, y):
        sides = [
            (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
            for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
        ]
        return np.all([s > 0 for s in sides], axis=0) | np.all([s < 0 for s in sides], axis=0)

    drawn = alphas(lambda c: c.polygon(corners, WHITE))
    assert np.abs(drawn - shares(inside)).max() < 12
    assert np.array_equal(drawn, alphas(lambda c: c.polygon(corners[::-1], WHITE)))


@pytest.mark.parametrize(("radius", "width"), [(7.5, None), (7.5, 2.0), (3.0, 9.0), (0.25, None)])
def test_discs_and_rings_cover_their_share_of_each_pixel(radius, width):
    def inside(x, y):
        away = np.hypot(x - 11.5, y - 9.25)
        return (away < radius) & (away > radius - (math.inf if width is None else width))

    drawn = alphas(lambda c: c.disc(11.5, 9.25, radius, WHITE, width=width))
    assert np.abs(drawn - shares(inside)).max() < 14 and drawn.any()


def test_what_contours_wind_around_both_ways_is_a_hole():
    outer = [(2, 2), (18, 2), (18, 18), (2, 18)]
    inner = [(6, 6), (6, 14), (14, 14), (14, 6)]
    drawn = alphas(lambda c: c.polygon([outer, inner], WHITE))
    assert drawn[10, 10] == 0 and drawn[3, 3] == 255
    assert alphas(lambda c: c.polygon([outer, inner[::-1]], WHITE))[10, 10] == 255


def test_shapes_blend_and_are_clipped():
    canvas = Canvas((8, 8))
    canvas.disc(0, 0, 5, (200, 100, 0, 128))
    assert canvas.pixels[0, 0].tolist() == [100, 50, 0, 255]
    whole = Canvas((40, 40))
    whole.disc(20.25, 21.5, 15, WHITE)
    part = Canvas((10, 12))
    part.disc(10.25, 11.5, 15, WHITE)
    assert np.array_equal(part.pixels, whole.pixels[10:22, 10:20])


@pytest.mark.parametrize("place", [math.nan, math.inf, 1e300, -1e300, -5e9])
def test_what_is_nowhere_or_far_away_draws_nothing(place):
    def draw(canvas):
        canvas.disc(place, 3, 2, WHITE)
        canvas.polygon([(place, 1), (place, 2), (place, 3)], WHITE)
        canvas.polygon([], WHITE)
        canvas.polygon([[]], WHITE)

    assert not alphas(draw).any()


@pytest.mark.parametrize(
    "draw",
    [
        lambda c: c.polygon([(0, 0), (3000, 0), (0, 9)], WHITE),
        lambda c: c.polygon([(0, 0, 0)], WHITE),
        lambda c: c.polygon("corners", WHITE),
        lambda c: c.disc(0, 0, -1, WHITE),
        lambda c: c.disc(0, 0, 3, WHITE, width=-1),
        lambda c: c.disc(0, 0, 1e6, WHITE),
        lambda c: c.disc(0, None, 3, WHITE),
        lambda c: c.disc(0, 0, 3, (1, 2)),
    ],
)
def test_what_cannot_be_drawn_is_refused(draw):
    with pytest.raises(InvalidArgumentError):
        draw(Canvas((8, 8)))

"""The canvas: its arguments, points, rectangles, blending, clipping to windows."""

import numpy as np
import pytest
from canvas.oracles import blended

from engine3d.errors import InvalidArgumentError
from engine3d.rendering.canvas import Canvas

HOSTILE = [np.nan, np.inf, -np.inf, 1e300, -1e300, 2.0**31, -(2.0**31), 2.0**62, 0.0, -0.0, 7.3]


def draw_everything(canvas, rng, positions):
    """One of each call, with positions taken from a function of a count."""
    color = (*rng.integers(0, 256, 3).tolist(), int(rng.choice([0, 90, 255])))
    canvas.point(*positions(2), color)
    canvas.line(*positions(4), color)
    canvas.line(*positions(4), color, algorithm="dda")
    canvas.line(*positions(4), color, width=5)
    canvas.polyline(np.reshape(positions(8), (4, 2)), color, closed=True)
    canvas.triangles(np.reshape(positions(6), (1, 6)), color, algorithm="edge")
    canvas.triangles(np.reshape(positions(6), (1, 6)), color, algorithm="scanline")
    canvas.rectangle(*positions(4), color)
    canvas.rectangle(*positions(4), color, fill=False)
    canvas.text(*positions(2), "Ag\n{}", color, scale=2, background=(1, 2, 3, 60))


def test_new_canvas_is_opaque_black():
    canvas = Canvas((7, 5))
    assert canvas.pixels.shape == (5, 7, 4) and (canvas.width, canvas.height) == (7, 5)
    assert (canvas.pixels == (0, 0, 0, 255)).all()
    assert repr(canvas) == "Canvas((7, 5))"


def test_given_pixels_are_drawn_on_in_place():
    pixels = np.zeros((4, 6, 4), np.uint8)
    canvas = Canvas(pixels)
    canvas.point(5, 3, (1, 2, 3))
    assert canvas.pixels is pixels
    assert pixels[3, 5].tolist() == [1, 2, 3, 255] and pixels.sum() == 261


def test_canvas_keeps_its_pixels_alive():
    surface = Canvas(np.zeros((600, 600, 4), np.uint8))._surface
    surface.clear(b"\x01\x02\x03\x04")  # under a sanitizer, a use after free


@pytest.mark.parametrize("size", [(0, 0), (0, 5), (5, 0), (1, 1), (262144, 1), (1, 262144)])
def test_every_size(size):
    canvas = Canvas(size)
    rng = np.random.default_rng(0)
    draw_everything(canvas, rng, lambda count: rng.uniform(-5, 9, count).tolist())
    canvas.clear((9, 9, 9))
    assert (canvas.pixels[..., 0] == 9).all()


@pytest.mark.parametrize(
    "size",
    [
        5,
        (5, -1),
        (5.0, 5),
        (262145, 1),
        (1, 2, 3),
        [[[0, 0, 0, 0]]],
        np.zeros((4, 4), np.uint8),
        np.zeros((4, 4, 3), np.uint8),
        np.zeros((4, 4, 4), np.float32),
        np.zeros((4, 8, 4), np.uint8)[:, ::2],
        np.zeros((4, 4, 8), np.uint8)[..., ::2],
    ],
)
def test_wrong_canvases(size):
    with pytest.raises(InvalidArgumentError):
        Canvas(size)


def test_read_only_pixels_are_refused():
    pixels = np.zeros((4, 4, 4), np.uint8)
    pixels.flags.writeable = False
    with pytest.raises(InvalidArgumentError, match="writable"):
        Canvas(pixels)


@pytest.mark.parametrize(
    "color", [5, None, "redd", (1, 2), (1, 2, 3, 4, 5), (256, 0, 0), (-1, 0, 0), (1.5, 0, 0)]
)
def test_wrong_colors(color):
    canvas = Canvas((4, 4))
    with pytest.raises(InvalidArgumentError, match="color"):
        canvas.point(1, 1, color)
    with pytest.raises(InvalidArgumentError, match="color"):
        canvas.lines([[0, 0, 1, 1]], color)


@pytest.mark.parametrize("color", [[10, 20, 30], np.array([10, 20, 30]), bytes([10, 20, 30])])
def test_kinds_of_colors(color):
    canvas = Canvas((2, 2))
    canvas.point(1, 1, color)
    assert canvas.pixels[1, 1].tolist() == [10, 20, 30, 255]


def test_wrong_arguments():
    canvas = Canvas((4, 4))
    white = (255, 255, 255)
    for call in [
        lambda: canvas.line(0, 0, 1, 1, white, width=0),
        lambda: canvas.line(0, 0, 1, 1, white, width=float("nan")),
        lambda: canvas.line(0, 0, 1, 1, white, algorithm="wu"),
        lambda: canvas.triangle((0, 0), (1, 1), (2, 0), white, algorithm="magic"),
        lambda: canvas.points([[0, 0, 0]], white),
        lambda: canvas.points([0, 0], white),
        lambda: canvas.points(["here"], white),
        lambda: canvas.lines(np.zeros((3, 2)), white),
        lambda: canvas.triangles(np.zeros((3, 2)), white),
        lambda: canvas.points(np.zeros((3, 2)), np.zeros((2, 4), np.uint8)),
        lambda: canvas.points(np.zeros((3, 2)), np.full((3, 4), 1.5)),
        lambda: canvas.text(0, 0, "x", white, scale=0),
        lambda: canvas.text(0, 0, "x", white, scale=1.5),
        lambda: canvas.text(0, 0, "x", white, scale=10**9),
    ]:
        with pytest.raises(InvalidArgumentError):
            call()
    assert not canvas.pixels[..., :3].any()


def test_points_are_the_pixels_that_hold_them():
    canvas = Canvas((4, 3))
    inside = [(0, 0), (0.999, 1.0), (3.5, 2.999), (1, 2)]
    outside = [(-0.001, 1), (4, 1), (1, 3), (1, -1e-300), (np.nan, 1), (1, np.inf), (1e300, 0)]
    canvas.points(inside + outside, (255, 255, 255))
    assert np.argwhere(canvas.pixels[..., 0]).tolist() == [[0, 0], [1, 0], [2, 1], [2, 3]]


def test_points_with_a_color_each():
    canvas = Canvas((3, 1))
    colors = np.array([[1, 2, 3], [4, 5, 6], [7, 8, 9]], np.uint8)
    canvas.points([(0, 0), (1, 0), (2, 0)], colors)
    assert canvas.pixels[0, :, :3].tolist() == colors.tolist()
    canvas.points(np.empty((0, 2)), colors[:0])
    canvas.points([], (0, 0, 0))


def test_rectangle_takes_the_pixels_whose_centres_it_holds():
    canvas = Canvas((8, 6))
    canvas.rectangle(1, 2, 4, 3, (255, 255, 255))
    assert canvas.pixels[2:5, 1:5, 0].all() and np.count_nonzero(canvas.pixels[..., 0]) == 12
    canvas.clear()
    canvas.rectangle(1.5, 0, 1.0, 1, (255, 255, 255))  # left side included, right side not
    assert np.flatnonzero(canvas.pixels[0, :, 0]).tolist() == [1]


@pytest.mark.parametrize("size", [(-3, 2), (0, 5), (0.4, 3), (np.nan, 2)])
def test_rectangles_of_no_pixels(size):
    canvas = Canvas((8, 6))
    canvas.rectangle(2.6, 2.6, *size, (255, 255, 255))
    canvas.rectangle(2.6, 2.6, *size, (255, 255, 255), fill=False)
    assert not canvas.pixels[..., 0].any()


@pytest.mark.parametrize("size", [(1, 1), (1, 4), (4, 1), (2, 2), (6, 5)])
def test_outline_is_the_rim_once(size):
    width, height = size
    canvas = Canvas((12, 12))
    canvas.rectangle(2, 3, width, height, (255, 255, 255, 100), fill=False)
    expected = np.zeros((12, 12), np.uint8)
    expected[3 : 3 + height, 2 : 2 + width] = 100
    expected[4 : 2 + height, 3 : 1 + width] = 0
    assert np.array_equal(canvas.pixels[..., 0], expected)


def test_infinite_rectangle_covers_the_canvas():
    canvas = Canvas((8, 6))
    canvas.rectangle(-1e300, -1e300, np.inf, np.inf, (255, 255, 255))
    assert canvas.pixels[..., 0].all()


def test_blending_on_opaque_pixels_is_rounded_to_nearest():
    destination = np.arange(256)
    pixels = np.empty((1, 256, 4), np.uint8)
    canvas = Canvas(pixels)
    for source in [0, 1, 2, 127, 128, 200, 254, 255]:
        for alpha in range(256):
            pixels[0, :, :3] = destination[:, None]
            pixels[..., 3] = 255
            canvas.rectangle(0, 0, 256, 1, (source, source, source, alpha))
            twice = 2 * (source * alpha + destination * (255 - alpha))
            expected = (twice + 255) // 510
            assert (pixels[0, :, :3] == expected[:, None]).all() and (pixels[..., 3] == 255).all()


def test_blending_on_translucent_pixels():
    rng = np.random.default_rng(21)
    sources = rng.integers(0, 256, (2000, 4))
    destinations = rng.integers(0, 256, (2000, 4))
    sources[:300, 3] = rng.choice([0, 1, 254, 255], 300)
    destinations[100:400, 3] = rng.choice([0, 1, 254, 255], 300)
    pixels = destinations.astype(np.uint8)[None].copy()
    xy = np.stack([np.arange(2000), np.zeros(2000)], axis=1)
    Canvas(pixels).points(xy, sources.astype(np.uint8))
    pairs = zip(sources.tolist(), destinations.tolist(), strict=True)
    assert pixels[0].tolist() == [list(blended(*pair)) for pair in pairs]


def test_clear_overwrites_alpha():
    canvas = Canvas((3, 3))
    canvas.clear((1, 2, 3, 4))
    assert (canvas.pixels == (1, 2, 3, 4)).all()


def test_window_shows_what_the_whole_canvas_shows():
    rng = np.random.default_rng(22)
    for _ in range(400):
        whole, part = Canvas((200, 150)), Canvas((70, 40))
        seed = int(rng.integers(2**31))
        spread = rng.choice([0.25, 1, 40])  # quarters of pixels, so that shifts are exact

        def positions(count, origin, seed=seed, spread=spread):
            values = np.random.default_rng([seed, count]).integers(-200, 900, count) * spread / 4
            return (values - np.resize(origin, count)).tolist()

        def draw_at(canvas, origin, positions=positions):
            x, y, width, height = positions(4, (0, 0))
            canvas.rectangle(x - origin[0], y - origin[1], width, height, (0, 99, 255, 100))
            xy = np.reshape(positions(8, origin), (-1, 2))
            canvas.polyline(xy, (250, 20, 20, 150), closed=True)
            canvas.triangle(*xy[:3], (9, 200, 9, 90))
            canvas.line(*xy[0], *xy[2], (255, 255, 0, 99), width=7)
            canvas.line(*xy[1], *xy[3], (255, 255, 0, 99), algorithm="dda")
            canvas.text(*xy[1], "clip\nme", (0, 255, 255), scale=3, background=(0, 0, 80, 80))
            canvas.points(xy, (255, 255, 255))

        draw_at(whole, (0, 0))
        draw_at(part, (60, 50))
        assert np.array_equal(part.pixels, whole.pixels[50:90, 60:130])


def test_nothing_is_drawn_outside_a_window():
    rng = np.random.default_rng(23)
    image = np.full((60, 70, 4), 77, np.uint8)
    for flipped in [False, True]:
        window = image[20:40, 30:50][::-1] if flipped else image[20:40, 30:50]
        canvas = Canvas(window)
        for _ in range(300):
            draw_everything(canvas, rng, lambda count: rng.uniform(-80, 120, count).tolist())
            draw_everything(canvas, rng, lambda count: rng.choice(HOSTILE, count).tolist())
        canvas.clear((1, 2, 3, 4))
        inside = np.zeros((60, 70), bool)
        inside[20:40, 30:50] = True
        assert (image[~inside] == 77).all() and (image[inside] == (1, 2, 3, 4)).all()
        image[:] = 77


def test_flipped_canvas_draws_upside_down():
    upright, flipped = Canvas((20, 30)), Canvas((20, 30))
    Canvas(flipped.pixels[::-1]).line(2, 3, 15, 27, (255, 255, 255))
    upright.line(2, 3, 15, 27, (255, 255, 255))
    assert np.array_equal(upright.pixels[::-1], flipped.pixels)


def test_image_is_a_copy():
    canvas = Canvas((4, 3))
    canvas.point(1, 2, (10, 20, 30, 255))
    image = canvas.image()
    canvas.clear()
    assert image.mode == "RGBA" and image.size == (4, 3)
    assert image.getpixel((1, 2)) == (10, 20, 30, 255)

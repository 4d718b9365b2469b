"""The two triangle fills of the canvas against the top-left rule, and against each other."""

import numpy as np
import pytest
from canvas.oracles import convex_masks, snapped

from engine3d.rendering.canvas import Canvas

WIDTH, HEIGHT = 24, 18
CHUNK = 4000


def masks_of(triangles, algorithm):
    """Each triangle alone on a small canvas: (N, HEIGHT, WIDTH) of bool."""
    pixels = np.zeros((len(triangles), HEIGHT, WIDTH, 4), np.uint8)
    for own_pixels, (a, b, c) in zip(pixels, triangles.tolist(), strict=True):
        Canvas(own_pixels).triangle(a, b, c, (255, 255, 255), algorithm=algorithm)
    return pixels[..., 3] > 0


def uniform(rng, count):
    return rng.uniform(-8, 32, (count, 3, 2))


def on_centres_and_corners(rng, count):
    return rng.integers(-8, 56, (count, 3, 2)) / 2


def tiny(rng, count):
    return rng.uniform(0, 18, (count, 1, 2)) + rng.uniform(-0.8, 0.8, (count, 3, 2))


def slivers(rng, count):
    a, b = rng.uniform(-8, 32, (2, count, 1, 2))
    beside = a + (b - a) * rng.uniform(-1, 2, (count, 1, 1)) + rng.normal(0, 0.01, (count, 1, 2))
    return np.concatenate([a, b, beside], axis=1)


def degenerate(rng, count):
    a, b = rng.integers(-8, 32, (2, count, 1, 2)).astype(float)
    return np.concatenate([a, b, rng.choice([a, b, 2 * b - a])], axis=1)


def large(rng, count):
    return rng.uniform(-5e5, 5e5, (count, 3, 2))


def large_about_the_canvas(rng, count):
    middle = rng.uniform(0, 18, (count, 1, 2))
    return middle + rng.normal(0, 1, (count, 3, 2)) * 10 ** rng.uniform(0, 5.6, (count, 1, 1))


@pytest.mark.parametrize(
    "family",
    [uniform, on_centres_and_corners, tiny, slivers, degenerate, large, large_about_the_canvas],
)
def test_both_fills_are_the_top_left_rule(family):
    rng = np.random.default_rng(11)
    for _ in range(4):  # 7 families of 4 x 4,000: 112,000 triangles
        triangles = family(rng, CHUNK)
        expected = convex_masks(snapped(triangles), WIDTH, HEIGHT)
        assert np.array_equal(masks_of(triangles, "edge"), expected)
        assert np.array_equal(masks_of(triangles, "scanline"), expected)


@pytest.mark.parametrize("reach", [2.0**24, 2.0**31])
def test_both_fills_are_exact_up_to_the_limit(reach):
    rng = np.random.default_rng(12)
    triangles = rng.uniform(-reach, reach, (600, 3, 2))
    triangles[:300, 0] = rng.uniform(-20, 40, (300, 2))  # many with an edge through the canvas
    triangles[:300, 1] = -triangles[:300, 2] + rng.uniform(-30, 30, (300, 2))
    triangles[::7] = np.clip(triangles[::7] * 1e6, -reach, reach)
    expected = convex_masks(snapped(triangles).astype(object), WIDTH, HEIGHT)
    assert expected.any(axis=(1, 2)).sum() > 100 and not expected.all(axis=(1, 2)).all()
    assert np.array_equal(masks_of(triangles, "edge"), expected)
    assert np.array_equal(masks_of(triangles, "scanline"), expected)


@pytest.mark.parametrize("algorithm", ["edge", "scanline"])
def test_positions_beyond_the_limit_are_moved_there(algorithm):
    far = np.array([[[-1e300, -1e300], [1e300, -1e300], [0, 1e300]]])
    near = np.clip(far, -(2.0**31), 2.0**31)
    assert np.array_equal(masks_of(far, algorithm), masks_of(near, algorithm))
    assert masks_of(far, algorithm).all()


@pytest.mark.parametrize("algorithm", ["edge", "scanline"])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_vertices_that_are_not_finite_drop_their_triangle(algorithm, bad):
    canvas = Canvas((10, 10))
    good = [0, 0, 10, 0, 0, 10]
    triangles = np.array([good] * 7, float)
    triangles[np.arange(6), np.arange(6)] = bad
    canvas.triangles(triangles[:6], (255, 255, 255), algorithm=algorithm)
    assert not canvas.pixels[..., 0].any()
    canvas.triangles(triangles, (255, 255, 255), algorithm=algorithm)
    assert canvas.pixels[..., 0].any()


def test_snapping_is_to_nearest_even():
    # A left edge at 0.5 + 1/512 rounds to 128/256, the centre of pixel 0; 0.5 + 3/512 to 130/256.
    for offset, first in [(1 / 512, 0), (3 / 512, 1), (1 / 512 + 1e-9, 1)]:
        canvas = Canvas((4, 4))
        x = 0.5 + offset
        canvas.triangle((x, -50), (x, 50), (60, 0), (255, 255, 255))
        assert np.argmax(canvas.pixels[2, :, 0] > 0) == first


@pytest.mark.parametrize("algorithm", ["edge", "scanline"])
def test_fans_are_watertight(algorithm):
    rng = np.random.default_rng(13)
    for trial in range(200):
        count = int(rng.integers(3, 12))
        angles = np.sort(rng.uniform(0, 2 * np.pi, count))
        gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi))
        if gaps.max() >= 3:
            continue  # the fan would not go around its centre
        radius = 10 ** rng.uniform(2.5, 5)
        rim = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        centre = rng.integers(0, 64, 2) / 2 if trial % 2 else rng.uniform(0, 32, 2)
        fan = [[centre, rim[k], rim[(k + 1) % count]] for k in range(count)]
        canvas = Canvas((32, 32))
        canvas.triangles(fan, (255, 255, 255, 100), algorithm=algorithm)
        inside = radius * np.cos(gaps.max() / 2) > 100
        if inside:
            assert (canvas.pixels[..., 0] == 100).all()  # once; twice would give 161


@pytest.mark.parametrize("algorithm", ["edge", "scanline"])
def test_random_meshes_are_watertight(algorithm):
    rng = np.random.default_rng(14)
    x, y = np.meshgrid(np.linspace(-20, 80, 9), np.linspace(-20, 80, 9))
    for grid in [0, 0.5]:
        vertices = np.stack([x, y], axis=-1) + rng.uniform(-3, 3, (9, 9, 2))
        if grid:
            vertices = np.round(vertices / grid) * grid
        a, b = vertices[:-1, :-1], vertices[:-1, 1:]
        c, d = vertices[1:, 1:], vertices[1:, :-1]
        mesh = np.concatenate([np.stack([a, b, c], -2), np.stack([a, d, c], -2)]).reshape(-1, 3, 2)
        canvas = Canvas((60, 60))
        canvas.triangles(rng.permutation(mesh), (255, 255, 255, 100), algorithm=algorithm)
        assert (canvas.pixels[..., 0] == 100).all()


def test_order_of_vertices_changes_nothing():
    rng = np.random.default_rng(15)
    triangles = uniform(rng, 500)
    expected = masks_of(triangles, "edge")
    for order in [(1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]:
        for algorithm in ["edge", "scanline"]:
            assert np.array_equal(masks_of(triangles[:, order], algorithm), expected)

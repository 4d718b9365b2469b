"""Triangles of user interfaces: every backend against the reference, all of them against rules.

The rules are section 11 of docs/exactness.
"""

import numpy as np
import pytest
from ui.lists import SIDE, random_list, random_textures

import engine3d as e3d
from engine3d.apps.imgui_painter.triangles import COMMAND, VERTEX, Texture, draw_triangles
from engine3d.errors import InvalidArgumentError

WHITE = Texture(np.full((1, 1, 4), 255, np.uint8))
EVERYWHERE = (-(1 << 31), -(1 << 31), (1 << 31) - 1, (1 << 31) - 1)
backends = pytest.mark.parametrize("backend", e3d.backends())


def one_command(count, scissor=EVERYWHERE, texture=0):
    return np.array([(*scissor, 0, count, 0, texture)], COMMAND)


def draw(
    pixels,
    corners,
    color,
    indices=(0, 1, 2),
    *,
    uv=(0, 0),
    texture=WHITE,
    scissor=EVERYWHERE,
    backend="scalar",
):
    """Draw triangles of one colour; the corners are (N, 2)."""
    vertices = np.zeros(len(corners), VERTEX)
    vertices["position"], vertices["uv"], vertices["color"] = corners, uv, color
    listed = np.array(indices, np.uint16)
    draw_triangles(
        pixels, vertices, listed, one_command(len(listed), scissor), [texture], backend=backend
    )


def rectangle(pixels, left, top, right, bottom, color, **options):
    corners = [(left, top), (right, top), (right, bottom), (left, bottom)]
    draw(pixels, corners, color, (0, 1, 2, 0, 2, 3), **options)


@pytest.mark.parametrize("width", [3, 16, 23, SIDE])
def test_every_backend_draws_the_same(width):
    rng = np.random.default_rng(width)
    textures = random_textures(rng)
    changed = 0
    for _ in range(30):
        arguments = *random_list(rng), textures
        before = rng.integers(0, 256, (SIDE, width + 2, 4), np.uint8)
        expected = before.copy()
        draw_triangles(expected[:, 1:-1], *arguments, backend="scalar")
        changed += (expected != before).any(-1).sum()
        for backend in e3d.backends():
            drawn = before.copy()
            draw_triangles(drawn[:, 1:-1], *arguments, backend=backend)
            assert np.array_equal(drawn, expected), backend
        assert np.array_equal(expected[:, [0, -1]], before[:, [0, -1]])
    assert changed > 30 * width


@backends
def test_blending_is_exact_for_all_alphas(backend):
    """Colours over255(s a + d (255 - a)), of every alpha and every colour below."""
    pixels = np.zeros((256, 256, 4), np.uint8)
    pixels[...] = np.arange(256)[:, None, None]
    for alpha in range(256):
        rectangle(pixels, alpha, 0, alpha + 1, 256, (10, 128, 255, alpha), backend=backend)
    alpha = np.arange(256)[None, :, None]
    below = np.arange(256)[:, None, None]
    mixed = np.array([10, 128, 255, 255]) * alpha + below * (255 - alpha)
    assert np.array_equal(pixels, (2 * mixed + 255) // 510)


@backends
def test_a_fan_covers_each_pixel_once(backend):
    rng = np.random.default_rng(5)
    for _ in range(12):
        middle = rng.uniform(20, 44, 2)
        angles = np.sort(rng.uniform(0, 2 * np.pi, 7))
        around = middle + rng.uniform(40, 90, (7, 1)) * np.c_[np.cos(angles), np.sin(angles)]
        around = np.concatenate([around, [[-9, -9], [73, -9], [73, 73], [-9, 73]]])
        around = around[np.argsort(np.arctan2(*(around - middle).T))]
        fan = [(0, k + 1, (k + 1) % len(around) + 1) for k in range(len(around))]
        pixels = np.zeros((64, 64, 4), np.uint8)
        draw(pixels, [middle, *around], (255, 0, 0, 100), np.ravel(fan), backend=backend)
        inside = pixels[20:44, 20:44]
        assert (inside == inside[0, 0]).all() and inside[0, 0, 3] == 100


@backends
def test_a_rectangle_holds_the_centres_of_its_pixels(backend):
    pixels = np.zeros((20, 40, 4), np.uint8)
    rectangle(pixels, 3.5, 2.51, 30.5, 9.49, (9, 8, 7, 255), backend=backend)
    expected = np.zeros_like(pixels)
    expected[3:9, 3:30] = 9, 8, 7, 255
    assert np.array_equal(pixels, expected)


@backends
def test_a_scissor_only_leaves_out_pixels(backend):
    rng = np.random.default_rng(2)
    texture = Texture(rng.integers(0, 256, (9, 9, 4), np.uint8))
    corners = [(-7, 3), (50, 11), (13, 44)]
    uv = [(0, 0), (1.1, 0.2), (0.3, 0.9)]
    whole, cut = np.zeros((2, 40, 40, 4), np.uint8)
    draw(whole, corners, (255, 200, 100, 255), uv=uv, texture=texture, backend=backend)
    draw(
        cut,
        corners,
        (255, 200, 100, 255),
        uv=uv,
        texture=texture,
        scissor=(11, 9, 23, 31),
        backend=backend,
    )
    assert np.array_equal(cut[9:31, 11:23], whole[9:31, 11:23])
    cut[9:31, 11:23] = 0
    assert not cut.any() and whole.any()


@backends
def test_texels_that_fit_pixels_are_taken_as_they_are(backend):
    """As of glyphs, and of pictures in their own size: no filter blurs them."""
    texels = np.random.default_rng(3).integers(0, 256, (37, 53, 4), np.uint8)
    texels[..., 3] = 255
    pixels = np.zeros((60, 80, 4), np.uint8)
    uv = [(0, 0), (1, 0), (1, 1), (0, 1)]
    rectangle(pixels, 11, 5, 64, 42, (255,) * 4, uv=uv, texture=Texture(texels), backend=backend)
    assert np.array_equal(pixels[5:42, 11:64], texels)
    assert pixels.any(-1).sum() == 37 * 53


@backends
def test_opaque_texels_under_white_are_taken_as_they_are(backend):
    """Wherever rows begin and end: at the picture's sides, the texture's, a scissor's."""
    rng = np.random.default_rng(4)
    texels = rng.integers(0, 256, (6, 70, 4), np.uint8)
    texture = Texture(texels, opaque=True)
    uv = [(0, 0), (1, 0), (1, 1), (0, 1)]
    texels = texels | np.uint8([0, 0, 0, 255])
    for left in range(-20, 60):
        first, last = rng.integers(0, 80, 2)
        pixels = rng.integers(0, 256, (8, 80, 4), np.uint8)
        expected = pixels.copy()
        right = left + 70
        rectangle(
            pixels,
            *(left, 1, right, 7, (255,) * 4),
            uv=uv,
            texture=texture,
            scissor=(first, 0, last, 8),
            backend=backend,
        )
        from_, to = max(left, first, 0), min(right, last, 80)
        if from_ < to:
            expected[1:7, from_:to] = texels[:, from_ - left : to - left]
        assert np.array_equal(pixels, expected)


def over255(n):
    return (n + 127) // 255


@backends
@pytest.mark.parametrize("below", [0, 1, 127, 200, 255])
def test_glyphs_are_exact_for_all_alphas(backend, below):
    """Every alpha of a texel under every alpha of a colour, in glyphs of five texels."""
    alphas = np.arange(256, dtype=np.uint8)
    texture, color = Texture(alphas[None, :].copy()), (10, 128, 255)
    pixels = np.full((256, 256, 4), below, np.uint8)
    lefts = range(0, 256, 5)
    vertices = np.zeros((256, len(lefts), 4), VERTEX)
    for alpha in range(256):
        for k, left in enumerate(lefts):
            right = min(left + 5, 256)
            corners = np.array([(left, 0), (right, 0), (right, 1), (left, 1)])
            vertices[alpha, k]["position"] = corners + (0, alpha)
            vertices[alpha, k]["uv"] = corners / (256, 1)
            vertices[alpha, k]["color"] = *color, alpha
    first = 4 * np.arange(vertices.size // 4, dtype=np.uint32)
    indices = (first[:, None] + np.uint32([0, 1, 2, 0, 2, 3])).ravel()
    draw_triangles(
        pixels, vertices.ravel(), indices, one_command(len(indices)), [texture], backend=backend
    )
    alpha = over255(np.arange(256)[:, None] * np.arange(256)[None, :])[..., None]
    assert np.array_equal(pixels, over255(np.array([*color, 255]) * alpha + below * (255 - alpha)))


@backends
def test_bilinear_texels_lie_between_their_neighbours(backend):
    """A ramp of texels, stretched eight times, is a ramp of pixels."""
    texels = np.repeat(np.arange(0, 256, 17, np.uint8)[None, :], 4, 0)
    pixels = np.zeros((4, 128, 4), np.uint8)
    uv = [(0, 0), (1, 0), (1, 1), (0, 1)]
    rectangle(pixels, 0, 0, 128, 4, (255,) * 4, uv=uv, texture=Texture(texels), backend=backend)
    exact = np.clip((np.arange(128) + 0.5) / 8 - 0.5, 0, 15) * 17
    assert np.abs(pixels[1, :, 3] - exact).max() <= 1.0


@backends
def test_what_is_opaque_hides_what_is_below(backend):
    """Large rectangles over one another, of colours and of textures whose alpha isn't looked at."""
    rng = np.random.default_rng(8)
    picture = rng.integers(0, 256, (90, 90, 4), np.uint8)
    for opaque in (False, True):
        vertices, commands = np.zeros(4 * 30, VERTEX), []
        for k in range(30):
            left, top = rng.integers(-10, 90, 2)
            right, bottom = rng.integers(100, 210, 2)
            own = vertices[4 * k : 4 * k + 4]
            own["position"] = [(left, top), (right, top), (right, bottom), (left, bottom)]
            own["uv"] = [(0, 0), (1, 0), (1, 1), (0, 1)] if k % 3 else (0.5, 0.5)
            own["color"] = *rng.integers(0, 256, 3), rng.choice([255, 255, 255, 77])
            commands.append((*EVERYWHERE, 6 * k, 6, 4 * k, k % 2))
        indices = np.concatenate([np.array([0, 1, 2, 0, 2, 3], np.uint16)] * 30)
        textures = [Texture(picture, opaque=opaque), WHITE]
        drawn = [np.zeros((200, 200, 4), np.uint8) for _ in range(2)]
        draw_triangles(
            drawn[0], vertices, indices, np.array(commands, COMMAND), textures, backend=backend
        )
        for command in commands:
            draw_triangles(
                drawn[1],
                vertices,
                indices,
                np.array([command], COMMAND),
                textures,
                backend="scalar",
            )
        assert np.array_equal(*drawn)


@backends
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_has_no_place_is_not_drawn(backend, bad):
    pixels = np.zeros((30, 30, 4), np.uint8)
    draw(pixels, [(1, 1), (29, bad), (3, 28)], (255,) * 4, backend=backend)
    rectangle(pixels, 1, 1, bad, 20, (255,) * 4, backend=backend)
    assert not pixels.any()


@backends
def test_huge_coordinates_are_clipped(backend):
    pixels = np.zeros((30, 30, 4), np.uint8)
    rectangle(pixels, -1e30, 4, 1e30, 9, (1, 2, 3, 255), backend=backend)
    assert pixels[4:9].any(-1).all() and not pixels[:4].any() and not pixels[9:].any()


HOSTILE = {
    "an index": ([0, 1, 3], one_command(3), 1),
    "an index after the first vertex": (
        [0, 1, 2],
        np.array([(*EVERYWHERE, 0, 3, 1, 0)], COMMAND),
        1,
    ),
    "a negative first vertex": ([0, 1, 2], np.array([(*EVERYWHERE, 0, 3, -1, 0)], COMMAND), 1),
    "a count": ([0, 1, 2], one_command(6), 1),
    "a negative count": ([0, 1, 2], one_command(-3), 1),
    "half a triangle": ([0, 1, 2], one_command(2), 1),
    "a texture": ([0, 1, 2], one_command(3, texture=1), 1),
    "a negative texture": ([0, 1, 2], one_command(3, texture=-1), 1),
    "no textures": ([0, 1, 2], one_command(3), 0),
    "no indices": ([], one_command(3), 1),
}


@backends
@pytest.mark.parametrize("case", HOSTILE)
def test_what_is_out_of_range_is_refused_and_nothing_drawn(case, backend):
    indices, command, textures = HOSTILE[case]
    vertices = np.zeros(3, VERTEX)
    vertices["position"], vertices["color"] = [(0, 0), (9, 0), (0, 9)], 255
    pixels = np.zeros((12, 12, 4), np.uint8)
    commands = np.concatenate([one_command(3 if len(indices) else 0), command])
    with pytest.raises(InvalidArgumentError):
        draw_triangles(
            pixels,
            vertices,
            np.array(indices, np.uint32),
            commands,
            [WHITE][:textures],
            backend=backend,
        )
    assert not pixels.any()


@pytest.mark.parametrize(
    "pixels",
    [
        np.zeros((4, 4, 3), np.uint8),
        np.zeros((4, 4, 4), np.float32),
        np.zeros((4, 8, 4), np.uint8)[:, ::2],
        np.zeros((0, 4, 4), np.uint8),
        np.zeros((1, 16385, 4), np.uint8),
        np.zeros((4, 4, 4), np.uint8)[::-1],
        np.zeros(4, np.uint8),
        "texels",
    ],
    ids=lambda pixels: str(getattr(pixels, "shape", pixels)),
)
def test_textures_have_rows_of_texels(pixels):
    with pytest.raises(InvalidArgumentError):
        Texture(pixels)


def test_arrays_of_other_types_are_refused():
    pixels, vertices = np.zeros((8, 8, 4), np.uint8), np.zeros(3, VERTEX)
    with pytest.raises(InvalidArgumentError):
        draw_triangles(pixels, vertices, np.zeros(3, np.int64), one_command(3), [WHITE])
    with pytest.raises(InvalidArgumentError):
        draw_triangles(pixels[..., :3], vertices, np.zeros(3, np.uint16), one_command(3), [WHITE])
    with pytest.raises(InvalidArgumentError):
        draw_triangles(
            pixels, np.zeros((3, 7), np.float32), np.zeros(3, np.uint16), one_command(3), [WHITE]
        )
    with pytest.raises(InvalidArgumentError):
        Texture(np.zeros((2, 2, 4), np.uint8), "cubic")


def test_an_empty_picture_takes_any_list():
    rng = np.random.default_rng(0)
    draw_triangles(np.zeros((0, 9, 4), np.uint8), *random_list(rng), random_textures(rng))

"""The kernel of the user interface against R40 to R42."""

import numpy as np
import pytest
from kernels import layouts
from kernels.calls import record
from kernels.harness import all_backends, kernels_of
from kernels.layouts import UI_ROWS

WIDTHS = (16, 17, 40, 301)
HEIGHT = 20
RGBA8, A8, RGBX8 = layouts.UI_RGBA8, layouts.UI_A8, layouts.UI_RGBX8
NEAREST, BILINEAR = layouts.UI_NEAREST, layouts.UI_BILINEAR


def over255(products):
    n = products.astype(np.int64) + 128
    return (n + (n >> 8)) >> 8


def blended(over, under):
    """R42 of pixels (..., 4) of integers."""
    alpha = over[..., 3:]
    opaque = np.concatenate([over[..., :3], np.full_like(alpha, 255)], axis=-1)
    return over255(opaque * alpha + under * (255 - alpha))


def texture_of(rng, kind, width, height, filter):
    """A texture, and its texels as (height, width, 4)."""
    pixels = rng.integers(0, 256, (height, width, 1 if kind == A8 else 4), np.uint8)
    texels = pixels.copy()
    if kind == A8:
        texels = np.concatenate([np.full((height, width, 3), 255, np.uint8), pixels], axis=-1)
    elif kind == RGBX8:
        texels[..., 3] = 255
    sizes = {"width": width, "height": height, "stride": pixels.strides[0]}
    return record("ui_texture", pixels=pixels, **sizes, format=kind, filter=filter), texels


def random_rows(rng, width):
    rows = record("ui_rows", first=3, count=HEIGHT - 5)
    ends = np.sort(rng.integers(0, width + 1, (2, UI_ROWS)), axis=0)
    ends[:, ::3] = [[0], [width]]
    rows["left"], rows["right"] = ends
    return rows


def drawn(kernels, under, shape, rows):
    """The picture afterwards, and which of its pixels the rows hold."""
    picture = under.copy()
    height, width = picture.shape[:2]
    sizes = {"width": width, "height": height, "stride": picture.strides[0]}
    kernels.ui(record("canvas", pixels=picture, **sizes), shape, rows)
    held, x = np.zeros((height, width), bool), np.arange(width)
    for i in range(rows["count"][0]):
        held[rows["first"][0] + i] = (x >= rows["left"][0, i]) & (x < rows["right"][0, i])
    return picture, held


def word(color):
    return int(np.array(color, np.uint8).view(np.uint32)[0])


@all_backends
@pytest.mark.parametrize("alpha", [255, 130, 0])
def test_one_colour(kernels, alpha):
    rng = np.random.default_rng(alpha)
    texture, _ = texture_of(rng, RGBA8, 2, 2, NEAREST)
    for width in WIDTHS:
        under = rng.integers(0, 256, (HEIGHT, width, 4), np.uint8)
        texel, rgba = (255, 90, 200, 255), (7, 250, 100, alpha)
        given = {"texel_is_constant": 1, "color_is_constant": 1, "is_opaque": alpha == 255}
        shape = record("ui_shape", texture=texture, **given, texel=word(texel), rgba=word(rgba))
        got, held = drawn(kernels, under, shape, random_rows(rng, width))
        color = over255(np.multiply(texel, rgba))
        expected = np.where(held[..., None], blended(color, under), under)
        assert np.array_equal(got, expected)


@all_backends
@pytest.mark.parametrize("kind", [RGBA8, A8, RGBX8])
@pytest.mark.parametrize("rgba", [(255,) * 4, (200, 30, 90, 255), (9, 80, 255, 77)])
def test_texels_that_are_copied(kernels, kind, rgba):
    rng = np.random.default_rng(kind)
    for width in WIDTHS:
        texture, texels = texture_of(rng, kind, width + 9, HEIGHT + 4, NEAREST)
        under = rng.integers(0, 256, (HEIGHT, width, 4), np.uint8)
        given = {"is_copy": 1, "color_is_constant": 1, "copy_x": 5, "copy_y": 2}
        given["is_opaque"] = kind == RGBX8 and rgba[3] == 255
        shape = record("ui_shape", texture=texture, **given, rgba=word(rgba))
        got, held = drawn(kernels, under, shape, random_rows(rng, width))
        color = over255(np.multiply(texels[2 : HEIGHT + 2, 5 : width + 5].astype(int), rgba))
        expected = np.where(held[..., None], blended(color, under), under)
        assert np.array_equal(got, expected)


@all_backends
@pytest.mark.parametrize("filter", [NEAREST, BILINEAR])
@pytest.mark.parametrize("texel_is_constant", [False, True])
@pytest.mark.parametrize("color_is_constant", [False, True])
def test_planes_as_without_lanes(kernels, filter, texel_is_constant, color_is_constant):
    """Texels and colours that change over the shape: the bytes are those of one lane."""
    rng, plain = np.random.default_rng(5), kernels_of("portable")
    plane = layouts.layout("e3d_ui_plane")
    for kind in (RGBA8, A8, RGBX8):
        for width in WIDTHS:
            texture, _ = texture_of(rng, kind, 13, 9, filter)
            under, rows = (
                rng.integers(0, 256, (HEIGHT, width, 4), np.uint8),
                random_rows(rng, width),
            )
            u, v, *color = (np.zeros((), plane) for _ in range(6))
            u["gx"], v["gy"], v["at_base"] = 256 * 13 / width, 256 * 9 / HEIGHT, -300
            for k, one in enumerate(color):
                one["at_base"], one["gx"], one["gy"] = (
                    40 * k,
                    rng.uniform(-3, 6),
                    rng.uniform(-3, 9),
                )
            given = {"base_x": 2, "base_y": 3, "u": u, "v": v, "color": np.array(color)}
            given |= {"texel": 0xC0FF8040, "rgba": 0x90307FFF}
            given |= {"texel_is_constant": texel_is_constant}
            given |= {"color_is_constant": color_is_constant}
            shape = record("ui_shape", texture=texture, **given)
            got, held = drawn(kernels, under, shape, rows)
            assert np.array_equal(got, drawn(plain, under, shape, rows)[0])
            assert np.array_equal(got[~held], under[~held])
            assert (got != under).any()

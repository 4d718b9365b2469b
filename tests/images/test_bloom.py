"""Bloom against R124 in NumPy, and what it leaves alone."""

import numpy as np
import pytest
from images.scenes_tone import lamps
from kernels.test_encode import expected_bytes

import engine3d as e3d
from engine3d._native import rasterizer
from engine3d.materials.colors import srgb_to_linear_table

F = np.float32
SIZES = [(1, 1), (1, 7), (2, 2), (3, 5), (16, 16), (17, 33), (64, 1), (131, 257)]


def clamped(index, count):
    return np.clip(index, 0, count - 1)


def filtered(image, axis):
    """Half as many rows (axis 0) or columns."""
    size = image.shape[axis]
    first = 2 * np.arange((size + 1) // 2)
    a, b, c, d = (np.take(image, clamped(first + k, size), axis) for k in (-1, 0, 1, 2))
    return ((a + d) + (b + c) * F(3)) * F(0.125)


def doubled(image, size, axis):
    i = np.arange(size)
    near = np.take(image, i // 2, axis)
    far = np.take(image, clamped(i // 2 + np.where(i % 2, 1, -1), image.shape[axis]), axis)
    return near * F(0.75) + far * F(0.25)


def spread(image, shape):
    return doubled(doubled(image, shape[0], 0), shape[1], 1)


def glow_of(radiance, strength):
    """R124: what is added to each pixel, before it is mixed."""
    count = 1
    while count < 8 and 8 << (count + 1) <= len(radiance):
        count += 1
    levels = [np.clip(radiance - F(1), F(0), F(64))]
    for _ in range(count):
        levels.append(filtered(filtered(levels[-1], 0), 1))
    total = levels[-1]
    for level in levels[-2:0:-1]:
        total = level + spread(total, level.shape)
    return spread(total, radiance.shape) * (F(strength) * (F(1) / F(count)))


def expected(radiance, color, strength, srgb):
    glow = glow_of(radiance, strength)
    codes = color[..., :3]
    if srgb:
        sixteen = np.rint(srgb_to_linear_table().astype(np.float64) * 65535).astype(F)
        shown = sixteen[codes] * F(float.fromhex("0x1.0001p-16"))
    else:
        shown = codes.astype(F) * F(float.fromhex("0x1.010102p-8"))
    share = glow / (F(1) + glow)
    mixed = (shown + (F(1) - shown) * share).reshape(-1, 3)
    out = color.copy()
    planes = [np.ascontiguousarray(mixed[:, k]) for k in range(3)]
    codes = expected_bytes(planes, srgb).view(np.uint8).reshape(-1, 4)
    out[..., :3] = codes[:, :3].reshape(*color.shape[:2], 3)
    return out


@pytest.mark.parametrize("backend", list(rasterizer.BACKENDS))
def test_glow(backend):
    if backend not in e3d.backends():
        pytest.skip(f"{backend}: this build or CPU lacks it")
    rng = np.random.default_rng(1)
    for (height, width), srgb in ((size, s) for size in SIZES for s in (False, True)):
        radiance = (rng.random((height, width, 3)) ** 8 * 90).astype(F)
        color = rng.integers(0, 256, (height, width, 4), np.uint8)
        wanted = expected(radiance, color, 0.7, srgb)
        for threads in (1, 2, 5):
            got = color.copy()
            scratch = np.empty(rasterizer.bloom_scratch(width, height, threads), F)
            number = rasterizer.BACKENDS[backend]
            rasterizer.add_bloom(radiance, got, 0.7, srgb, number, threads, scratch)
            assert np.array_equal(got, wanted), (height, width, srgb, threads)


def test_a_single_bright_number():
    """Wherever it is, it glows: in the last pixel of a row as well."""
    for place in ((0, 0, 0), (36, 66, 2), (20, 66, 0), (36, 1, 1)):
        radiance = np.zeros((37, 67, 3), F)
        radiance[place] = 30
        color = np.full((37, 67, 4), 20, np.uint8)
        for backend in e3d.backends():
            got, scratch = color.copy(), np.empty(rasterizer.bloom_scratch(67, 37, 2), F)
            number = rasterizer.BACKENDS[backend]
            rasterizer.add_bloom(radiance, got, 1.0, True, number, 2, scratch)
            assert np.array_equal(got, expected(radiance, color, 1.0, True))
            assert got[place] > 20


def test_what_glows():
    """Around what is bright it is brighter, elsewhere the same; alpha stays everywhere."""
    scene = lamps(None)
    for options in ({}, {"samples": 4, "tone_mapping": "agx"}):
        plain = e3d.render(scene, size=(200, 150), outputs=("color", "radiance"), **options)
        glowing = e3d.render(scene, size=(200, 150), bloom=0.5, **options)
        assert glowing.outputs == ("color",)
        assert np.array_equal(glowing.color, expected(plain.radiance, plain.color, 0.5, True))
        assert (glowing.color >= plain.color).all() and (glowing.color != plain.color).any()


def test_dark_scenes_and_other_modes_stay():
    scene = lamps()
    dim = e3d.Scene((30, 38, 54))
    dim.add(e3d.box(1))
    for one, options in ((scene, {"mode": "normal"}), (scene, {"mode": "overdraw"}), (dim, {})):
        plain = e3d.render(one, size=(80, 60), **options)
        assert np.array_equal(plain.color, e3d.render(one, size=(80, 60), bloom=3, **options).color)


def test_bad_strengths():
    for bloom in (-1, 101, float("nan"), "much"):
        with pytest.raises(e3d.InvalidArgumentError, match="bloom"):
            e3d.render(e3d.Scene(), size=(8, 8), bloom=bloom)

"""The kernels of bloom against R124, row by row."""

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO, clamp
from kernels.harness import all_backends, bits
from kernels.layouts import PAD

MOST_BLOOM = np.float32(64)
THREE, EIGHTH, QUARTER = np.float32([3, 0.125, 0.25])
WIDTHS = (1, 2, 3, 4, 5, 15, 16, 17, 63, 64, 65, 200, 333)


def rows_of(rng, count, width):
    return [rng.uniform(0, 3, width).astype(np.float32) for _ in range(count)]


def filtered(a, b, c, d):
    return ((a + d) + (b + c) * THREE) * EIGHTH


def mixed(near, far):
    return near * (ONE - QUARTER) + far * QUARTER


def spread(row, width):
    """A row of twice as many: each is mixed with the neighbour on its side."""
    x = np.arange(width)
    far = np.clip(x // 2 + np.where(x % 2 == 1, 1, -1), 0, len(row) - 1)
    return mixed(row[x // 2], row[far])


@all_backends
@pytest.mark.parametrize("width", WIDTHS)
def test_what_is_bright(kernels, width):
    rng = np.random.default_rng(width)
    for low in (0.2, 3.0):
        rows = [(light - low) * 40 for light in rows_of(rng, 4, 3 * width)]
        planes = np.full((3, width + PAD), 7, np.float32)
        found = kernels.bloom_bright(rows, width, planes)
        light = [clamp(row - ONE, ZERO, MOST_BLOOM) for row in rows]
        expected = filtered(*light).reshape(width, 3).T
        assert np.array_equal(bits(planes[:, :width]), bits(np.ascontiguousarray(expected)))
        assert (planes[:, width:] == 7).all()
        assert bool(found) == (expected > 0).any() == (low < 1)


@all_backends
@pytest.mark.parametrize("width", WIDTHS)
def test_rows(kernels, width):
    """Filtered, halved, mixed and spread: plain numbers, each as the rule says it."""
    rng = np.random.default_rng(width)
    rows, half = rows_of(rng, 4, width), (width + 1) // 2
    out = np.full(width + PAD, 7, np.float32)
    kernels.bloom_rows(rows, width, out)
    assert np.array_equal(bits(out[:width]), bits(filtered(*rows)))
    x = 2 * np.arange(half)[:, None] + np.arange(-1, 3)
    kernels.bloom_halve(rows[0], width, out)
    expected = filtered(*rows[0][np.clip(x, 0, width - 1)].T)
    assert np.array_equal(bits(out[:half]), bits(expected))
    kernels.bloom_mix(rows[0], rows[1], width, out)
    assert np.array_equal(bits(out[:width]), bits(mixed(rows[0], rows[1])))
    small, before = rows[2][:half].copy(), rows[3].copy()
    kernels.bloom_spread(small, width, False, out)
    assert np.array_equal(bits(out[:width]), bits(spread(small, width)))
    kernels.bloom_spread(small, width, True, before)
    assert np.array_equal(bits(before), bits(rows[3] + spread(small, width)))
    assert (out[width:] == 7).all()


@all_backends
@pytest.mark.parametrize("srgb", [False, True])
def test_the_glow_is_laid(kernels, srgb):
    """Codes are decoded, lightened and encoded; where nothing glows they stay."""
    rng = np.random.default_rng(3)
    decode = np.linspace(0, 1, 256).astype(np.float32) ** (2 if srgb else 1)
    for width in WIDTHS:
        glow = np.zeros((3, width + PAD), np.float32)
        glow[:, :width] = rng.uniform(0, 4, (3, width)) * (rng.random(width) < 0.5)
        glow[:, : width // 32 * 16] = 0  # whole vectors
        codes = rng.integers(0, 2**32, width, np.uint32)
        scale, got = np.float32(0.7), codes.copy()
        kernels.bloom_lay(glow, scale, decode, srgb, width, got)
        shown = decode[codes.view(np.uint8).reshape(width, 4)[:, :3].T]
        light = glow[:, :width] * scale
        share = light / (ONE + light)
        color = np.zeros((3, width + PAD), np.float32)
        color[:, :width] = shown + (ONE - shown) * share
        expected = np.empty(width + PAD, np.uint32)
        kernels.encode(*color, width, srgb, expected)
        expected = expected[:width] & 0xFFFFFF | codes & 0xFF000000
        glows = glow[:, :width].any(axis=0)
        assert np.array_equal(got[glows], expected[glows]), width
        dark = slice(0, width // 32 * 16)
        assert np.array_equal(got[dark], codes[dark])

"""texture against R28–R30."""

import functools
import itertools

import numpy as np
import pytest
from kernels.arithmetic import (
    ONE,
    UNORM8,
    UNORM8_BLENDED,
    UNORM15,
    UNORM15_BLENDED,
    clamp,
    floor,
    greatest,
    round_even,
)
from kernels.harness import all_backends, check_lanes, check_poisoned, hostile
from kernels.surfaces import (
    BATCHES,
    LANES,
    ROUNDS,
    fill,
    planes,
    random_batches,
)

from engine3d._native.rasterizer import FILTERS, WRAPS

UNITS = {
    (True, 8): UNORM8,
    (True, 16): UNORM15,
    (False, 8): UNORM8_BLENDED,
    (False, 16): UNORM15_BLENDED,
}
SIZES = [(1, 1), (2, 3), (16, 16), (37, 5), (1, 300), (256, 1), (1000, 3), (33, 64), (4099, 2)]
#: Along u and along v.
SIDE_WRAPS = list(itertools.product(WRAPS, repeat=2))


def chain_sizes(width, height, levels=16):
    """(levels, 2) int32: each side halved, rounded down, at least 1."""
    sizes = [(width, height)]
    while sizes[-1] != (1, 1) and len(sizes) < levels:
        sizes.append(tuple(max(1, side >> 1) for side in sizes[-1]))
    return np.array(sizes, np.int32)


def wrapped(s, wrap):
    """R29"""
    if wrap == "repeat":
        return greatest(s - np.floor(s), np.float32(0))
    s = clamp(s, np.float32(-(2.0**22)), np.float32(2.0**22))
    if wrap == "clamp":
        return clamp(s, np.float32(0), ONE)
    half = s * np.float32(0.5)
    m = (half - floor(half)) * np.float32(2)
    return np.where(m > 1, np.float32(2) - m, m)


def taps(s, size, wrap):
    """R30: the two columns (or rows) and the weight of the second."""
    p = round_even(s * (256 * size).astype(np.float32)).astype(np.int64) - 128
    low, weight = p >> 8, p & 255
    high = low + 1
    if wrap == "repeat":
        return np.where(low < 0, low + size, low), np.where(high >= size, high - size, high), weight
    return low.clip(0, size - 1), high.clip(0, size - 1), weight


def bilinear(texels, starts, sizes, level, s, t, wrap, bits):
    """R30 of a level for each lane; (…, 3)."""
    width, height = (sizes[level, k].astype(np.int64) for k in range(2))
    left, right, fx = taps(s, width, wrap[0])
    top, bottom, fy = taps(t, height, wrap[1])
    start = starts[level]

    fx, fy = fx[..., None], fy[..., None]

    def texel(row, column):
        return texels[start + row * width + column, :3].astype(np.int64)

    def across(row):
        return texel(row, left) * (255 - fx) + texel(row, right) * fx

    def down(column):
        upper, lower = texel(top, column), texel(bottom, column)
        return upper + (((lower - upper) * fy + 128) >> 8)

    if bits == 8:
        blended = across(top) * (255 - fy) + across(bottom) * fy
    else:
        blended = down(left) * (256 - fx) + down(right) * fx
    assert blended.max() < 2**24
    return blended.astype(np.float32)


def nearest(texels, sizes, s, t):
    width, height = (int(side) for side in sizes[0])
    column = np.minimum((s * np.float32(width)).astype(np.int64), width - 1)
    row = np.minimum((t * np.float32(height)).astype(np.int64), height - 1)
    return texels[row * width + column, :3].astype(np.int64)


def sampled(texels, sizes, filter_name, wrap, uv, lod, bits):
    """R29 and R30: (…, 3) values, in the texture's unit; ``wrap`` is along u and along v."""
    s, t = wrapped(uv[0], wrap[0]), wrapped(ONE - uv[1], wrap[1])
    if filter_name == "nearest":
        return nearest(texels, sizes, s, t)
    starts = np.concatenate([[0], np.cumsum(sizes[:, 0].astype(np.int64) * sizes[:, 1])])
    if filter_name == "bilinear":
        return bilinear(texels, starts, sizes, np.zeros_like(lod), s, t, wrap, bits)
    level, f = lod >> 8, (lod & 255).astype(np.float32)[..., None] * np.float32(2.0**-8)
    near = bilinear(texels, starts, sizes, level, s, t, wrap, bits)
    coarse = np.minimum(level + 1, len(sizes) - 1)
    far = bilinear(texels, starts, sizes, coarse, s, t, wrap, bits)
    return near + (far - near) * f


def stored(texels, sizes, wrap, bits):
    """The bytes of all levels as the kernels read them: within a border of one texel each.

    Those of 8 bits are signed; what stands behind them may be read.
    """
    levels, start = [], 0
    for width, height in sizes.tolist():
        level = texels[start : start + width * height].reshape(height, width, 4)
        for axis, side in ((1, wrap[0]), (0, wrap[1])):
            border = [(int(k == axis),) * 2 for k in range(3)]
            level = np.pad(level, border, "wrap" if side == "repeat" else "edge")
        level = (level.astype(np.int16) - 128).astype(np.int8) if bits == 8 else level
        levels.append(level.ravel().view(np.uint8))
        start += width * height
    return np.concatenate([*levels, np.full(16, 77, np.uint8)])


def numbers_of(wrap):
    """What kernels take for the wrap along u and along v."""
    return tuple(WRAPS[side] for side in wrap)


def random_coordinates(rng, shape, sizes):
    """Around the texture, on the edges of texels and halfway between them, and hostile."""
    uv = hostile(rng, shape, 2.5)
    for k in range(2):
        steps = rng.integers(-512, 1024, (shape[0], shape[2])) / (256.0 * sizes[0, k])
        grid = rng.integers(-4, 9, (shape[0], shape[2])) / (2.0 * sizes[0, k])
        kind = rng.random((shape[0], shape[2]))
        uv[:, k] = np.where(kind < 0.2, grid, np.where(kind < 0.4, steps, uv[:, k]))
    return uv


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def rounds(filter_name, bits, wrap):
    """Batches, what kernels take of a texture, and the colours that they must give."""
    unit, made = UNITS[filter_name == "nearest", bits], []
    number = SIDE_WRAPS.index(wrap)
    first, step = (number % 3, 3) if wrap[0] == wrap[1] else (number, ROUNDS)
    for seed in range(first, ROUNDS, step):
        rng = np.random.default_rng(seed)
        batches = random_batches(rng)
        sizes = chain_sizes(*SIZES[seed], levels=16 if filter_name == "trilinear" else 1)
        count = int((sizes[:, 0].astype(np.int64) * sizes[:, 1]).sum())
        most = 255 if bits == 8 else 32767
        texels = rng.choice([0, most, 1, most // 2 + 1], (count, 4)).astype(np.uint16)
        texels[::2] = rng.integers(0, most + 1, texels[::2].shape)
        given = stored(texels, sizes, wrap, bits)
        shape = batches.fields["uv"].shape
        uv = random_coordinates(rng, shape, sizes)
        base = hostile(rng, 3)
        lod = rng.integers(0, (len(sizes) - 1) * 256 + 1, (BATCHES, LANES)).astype(np.int32)
        lod[::3] &= ~255
        fill(batches, "uv", uv)
        batches.fields["lod"] = lod  # whole vectors look levels up
        values = sampled(texels, sizes, filter_name, wrap, planes(uv), lod, bits)
        expected = [values[..., k].astype(np.float32) * (base[k] * unit) for k in range(3)]
        texture = given, bits, sizes, FILTERS[filter_name], numbers_of(wrap), base
        made.append((batches, texture, expected))
    return made


@all_backends
@pytest.mark.parametrize("wrap", SIDE_WRAPS, ids="-".join)
@pytest.mark.parametrize(
    ("filter_name", "bits"),
    [("nearest", 8), ("bilinear", 8), ("nearest", 16), ("bilinear", 16), ("trilinear", 16)],
)
def test_texture(kernels, filter_name, bits, wrap):
    for template, texture, expected in rounds(filter_name, bits, wrap):
        batches = template.copy()
        for row in batches.rows:
            kernels.texture(row, *texture)
        for k in range(3):
            got = batches.fields["color"][:, k]
            check_lanes(f"color[{k}]", got, expected[k], batches.fields["count"])
        check_poisoned(batches.fields, ["weight", "r", "position", "normal", "energy", "shine"])
        batches.check_gaps()

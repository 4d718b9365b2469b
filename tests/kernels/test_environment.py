"""environment, irradiance, backdrop, albedo and lobe against R60-R64 and R68."""

import functools

import numpy as np
from kernels.arithmetic import ONE, ZERO, clamp, greatest, truncate
from kernels.calls import kernels_testing
from kernels.harness import POISON, all_backends, every_count, hostile
from kernels.layouts import CELL_GROUP, CELLS, LOBE_BLOCK, PAD

from engine3d._native.rasterizer import NativeEnvironment

TURN = (np.float32(0.8), np.float32(0.6))
INTENSITY = np.float32(0.7)
LAST = np.float32(8)
MOST = 300


@functools.cache
def picture():
    rng = np.random.default_rng(0)
    pixels = rng.random((64, 128, 3)).astype(np.float32) ** 8 * np.float32(20)
    pixels[20, 30] = 5000.0
    return pixels


@functools.cache
def levels():
    native = NativeEnvironment(picture(), 1)
    return [np.array(native.level(number)) for number in range(9)]


# ---- the rules ----


def places(d):
    """R60 of three arrays: face, p and q."""
    c, s = TURN
    x, y, z = c * d[0] - s * d[2], d[1], s * d[0] + c * d[2]
    a, b, m = np.abs(x), np.abs(y), np.abs(z)
    along_x, along_y = (a >= b) & (a >= m), b >= m
    axis = np.where(along_x, 0, np.where(along_y, 1, 2))
    negative = np.choose(axis, [x, y, z]) < ZERO
    across = [(ZERO - z, z), (x, x), (x, ZERO - x)]
    down = [(ZERO - y, ZERO - y), (z, ZERO - z), (ZERO - y, ZERO - y)]
    p = np.choose(axis, [np.where(negative, back, front) for front, back in across])
    q = np.choose(axis, [np.where(negative, back, front) for front, back in down])
    longest = np.choose(axis, [a, b, m])
    inverse = ONE / greatest(longest, np.float32(2.0**-100))
    return 2 * axis + negative, p * inverse, q * inverse


def mix(a, b, weight):
    return a + (b - a) * weight


def of_level(number, where):
    """R61: (N, 3)."""
    face, p, q = where
    texels = levels()[number]
    size = np.float32(texels.shape[1] - 2)
    half = size * np.float32(0.5)
    u, v = (
        clamp(k * half + (half + np.float32(0.5)), np.float32(0.5), size + np.float32(0.5))
        for k in (p, q)
    )
    column, row = truncate(u), truncate(v)
    f, g = (u - column.astype(np.float32))[:, None], (v - row.astype(np.float32))[:, None]
    t = [[texels[face, row + j, column + i, :3] for i in (0, 1)] for j in (0, 1)]
    return mix(mix(*t[0], f), mix(*t[1], f), g)


def radiance(d, level):
    """R62: (N, 3)."""
    where = places(d)
    each = np.stack([of_level(number, where) for number in range(9)])
    bounded = clamp(level, ZERO, LAST)
    fine = np.minimum(truncate(bounded), 7)
    between = (bounded - fine.astype(np.float32))[:, None]
    rows = np.arange(len(level))
    return mix(each[fine, rows], each[fine + 1, rows], between) * INTENSITY


def albedo(table, roughness, cosine):
    """R64."""
    x = clamp(roughness, ZERO, ONE) * np.float32(63)
    y = np.sqrt(clamp(cosine, ZERO, ONE)) * np.float32(63)
    i, j = (np.minimum(truncate(at), 62) for at in (x, y))
    f, g = x - i.astype(np.float32), y - j.astype(np.float32)
    a, b = (mix(table[i + k, j], table[i + k, j + 1], g) for k in (0, 1))
    return mix(a, b, f)


# ---- directions that lie anywhere, on edges and corners too ----


def directions(rng, count):
    """Three rows, with a pad that means nothing."""
    d = hostile(rng, (3, count), 2.0, 0.02)
    kind = rng.random(count)
    corner = rng.choice([-1, 1, 0], (3, count)).astype(np.float32)
    d = np.where(kind < 0.3, corner, d)
    d[0] = np.where((kind > 0.3) & (kind < 0.4), d[1], d[0])
    return np.concatenate([d, np.full((3, PAD), np.nan, np.float32)], axis=1)


def poisoned(rows, count):
    return np.full((rows, count + 4 * PAD), POISON, np.uint32).view(np.float32)


def check(got, expected, count):
    """(3, N) against (N, 3), to the bit but for kinds of no number; nothing beyond the pad."""
    promised = got[:, :count]
    same = (promised == expected.T) | (np.isnan(promised) & np.isnan(expected.T))
    assert same.all(), np.argwhere(~same)[:4]
    assert (got.view(np.uint32)[:, count + PAD :] == POISON).all()


@functools.cache  # for all backends
def lookups():
    """Directions, levels, how many, and what shows there."""
    rng, made = np.random.default_rng(1), []
    for count in (1, 2, 7, 16, 17, MOST):
        d = directions(rng, count)
        level = hostile(rng, count + PAD, 12.0)
        level[: count // 4] = rng.integers(0, 9, count // 4)
        made.append((d, level, count, radiance(d[:, :count], level[:count])))
    return made


@all_backends
def test_environment(kernels):
    for d, level, count, expected in lookups():
        got = poisoned(3, count)
        kernels.environment(picture(), TURN, INTENSITY, d, level, count, got)
        check(got, expected, count)


@all_backends
def test_irradiance(kernels):
    rng = np.random.default_rng(2)
    for count in (1, 5, 16, MOST):
        d = directions(rng, count)
        got = poisoned(3, count)
        kernels.irradiance(picture(), TURN, INTENSITY, d, count, got)
        check(got, of_level(8, places(d[:, :count])) * INTENSITY, count)


@functools.cache  # for all backends
def rows_of_pixels():
    """A level, rays, the first pixel, how many, and what shows there."""
    rng, made = np.random.default_rng(3), []
    for level in (0.0, 0.25, 1.0, 4.5, 8.0, 9.0, -1.0, np.nan):
        rays = rng.uniform(-1, 1, (3, 3)).astype(np.float32)
        rays[1:] *= np.float32(0.01)
        x, y, count = 37, 11, 64
        column = np.arange(x, x + count).astype(np.float32) + np.float32(0.5)
        row = np.float32(y) + np.float32(0.5)
        d = [(rays[0, k] + column * rays[1, k]) + row * rays[2, k] for k in range(3)]
        made.append((level, rays, (x, y), count, radiance(d, np.full(count, level, np.float32))))
    return made


@all_backends
def test_backdrop(kernels):
    for level, rays, place, count, expected in rows_of_pixels():
        got = poisoned(3, count)
        kernels.backdrop(picture(), TURN, INTENSITY, level, rays, *place, count, got)
        check(got, expected, count)


@all_backends
def test_albedo(kernels):
    rng = np.random.default_rng(4)
    for kind in range(3):
        table = np.array(kernels_testing.dfg_table(kind), np.float32)
        for count in every_count(rng, 40, 60):
            roughness, cosine = hostile(rng, (2, count + PAD), 1.2)
            got = poisoned(1, count)
            kernels.albedo(kind, roughness, cosine, int(count), got[0])
            expected = albedo(table, roughness[:count], cosine[:count])
            check(got, expected[:, None], count)


@all_backends
def test_lobe(kernels):
    rng = np.random.default_rng(5)
    for _ in range(50):
        group, block = np.zeros(1, CELL_GROUP), np.zeros(1, LOBE_BLOCK)
        for name in ("direction", "light", "weight"):
            group[name] = rng.uniform(-1, 1, group[name].shape)
        block["normal"] = rng.uniform(-1, 1, block["normal"].shape)
        block["sums"] = rng.random(block["sums"].shape)
        block["square"], block["rest"] = np.float32(0.01), np.float32(0.99)
        expected = block["sums"][0].copy()
        for cell in range(CELLS):
            x, y, z = (block["normal"][0, k] - group["direction"][0, k, cell] for k in range(3))
            m = (x * x + y * y) + z * z
            t = block["square"][0] + block["rest"][0] * (m * np.float32(0.25))
            share = greatest(ONE - m * np.float32(0.5), ZERO) / (t * t)
            for k in range(3):
                expected[k] = expected[k] + share * group["light"][0, k, cell]
            expected[3] = expected[3] + share * group["weight"][0, cell]
        kernels.lobe(group.view(np.uint8), block.view(np.uint8))
        assert np.array_equal(block["sums"][0], expected)

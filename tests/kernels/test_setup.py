"""setup against R4–R7, R9 and R10: which triangles of a cluster stay.

Those that are small, boxes of at most 4 x 4 samples and sides of at most 16383 steps, are listed
apart where fragments are asked for. It may keep what only 64 bits can decide (boxes wider than
32767 steps of 1/256 sample), and what covers none of the samples of its box; nothing else that the
rules drop. It must keep all that they keep.
"""

import numpy as np
import pytest
from kernels import layouts
from kernels.harness import Records, all_backends, every_count
from kernels.layouts import CLUSTER_TRIANGLES, CLUSTER_VERTICES, SURVIVORS, VERTICES, viewport_of

CALLS = 6000
ROUNDS = 3  # with CALLS: 10^6 triangles and more
SIZES = [(1, 1), (16, 16), (640, 480), (65536, 65536), (1, 4096), (37, 23)]
WIDE = 32767
SMALL, SMALL_REACH = 4, 16383  # samples a side, steps


def random_positions(rng, viewport):
    """(calls, vertices) snapped coordinates: near each other, on sample centres, far outside."""
    shape = (CALLS, CLUSTER_VERTICES)
    half = 128 * viewport[:, None].astype(np.int64)
    spread = 2 ** rng.integers(1, 25, (CALLS, 1))
    spread[::3] = 1024
    position = half + rng.integers(-spread, spread + 1, shape)
    grid = rng.choice([1, 128, 256], (CALLS, 1))
    return (position // grid * grid).clip(-(2**26), 2**26).astype(np.int32)


def random_codes(rng):
    shape = (CALLS, CLUSTER_VERTICES)
    flags = (rng.random((*shape, 10)) < rng.choice([0, 0.01, 0.3], (CALLS, 1, 1))).astype(np.int32)
    return (flags << np.arange(10)).sum(axis=-1).astype(np.int32)


def keep_inside(vertices, viewport):
    """In the viewport, where outcodes promise it, and some of them close together."""
    inside = vertices["special"] == 0
    for name, side in (("sx", "width"), ("sy", "height")):
        inside_position = vertices[name].clip(0, 256 * viewport[side][:, None])
        vertices[name] = np.where(inside[:, None], inside_position, vertices[name])


def sample_span(low, high, size):
    """R10, in 64 bits: the first and the last sample along one axis."""
    first = np.maximum(-((128 - low) // 256), 0)  # ceil((low - 128) / 256)
    return first, np.minimum((high - 128) // 256, size[:, None] - 1)


def survivors(x, y, code, viewport, cull):
    """(calls, triangles) bool: what is drawn as it is, what needs clipping, and what is small."""
    x, y = x.astype(np.int64), y.astype(np.int64)
    every = code[0] & code[1] & code[2]
    some = code[0] | code[1] | code[2]
    keep = ((every & layouts.OUTSIDE) == 0) & ((some & layouts.NONFINITE) == 0)
    clip = keep & ((some & layouts.CLIP) != 0)
    width, height = x.max(axis=0) - x.min(axis=0), y.max(axis=0) - y.min(axis=0)
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    known = np.maximum(width, height) <= WIDE
    wrong_side = (area == 0) | (np.sign(area) == np.where(cull == 0, 9, cull)[:, None])
    across = sample_span(x.min(axis=0), x.max(axis=0), viewport["width"].astype(np.int64))
    down = sample_span(y.min(axis=0), y.max(axis=0), viewport["height"].astype(np.int64))
    drop = known & wrong_side
    drop |= (across[0] > across[1]) | (down[0] > down[1])
    drop |= (some & layouts.BAD_SCREEN) != 0
    small = (across[1] - across[0] < SMALL) & (down[1] - down[0] < SMALL)
    return keep & ~clip & ~drop, clip, small & (np.maximum(width, height) <= SMALL_REACH)


def check_bits(name, got, expected):
    """A bit for each of the expected triangles, and no other."""
    bits = (expected.astype(np.uint64) << np.arange(CLUSTER_TRIANGLES, dtype=np.uint64)).sum(axis=1)
    assert np.array_equal(got, bits), name


@pytest.fixture(scope="module")
def clusters():
    """For all backends: of each round, what kernels are given, and what is to survive."""
    return [random_clusters(np.random.default_rng(seed)) for seed in range(ROUNDS)]


def random_clusters(rng):
    """The arguments of each call, and a bit for each triangle: drawn, small, clipped."""
    sizes = np.array(SIZES)[rng.integers(0, len(SIZES), CALLS)]
    viewport = np.concatenate([viewport_of(*size) for size in sizes])
    vertices = np.zeros(CALLS, VERTICES)
    vertices["sx"] = random_positions(rng, viewport["width"])
    vertices["sy"] = random_positions(rng, viewport["height"])
    vertices["code"] = random_codes(rng)
    vertices["special"] = vertices["code"].any(axis=1)
    keep_inside(vertices, viewport)
    vertices["count"] = rng.choice([3, 31, 32, 33, 63, 64, 65, CLUSTER_VERTICES], CALLS)
    shape = (CALLS, 3, CLUSTER_TRIANGLES)
    indices = rng.integers(0, vertices["count"][:, None, None], shape).astype(np.uint8)
    counts = every_count(rng, CLUSTER_TRIANGLES, CALLS)
    cull = rng.integers(-1, 2, CALLS).astype(np.int32)
    fragments = rng.random(CALLS) < 0.7
    fetched = [
        np.stack([np.take_along_axis(vertices[name], plane, 1) for plane in indices.swapaxes(0, 1)])
        for name in ("sx", "sy", "code")
    ]
    draw, clip, small = survivors(*fetched, viewport, cull)
    small &= draw & fragments[:, None]
    given = np.arange(CLUSTER_TRIANGLES) < counts[:, None]
    assert min((some & given).sum() for some in (draw & ~small, small, clip)) > CALLS
    expected = draw & ~small & given, small & given, clip & given
    return (vertices, indices, counts, cull, fragments, viewport), expected


@all_backends
def test_setup(kernels, clusters):
    for (vertices, indices, counts, cull, fragments, viewport), expected in clusters:
        out = Records(SURVIVORS, CALLS)
        survive = [
            kernels.setup(
                vertices[number : number + 1].view(np.uint8),
                indices[number].ravel(),
                int(counts[number]),
                int(cull[number]),
                bool(fragments[number]),
                viewport[number : number + 1].view(np.uint8),
                row,
            )
            for number, row in enumerate(out.rows)
        ]
        for name, bits in zip(("draw", "small", "clip"), expected, strict=True):
            check_bits(name, out.fields[name], bits)
        assert np.array_equal(survive, np.any(expected, axis=0).sum(axis=1))
        out.check_gaps()


@all_backends
def test_wide_triangles_stay(kernels):
    """Areas that do not fit 32 bits: none of their signs may be guessed."""
    rng = np.random.default_rng(9)
    viewport = viewport_of(65536, 65536)
    vertices = np.zeros(1, VERTICES)
    vertices["count"] = CLUSTER_VERTICES
    for spread in (WIDE + 1, 2**16, 2**20, 2**24, 2**25):
        vertices["sx"] = rng.integers(0, 2, CLUSTER_VERTICES) * spread + 2**23
        vertices["sy"] = rng.integers(0, 2, CLUSTER_VERTICES) * spread + 2**22
        indices = rng.integers(0, CLUSTER_VERTICES, (3, CLUSTER_TRIANGLES), np.uint8)
        x = vertices["sx"][0][indices].astype(np.int64)
        y = vertices["sy"][0][indices].astype(np.int64)
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        for cull in (-1, 0, 1):
            out = Records(SURVIVORS, 1)
            kernels.setup(
                vertices.view(np.uint8),
                indices.ravel(),
                64,
                cull,
                True,
                viewport.view(np.uint8),
                out.rows[0],
            )
            drawn = np.flatnonzero(
                np.unpackbits(out.fields["draw"].view(np.uint8), bitorder="little")
            )
            must_stay = np.flatnonzero((area != 0) & (np.sign(area) != (cull or 9)))
            assert set(must_stay) <= set(drawn)


def pattern_of(reach, offsets):
    """A sample pattern (R103); whoever passes its address keeps it."""
    words, count = np.zeros(2 + 2 * 16, np.int32), len(offsets)
    words[:2] = count, reach
    words[2 : 2 + count], words[18 : 18 + count] = np.transpose(offsets)
    return words


@all_backends
def test_boxes_between_samples(kernels):
    """With multisampling, triangles stay whose box has a sample of any pixel, and no others."""
    offsets = np.array([(-32, -96), (96, -32), (-96, 32), (32, 96)])
    pattern = pattern_of(96, offsets)
    viewport = viewport_of(64, 64)
    viewport["reach"], viewport["pattern"] = 96, pattern.ctypes.data
    indices = np.zeros((3, CLUSTER_TRIANGLES), np.uint8)
    count = CLUSTER_VERTICES // 3
    indices[:, :count] = np.arange(3 * count).reshape(count, 3).T
    for seed in range(60):
        rng = np.random.default_rng(seed)
        x, y = rng.integers(512, 15000, (2, 1, count)) + rng.integers(0, 200, (2, 3, count))
        vertices = np.zeros(1, VERTICES)
        vertices["sx"][0, : 3 * count], vertices["sy"][0, : 3 * count] = x.T.ravel(), y.T.ravel()
        vertices["count"], vertices["special"] = 3 * count, seed % 2  # by 16 bits, and by 32
        out = Records(SURVIVORS, 1)
        arguments = vertices.view(np.uint8), indices.ravel(), count, 0, False
        kernels.setup(*arguments, viewport.view(np.uint8), out.rows[0])
        inside = np.zeros(count, bool)
        for u, v in offsets:
            first = [-((128 + o - c.min(0)) // 256) for c, o in ((x, u), (y, v))]
            last = [(c.max(0) - 128 - o) // 256 for c, o in ((x, u), (y, v))]
            inside |= (first[0] <= last[0]) & (first[1] <= last[1])
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        expected = inside & (area != 0)
        assert 0 < expected.sum() < count
        got = int(out.fields["draw"][0])
        assert got == sum(1 << int(n) for n in np.flatnonzero(expected)), seed

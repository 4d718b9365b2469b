"""fragments against R9, R10 and R12-R14: what small triangles cover.

Small is a box of at most 4 x 4 samples, at least one, and sides of at most 16383 steps. The oracle
works in 64 bits; the order of fragments says nothing, so both sides are sorted.
"""

import numpy as np
import pytest
from kernels.arithmetic import clamp, greatest, least
from kernels.harness import Records, all_backends, bits, every_count
from kernels.layouts import (
    CLUSTER_VERTICES,
    FRAGMENTS,
    PAD,
    SMALL_TRIANGLES,
    SMALLS,
    TILE,
    viewport_of,
)
from kernels.test_record import (
    CALLS,
    KINDS,
    SIZES,
    area_of,
    corners_of,
    exchange,
    make_vertices,
    plane_of,
    sample_span,
)

BATCHES = 700  # with four kinds: 500,000 triangles and more
REACH = 16383
SIDE = 4


def boxes(rng, size, shape):
    """About where boxes and sides stop to be small."""
    at = (256 * size * rng.random((CALLS, 1))).astype(np.int64)
    spread = rng.choice([300, 520, 700, 900], (CALLS, 1))
    return at + rng.integers(-spread, spread + 1, shape)


def edges(rng, size, shape):
    """Long triangles of which the viewport leaves a small box."""
    reach = rng.choice([REACH - 1, REACH, REACH + 1], (CALLS, 1))
    at = rng.choice([0, 256], (CALLS, 1)) * size + rng.integers(-600, 600, (CALLS, 1))
    return at + rng.choice([-1, 0, 1], (CALLS, 1)) * reach * rng.integers(0, 2, shape)


KINDS["boxes"], KINDS["edges"] = boxes, edges


def inside_of(x, y, column, row):
    """R12 at samples."""
    inside = np.ones(column.shape, bool)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        a, b = y[i] - y[j], x[j] - x[i]
        edge = a * (256 * column + 128 - x[i]) + b * (256 * row + 128 - y[i])
        inside &= (edge > 0) | ((edge == 0) & ((a > 0) | ((a == 0) & (b > 0))))
    return inside


def is_small(x, y, sizes):
    """What the kernel may be given."""
    across, down = sample_span(x, sizes[0]), sample_span(y, sizes[1])
    some = (across[0] <= across[1]) & (down[0] <= down[1]) & (area_of(x, y) != 0)
    small = (across[1] - across[0] < SIDE) & (down[1] - down[0] < SIDE)
    return some & small & (np.maximum(np.ptp(x, axis=0), np.ptp(y, axis=0)) <= REACH)


def expectation(c, sizes):
    """For each sample of each triangle's box: whether it is covered, its depth and place."""
    area = area_of(c["sx"], c["sy"])
    exchange(c, area < 0)
    x, y, zn = c["sx"], c["sy"], c["zn"]
    across, down = sample_span(x, sizes[0]), sample_span(y, sizes[1])
    z0, gx, gy = plane_of(c, np.abs(area), across, down)
    keep = np.isfinite(z0) & np.isfinite(gx) & np.isfinite(gy)
    lo, hi = least(least(zn[0], zn[1]), zn[2]), greatest(greatest(zn[0], zn[1]), zn[2])
    tiles_x = (sizes[0] + TILE - 1)[:, None] // TILE
    covered, depths, places = [], [], []
    for sample in range(SIDE * SIDE):
        dx, dy = sample % SIDE, sample // SIDE
        column, row = across[0] + dx, down[0] + dy
        shown = keep & (column <= across[1]) & (row <= down[1])
        covered.append(shown & inside_of(x, y, column, row))
        depths.append(clamp((z0 + np.float32(dx) * gx) + np.float32(dy) * gy, lo, hi))
        tile = row // TILE * tiles_x + column // TILE
        places.append(tile * TILE * TILE + row % TILE * TILE + column % TILE)
    return np.stack(covered, -1), np.stack(depths, -1), np.stack(places, -1)


def small_triangles(rng, kind, viewport, sizes):
    """Batches of small triangles first, then others; how many are small; their corners."""
    vertices = make_vertices(rng, kind, viewport)[:BATCHES]
    indices = rng.integers(0, CLUSTER_VERTICES, (BATCHES, 3, 4 * SMALLS), np.uint8)
    every = np.tile(np.arange(4 * SMALLS), (BATCHES, 1))
    corners = corners_of(vertices, indices, every)
    small = is_small(corners["sx"], corners["sy"], sizes)
    first = np.argsort(~small, axis=1, kind="stable")[:, :SMALLS]
    corners = corners_of(vertices, indices, first)
    counts = np.minimum(small.sum(axis=1), every_count(rng, SMALLS, BATCHES))
    triangles = np.zeros(BATCHES, SMALL_TRIANGLES)
    triangles["count"] = counts
    triangles["id"] = rng.integers(1 << 30, 2**31, (BATCHES, SMALLS + PAD))
    for name, source in (("x", "sx"), ("y", "sy"), ("zn", "zn")):
        triangles[name][..., :SMALLS] = corners[source].swapaxes(0, 1)
    return triangles, counts, corners


@all_backends
@pytest.mark.parametrize("kind", ["everywhere", "tiny", "boxes", "edges"])
def test_fragments(kernels, kind):
    rng = np.random.default_rng(3)
    choice = SIZES[:3] if kind == "edges" else SIZES
    chosen = np.array(choice)[rng.integers(0, len(choice), CALLS)]
    viewport = np.concatenate([viewport_of(*size) for size in chosen])
    sizes = chosen[:BATCHES].T
    triangles, counts, corners = small_triangles(rng, kind, viewport, sizes)

    out = Records(FRAGMENTS, BATCHES)
    for n in range(BATCHES):
        kernels.fragments(
            triangles[n : n + 1].view(np.uint8),
            viewport[n : n + 1].view(np.uint8),
            int(sizes[0][n] + TILE - 1) // TILE,
            out.rows[n],
        )
    out.check_gaps()

    with np.errstate(all="ignore"):
        covered, depths, places = expectation(corners, sizes)
    covered &= (np.arange(SMALLS) < counts[:, None])[..., None]
    got = out.fields
    assert np.array_equal(got["count"], covered.sum(axis=(1, 2)))
    assert np.array_equal(got["triangles"], covered.any(axis=2).sum(axis=1))
    assert kind == "everywhere" or covered.sum() > 1000
    assert kind != "boxes" or (covered.reshape(-1, SIDE * SIDE).sum(axis=0) > 100).all()
    for n in range(BATCHES):
        count = got["count"][n]
        ids = np.broadcast_to(triangles["id"][n, :SMALLS, None], covered[n].shape)
        expected = [v[covered[n]] for v in (ids, places[n].astype(np.uint32), bits(depths[n]))]
        made = [got["id"][n, :count], got["place"][n, :count], bits(got["z"][n, :count])]
        for some in (expected, made):
            some[:] = np.array(some)[:, np.lexsort(some[:2])]
        assert np.array_equal(made, expected), f"batch {n}"

"""fragments against R9, R10 and R12-R14: what small triangles cover, in lists of their tiles.

Small is a box of at most 4 x 4 samples, at least one, and sides of at most 16383 steps. The oracle
works in 64 bits; of the order of fragments only that matters that those of a triangle in a tile
follow each other, so both sides are sorted.
"""

import functools

import numpy as np
import pytest
from kernels.arithmetic import clamp, greatest, least
from kernels.harness import POISON, all_backends, bits, every_count
from kernels.layouts import (
    BIN,
    CLUSTER_VERTICES,
    FRAGMENT_LINK,
    LINK_FRAGMENTS,
    MOST_FRAGMENTS,
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

BATCHES = 350  # with four kinds: 250,000 triangles and more
REACH = 16383
SIDE = 4
NO_LINK = 0xFFFFFFFF


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


class Lists:
    """The bins of a picture's tiles, and links of fragments for so many calls."""

    def __init__(self, tiles, calls):
        self.bins = np.full(2 * tiles, NO_LINK, np.uint32).view(BIN)
        most = min(tiles, MOST_FRAGMENTS) + MOST_FRAGMENTS // (LINK_FRAGMENTS - PAD)
        words = np.full(calls * most * FRAGMENT_LINK.itemsize // 4, POISON, np.uint32)
        self.links = words.view(FRAGMENT_LINK)
        self.count = 0

    def add(self, kernels, triangles, viewport, tiles_x):
        """How many fragments there are more, and of how many triangles."""
        self.count, *made = kernels.fragments(
            triangles.view(np.uint8),
            viewport.view(np.uint8),
            tiles_x,
            self.links.view(np.uint8),
            self.bins.view(np.uint8),
            self.count,
        )
        return made

    def owners(self):
        """The tile whose chain each link in use is in: each is in one."""
        owner = np.full(self.count, -1)
        tiles = np.flatnonzero(self.bins["first"] != NO_LINK)
        links = self.bins["first"][tiles]
        while len(links):
            assert (owner[links] < 0).all()
            owner[links] = tiles
            after = self.links["next"][links]
            assert np.array_equal(after == NO_LINK, self.bins["last"][tiles] == links)
            tiles, links = tiles[after != NO_LINK], after[after != NO_LINK]
        assert (owner >= 0).all()
        return owner

    def fragments(self):
        """ID, place in the picture, depth's bits of each, sorted."""
        used = self.links[: self.count]
        assert (used["count"] > 0).all() and (used["count"] <= LINK_FRAGMENTS).all()
        assert (self.links[self.count :].view(np.uint32) == POISON).all()
        there = np.arange(LINK_FRAGMENTS) < used["count"][:, None]
        places = self.owners()[:, None] * TILE * TILE + used["sample"]
        return in_order(used["id"][there], places[there], bits(used["z"][there]))

    def check_order(self):
        """In each tile's chain, the fragments of a triangle follow each other."""
        for link in self.bins["first"][self.bins["first"] != NO_LINK]:
            ids = []
            while link != NO_LINK:
                ids.append(self.links["id"][link, : self.links["count"][link]])
                link = self.links["next"][link]
            ids = np.concatenate(ids)
            assert (np.diff(ids) != 0).sum() + 1 == len(np.unique(ids))


def in_order(ids, places, depths):
    rows = np.array([ids, places, depths], np.int64)
    return rows[:, np.lexsort(rows[:2])]


@functools.lru_cache(maxsize=1)  # the backends of a kind follow each other
def batches(kind):
    """Triangles, viewport and sizes of each batch, the calls it takes, what lists must then hold.

    That is, of one call: the number of fragments, and of triangles that have some.
    """
    rng = np.random.default_rng(3)
    choice = SIZES[:3] if kind == "edges" else SIZES
    chosen = np.array(choice)[rng.integers(0, len(choice), CALLS)]
    viewport = np.concatenate([viewport_of(*size) for size in chosen])
    sizes = chosen[:BATCHES].T
    triangles, counts, corners = small_triangles(rng, kind, viewport, sizes)

    with np.errstate(all="ignore"):
        covered, depths, places = expectation(corners, sizes)
    covered &= (np.arange(SMALLS) < counts[:, None])[..., None]
    assert kind == "everywhere" or covered.sum() > 1000
    assert kind != "boxes" or (covered.reshape(-1, SIDE * SIDE).sum(axis=0) > 100).all()
    made = []
    for n in range(BATCHES):
        calls = 1 + n % 3  # the same triangles again: chains go on
        ids = np.broadcast_to(triangles["id"][n, :SMALLS, None], covered[n].shape)
        expected = [v[covered[n]] for v in (ids, places[n], bits(depths[n]))]
        expected = in_order(*(np.tile(values, calls) for values in expected))
        numbers = [covered[n].sum(), covered[n].any(axis=1).sum()]
        given = triangles[n : n + 1], viewport[n : n + 1], sizes[:, n]
        made.append((given, calls, numbers, expected))
    return made


@all_backends
@pytest.mark.parametrize("kind", ["everywhere", "tiny", "boxes", "edges"])
def test_fragments(kernels, kind):
    for n, ((triangles, viewport, size), calls, numbers, expected) in enumerate(batches(kind)):
        tiles = (size + TILE - 1) // TILE
        lists = Lists(tiles.prod(), calls)
        for _ in range(calls):
            assert lists.add(kernels, triangles, viewport, int(tiles[0])) == numbers
        assert np.array_equal(lists.fragments(), expected), f"batch {n}"
        if calls == 1:
            lists.check_order()

"""raster_visible, raster_fragments, raster_settle and raster_measure against R10, R12 and R14-R16.

The oracle takes one record after the other in the order of R16, at every sample of the tile, in 64
bits; it knows nothing of blocks. Kernels get the records of several workers in another order, in
several calls, between which depth bounds are measured; the settled tile must be the oracle's.
"""

import functools

import numpy as np
import pytest
from kernels import layouts
from kernels.arithmetic import clamp
from kernels.harness import POISON, all_backends, bits, hostile
from kernels.layouts import (
    BLOCK,
    CLUSTER_TRIANGLES,
    DRAWN_CLUSTER,
    FRAGMENT_ID,
    FRAGMENT_LINK,
    LINK_FRAGMENTS,
    RECORD,
    TILE,
    VISIBLE_TILE,
)
from kernels.pieces import Triangle, meta_of, plane_through
from kernels.test_raster import BEYOND_FAR, LARGEST, random_corners, random_tile

RECORDS = 60  # a tile
STRIPS = 127  # the longest side of what is drawn in strips
TILES = 40
TILE_BLOCKS = (TILE // BLOCK) ** 2
GUARD = 256  # bytes of poison around a tile
WORKERS = [1, 2, 4, 8]
KINDS = ["tiny"] * 4 + ["small", "medium", "centers", "sliver", "whole", "limit"]
LARGE = ["whole", "limit"]


# ---- records ----


def corners_of(rng, kind, tile_x, tile_y):
    """(3, 2) int64: corners of a triangle in 1/256 sample."""
    centre = 256 * (np.array([tile_x, tile_y]) + rng.uniform(0, TILE, 2))
    if kind == "tiny":
        return (centre + rng.uniform(-1, 1, (3, 2)) * rng.choice([256, 380])).astype(np.int64)
    if kind == "whole":  # most of the tile's blocks, or all
        return (centre + rng.uniform(-1, 1, (3, 2)) * 256 * rng.choice([150, 900])).astype(np.int64)
    if kind == "limit":  # where 16 bits stop to hold a step, or 32 an edge
        samples = rng.choice([TILE, STRIPS, STRIPS, 4 * TILE, 20 * TILE], 2)
        side = 256 * samples + rng.integers(-1, 2, 2)
        place = (centre - side * rng.random(2)).astype(np.int64)
        half = rng.permutation([(0, 0), (1, 0), (1, 1), (0, 1)])[:3]
        return place + half * side
    return random_corners(rng, kind, tile_x, tile_y)


def depths_of(rng, record, triangle, wild):
    """A plane through three corners; often one of few, so that depths are equal; or any finite."""
    few = np.float32([-0.0, 0.0, 0.25, 0.5, 1.0, BEYOND_FAR, 1.5])
    zn = rng.uniform(-0.1, 1.1, 3).astype(np.float32)
    zn = rng.choice([zn, np.full(3, rng.choice(few)), rng.choice(few, 3)])
    if wild and rng.random() < 0.5:
        zn = hostile(rng, 3, rate=1.0, finite=True)
    plane = np.array(plane_through(triangle, zn)).astype(np.float32)
    if wild and rng.random() < 0.5:
        plane = hostile(rng, 3, rate=1.0, finite=True)
    elif wild and rng.random() < 0.7:  # what overflows a few samples on, in both ways at once
        plane[1:] = rng.choice([-1, 1], 2) * 2 ** rng.uniform(118, 127.9, 2)
    if not np.isfinite(plane).all():
        return False
    record["z0"], record["gx"], record["gy"] = plane
    record["zmin"], record["zmax"] = zn.min(), zn.max()
    return True


def record_of(rng, kind, place, wild):
    """A random record that the tile's bin may have, and its triangle; or None."""
    width, height, tile_x, tile_y = place
    corners = corners_of(rng, kind, tile_x, tile_y)
    triangle = Triangle(corners[:, 0], corners[:, 1], width, height)
    if triangle.empty or triangle.right < tile_x or triangle.bottom < tile_y:
        return None
    if triangle.left >= tile_x + TILE or triangle.top >= tile_y + TILE:
        return None
    record, meta = np.zeros(1, RECORD), meta_of(triangle)
    if meta is None or not depths_of(rng, record, triangle, wild):
        return None
    record["x"], record["y"], record["meta"] = triangle.x, triangle.y, meta
    return record, triangle


def shown_in(place):
    """(TILE, TILE) bool: samples of the viewport."""
    width, height, tile_x, tile_y = place
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    return (columns < width - tile_x) & (rows < height - tile_y)


# ---- what the rules say ----


def draw(records, triangles, place):
    """R14-R16: depths, and each sample's number in `records`, or -1."""
    _, _, tile_x, tile_y = place
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    z, kept = np.full((TILE, TILE), BEYOND_FAR), np.full((TILE, TILE), -1, np.int32)
    for number in np.argsort(records["order"], kind="stable"):
        record, triangle = records[number], triangles[number]
        dx = (tile_x + columns - triangle.left).astype(np.float32)
        dy = (tile_y + rows - triangle.top).astype(np.float32)
        new = (record["z0"] + dx * record["gx"]) + dy * record["gy"]
        new = clamp(new, record["zmin"], record["zmax"])
        wins = triangle.covers(tile_x + columns, tile_y + rows) & (new < z)
        z[wins], kept[wins] = new[wins], number
    return z, kept


class Scene:
    """Records of a tile in the bins of several workers, and what they show."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        kinds = {0: ["budget", *KINDS], 2: LARGE}.get(seed % 5, KINDS)
        self.wild = seed % 4 == 1
        self.place = random_tile(rng, kinds[0])
        made = []
        while len(made) < RECORDS:
            one = record_of(rng, rng.choice(kinds), self.place, self.wild)
            made += [one] if one else []
        self.records = np.concatenate([record for record, _ in made])
        # Twos and threes of one order are pieces of one triangle: the first of them goes first.
        self.records["order"] = rng.permutation(RECORDS)[np.arange(RECORDS) * 2 // 3]
        self.z, self.kept = draw(self.records, [triangle for _, triangle in made], self.place)
        self.workers = WORKERS[seed % 4]
        self.table, self.ids = self._table(rng)
        self.arrivals = self._arrivals(rng)

    def _table(self, rng):
        """(workers, bytes) records, and each record's ID."""
        owner = rng.integers(0, self.workers, RECORDS)[self.records["order"]]
        table, ids = np.zeros((self.workers, RECORDS), RECORD), np.empty(RECORDS, np.uint32)
        filled = np.zeros(self.workers, int)
        for number, worker in enumerate(owner):
            table[worker, filled[worker]] = self.records[number]
            ids[number] = filled[worker] * self.workers + worker
            filled[worker] += 1
        return table.view(np.uint8), ids

    def _arrivals(self, rng):
        """The records' numbers in two orders: any, and from far to near."""
        return rng.permutation(RECORDS), np.argsort(-self.records["zmin"], kind="stable")

    @property
    def shown(self):
        return shown_in(self.place)

    def check(self, tile):
        """A settled tile shows what the oracle does."""
        ids = np.where(self.kept >= 0, self.ids[self.kept].astype(np.int32), -1)
        for name, expected in (("z", self.z), ("id", ids)):
            got = tile.fields[name][0, : TILE * TILE].reshape(TILE, TILE)
            differ = self.shown & (bits(got) != bits(expected))
            assert not differ.any(), f"{name} at (row, column) {np.argwhere(differ)[0]}"


@functools.cache
def scene(seed):
    with np.errstate(all="ignore"):
        return Scene(seed)


# ---- a tile ----


class Tile:
    """An empty tile in the middle of poison; its samples are poison, too: they are only noted."""

    def __init__(self, x, y):
        size = VISIBLE_TILE.itemsize
        room = np.full((GUARD + size + GUARD) // 4 + 16, POISON, np.uint32)
        start = (-room.ctypes.data - GUARD) % 64 // 4
        self._room = room[start : start + (GUARD + size + GUARD) // 4].view(np.uint8)
        self.bytes = self._room[GUARD : GUARD + size]
        self.fields = self.bytes.view(VISIBLE_TILE)
        self.fields["zmin"] = self.fields["zmax"] = BEYOND_FAR
        self.fields["noted_id"], self.fields["noted"], self.fields["stale"] = -1, 2**64 - 1, 0
        self.fields["x"], self.fields["y"] = x, y

    def settled(self, kernels, table):
        """A copy with all samples written."""
        other = Tile(0, 0)
        other.bytes[:] = self.bytes
        kernels.raster_settle(other.bytes, table)
        other.check_poison()
        assert other.fields["noted"] == 0
        return other

    def check_settled_ids(self, kernels, table, settled):
        """Where no depths are asked for: the same IDs, and no depth is written."""
        other = Tile(0, 0)
        other.bytes[:] = self.bytes
        kernels.raster_settle(other.bytes, table, False)
        other.check_poison()
        assert other.fields["noted"] == self.fields["noted"]
        assert np.array_equal(other.fields["id"], settled.fields["id"])
        assert np.array_equal(bits(other.fields["z"]), bits(self.fields["z"]))

    def check_poison(self):
        edges = np.concatenate([self._room[:GUARD], self._room[-GUARD:]]).view(np.uint32)
        assert (edges == POISON).all()

    def blocks(self):
        """Nearest and farthest depth of each block of a settled tile."""
        z = self.fields["z"][0, : TILE * TILE].reshape(TILE // BLOCK, BLOCK, TILE // BLOCK, BLOCK)
        return z.min(axis=(1, 3)).ravel(), z.max(axis=(1, 3)).ravel()

    def measure(self, kernels):
        """Measure the blocks that aren't noted; each one's columns, and NaN of those that are."""
        columns = np.full((TILE_BLOCKS, BLOCK), np.nan, np.float32)
        kernels.raster_measure(self.bytes, columns)
        noted = (self.fields["noted"] >> np.arange(TILE_BLOCKS, dtype=np.uint64)) & np.uint64(1)
        assert self.fields["stale"] == 0
        assert np.array_equal(np.isnan(columns).all(axis=1), noted == 1)
        return columns

    def check_columns(self, columns):
        """The columns' depths, of a settled tile, are those that were measured."""
        z = self.fields["z"][0, : TILE * TILE].reshape(TILE // BLOCK, BLOCK, TILE // BLOCK, BLOCK)
        written = ~np.isnan(columns)
        assert np.array_equal(columns[written], z.max(axis=1).reshape(-1, BLOCK)[written])

    def check_bounds(self, settled, exact):
        """What is said of each block's depths."""
        nearest, farthest = settled.blocks()
        assert (self.fields["zmin"] <= nearest).all()
        assert (self.fields["zmax"] >= farthest).all()
        assert not exact or (self.fields["zmax"] == farthest).all()


def draw_parts(kernels, scene, arrival, parts, measured):
    """Draw in `parts` calls, check the bounds after each, and return the tile."""
    tile = Tile(*scene.place[2:])
    for part in np.array_split(arrival, parts):
        kernels.raster_visible(tile.bytes, scene.table, scene.ids[part])
        tile.check_bounds(tile.settled(kernels, scene.table), exact=False)
        if measured:
            columns, settled = tile.measure(kernels), tile.settled(kernels, scene.table)
            settled.check_columns(columns)
            tile.check_bounds(settled, exact=not scene.wild)
        tile.check_poison()
    return tile


# ---- tests ----


@all_backends
@pytest.mark.parametrize(("parts", "measured"), [(1, False), (5, True), (RECORDS, True)])
def test_what_shows(kernels, parts, measured):
    for seed in range(TILES):
        some = scene(seed)
        for arrival in some.arrivals:
            tile = draw_parts(kernels, some, arrival, parts, measured)
            settled = tile.settled(kernels, some.table)
            some.check(settled)
            tile.check_settled_ids(kernels, some.table, settled)


def test_scenes_are_hard():
    """There are tiny ones, the largest, all numbers of workers, and ties of both zeros."""
    scenes = [scene(seed) for seed in range(TILES)]
    records = np.concatenate([some.records for some in scenes])
    assert ((records["meta"] & layouts.RECORD_TINY) != 0).sum() > 100
    assert any(some.place[0] == LARGEST for some in scenes)
    zeros = np.concatenate([some.z[some.z == 0] for some in scenes])
    assert np.signbit(zeros).sum() > 1000 and (~np.signbit(zeros)).sum() > 1000
    assert {some.workers for some in scenes} == set(WORKERS)


class Fragments:
    """Fragments of the clusters of several workers; their orders mix with those of the records."""

    CLUSTERS = 3  # a worker

    def __init__(self, rng, scene):
        shape = (scene.workers, self.CLUSTERS)
        self.faces = 2 * rng.permuted(
            np.arange(np.prod(shape) * CLUSTER_TRIANGLES).astype(np.int32)
        ).reshape(*shape, CLUSTER_TRIANGLES)
        drawn = np.zeros(shape, DRAWN_CLUSTER)
        drawn["faces"] = self.faces.ctypes.data + 4 * CLUSTER_TRIANGLES * np.arange(
            drawn.size
        ).reshape(shape)
        drawn["order"] = 4
        self.drawn = drawn.view(np.uint8)
        self.links = [self._link(rng, scene, drawn["order"][0, 0]) for _ in range(8)]

    def _link(self, rng, scene, base):
        """A link, and the orders of its fragments."""
        link = np.zeros(1, FRAGMENT_LINK)
        count = rng.integers(0, LINK_FRAGMENTS + 1)
        corner, side = rng.integers(0, TILE - 8, 2), rng.choice([2, 8])
        at = corner + rng.integers(0, side, (count, 2))
        worker, cluster, triangle = (rng.integers(0, most, count) for most in (*self.faces.shape,))
        link["count"] = count
        link["sample"][0, :count] = at[:, 1] * TILE + at[:, 0]
        number = cluster * CLUSTER_TRIANGLES + triangle
        link["id"][0, :count] = FRAGMENT_ID | number * scene.workers | worker
        few = np.float32([-0.0, 0.0, 0.25, 0.5, 1.0, BEYOND_FAR, 1.5])
        near = scene.z[at[:, 1], at[:, 0]]
        link["z"][0, :count] = np.where(rng.random(count) < 0.5, rng.choice(few, count), near)
        return link, base + self.faces[worker, cluster, triangle]


@all_backends
def test_fragments_among_records(kernels):
    """In any order of arrival the least (depth, order) is kept."""
    met = 0
    for seed in range(TILES):
        rng, some = np.random.default_rng(seed), scene(seed)
        if some.wild:
            continue
        fragments, table = Fragments(rng, some), some.table.copy()
        table.view(RECORD)["order"] = table.view(RECORD)["order"] * 2 + 1  # the others are even
        z, ids = some.z.copy(), np.where(some.kept >= 0, some.ids[some.kept].astype(np.int32), -1)
        orders = np.where(some.kept >= 0, some.records["order"][some.kept] * 2 + 1, 2**31)
        tile = Tile(*some.place[2:])
        parts = np.array_split(some.arrivals[0], len(fragments.links))
        for part, (link, order) in zip(parts, fragments.links, strict=True):
            kernels.raster_visible(tile.bytes, table, some.ids[part], fragments.drawn)
            kernels.raster_fragments(tile.bytes, table, fragments.drawn, link.view(np.uint8))
            tile.check_poison()
            for i in range(link["count"][0]):
                at = divmod(link["sample"][0, i], TILE)
                new = link["z"][0, i]
                if new < z[at] or (new == z[at] and order[i] < orders[at]):
                    z[at], orders[at], ids[at] = new, order[i], link["id"][0, i]
        settled = tile.settled(kernels, table)
        tile.check_bounds(settled, exact=False)
        for name, expected in (("z", z), ("id", ids)):
            got = settled.fields[name][0, : TILE * TILE].reshape(TILE, TILE)
            differ = some.shown & (bits(got) != bits(expected))
            assert not differ.any(), f"{name} at (row, column) {np.argwhere(differ)[0]}"
        met += (some.shown & (ids >= FRAGMENT_ID)).sum()
    assert met > 300


@all_backends
def test_a_wall_hides_what_is_behind_it(kernels):
    """Nothing is unfolded behind a noted wall, nor where a farther tie comes; a nearer one is."""
    wall = Triangle(*(256 * np.array([(-99, -99), (999, -99), (-99, 999)])).T, TILE, TILE)
    records = np.zeros((1, 3), RECORD)
    records["x"], records["y"], records["meta"] = wall.x, wall.y, layouts.RECORD_FACE
    for name in ("z0", "zmin", "zmax"):
        records[name] = [0.5, 0.75, 0.25]
    tile = Tile(0, 0)
    for number, depth in ((0, 0.5), (1, 0.5), (2, 0.25)):
        kernels.raster_visible(tile.bytes, records.view(np.uint8), np.uint32([number]))
        assert tile.fields["noted"] == 2**64 - 1
        assert (tile.fields["zmin"] == depth).all() and (tile.fields["zmax"] == depth).all()
        assert (tile.fields["noted_id"] == (0 if depth == 0.5 else number)).all()
    assert (tile.bytes[: TILE * TILE * 4].view(np.uint32) == POISON).all()

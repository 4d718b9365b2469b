"""What multisampling draws, parts and lists, against R16 and R103 to R105.

The oracle takes one record after the other in the order of R16, at every sample of every pixel; it
knows nothing of blocks.
"""

import numpy as np
import pytest
from kernels import layouts
from kernels.arithmetic import clamp
from kernels.calls import record
from kernels.harness import all_backends, bits
from kernels.kernels import record_table
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    BLOCK,
    PAD,
    PIECE,
    RECORD,
    SHOWN,
    SHOWN_ROOM,
    TILE,
    TILE_BLOCKS,
    VISIBLE_TILE,
)
from kernels.pieces import Triangle, piece_of
from kernels.test_raster import BEYOND_FAR, random_corners, random_tile
from kernels.test_visible import shown_in

COUNTS = (2, 4, 8, 16)
RECORDS = 40
SAMPLES = TILE * TILE
ROWS, COLUMNS = np.mgrid[0:TILE, 0:TILE]
F = np.float32


def pattern_of(rng, count):
    offsets = rng.integers(-120, 121, (2, count))
    made = record("sample_pattern", count=count, reach=np.abs(offsets).max())
    made["x"][0, :count], made["y"][0, :count] = offsets
    return made


def offset(pattern, s):
    return np.array([pattern["x"][0, s], pattern["y"][0, s]], np.int64)


class Scene:
    """Records of a tile, and for each plane its depths and the number that shows, or -1."""

    def __init__(self, seed, count):
        rng = np.random.default_rng(seed)
        self.pattern = pattern_of(rng, count)
        self.place = random_tile(rng, "medium")
        self.z = np.full((count, TILE, TILE), BEYOND_FAR, F)
        self.ids = np.full((count, TILE, TILE), -1, np.int32)
        self.records = np.zeros(RECORDS, RECORD)
        self.records["order"], self.records["meta"] = np.arange(RECORDS), layouts.RECORD_FACE
        kinds = ["small", "medium", "medium", "centers", "sliver", "large"]
        for number in range(RECORDS):
            self._add(rng, number, str(rng.choice(kinds)))
        self.table = record_table(self.records.view(np.uint8)[None])

    def _corners(self, rng, kind):
        x, y = self.place[2:]
        if kind != "large":
            return random_corners(rng, kind, x, y)
        return 256 * (np.array([x, y]) + rng.uniform(-200, 260, (3, 2))).astype(np.int64)

    def _add(self, rng, number, kind):
        one, (width, height, tile_x, tile_y) = self.records[number], self.place
        while True:
            corners = self._corners(rng, kind)
            triangle = Triangle(corners[:, 0], corners[:, 1], width, height)
            if triangle.area and self._is_near(triangle):
                break
        steepness = rng.choice([0.0, 1e-4, 0.01])
        one["x"], one["y"] = triangle.x, triangle.y
        one["z0"], low, high = rng.choice([0.25, 0.5, *rng.uniform(-0.5, 1.1, 3)], 3)
        one["gx"], one["gy"] = rng.uniform(-steepness, steepness, 2)
        one["zmin"], one["zmax"] = min(low, high), max(low, high)
        reach = int(self.pattern["reach"][0])
        base = [max((int(v.min()) + 127 - reach) >> 8, 0) for v in (triangle.x, triangle.y)]
        dx, dy = (tile_x + COLUMNS - base[0]).astype(F), (tile_y + ROWS - base[1]).astype(F)
        for s in range(len(self.z)):
            u, v = offset(self.pattern, s)
            moved = Triangle(triangle.x - u, triangle.y - v, width, height)
            z0 = (one["z0"] + F(u / 256) * one["gx"]) + F(v / 256) * one["gy"]
            z = clamp((z0 + dx * one["gx"]) + dy * one["gy"], one["zmin"], one["zmax"])
            wins = moved.covers(tile_x + COLUMNS, tile_y + ROWS) & (z < self.z[s])
            self.z[s][wins], self.ids[s][wins] = z[wins], number

    def _is_near(self, triangle):
        """Whether the tile's bin may have it: its box touches the tile."""
        sides = zip((triangle.x, triangle.y), self.place[2:], self.place[:2], strict=True)
        return all(
            v.max() >= 256 * first and v.min() <= 256 * min(first + TILE, size)
            for v, first, size in sides
        )

    @property
    def shown(self):
        return shown_in(self.place)


def planes_at_lines(count, place):
    """Planes of which nothing is written, at a line of the cache as in a frame."""
    room = np.full(count * VISIBLE_TILE.itemsize + 64, 0xAD, np.uint8)
    start = -room.ctypes.data % 64
    planes = room[start:][: count * VISIBLE_TILE.itemsize].view(VISIBLE_TILE)
    planes["zmin"] = planes["zmax"] = BEYOND_FAR
    planes["noted_id"], planes["noted"], planes["stale"] = -1, 2**64 - 1, 0
    planes["x"], planes["y"] = place[2:]
    return planes


def of_samples(planes, name):
    return planes[name][:, :SAMPLES].reshape(-1, TILE, TILE)


@all_backends
@pytest.mark.parametrize("count", COUNTS)
def test_what_shows(kernels, count):
    """In several calls, between which planes are measured; bounds hold, and samples are settled."""
    for seed in range(3):
        scene, rng = Scene(10 * count + seed, count), np.random.default_rng(seed)
        planes, ids = planes_at_lines(count, scene.place), np.arange(RECORDS, dtype=np.uint32)
        for part in np.array_split(rng.permutation(ids), 4):
            kernels.raster_msaa(planes, scene.pattern, scene.table, part, len(part))
            columns = np.full((TILE_BLOCKS, BLOCK), np.nan, F)
            kernels.msaa_measure(planes, count, columns)
        bounds = planes[:1].copy()
        kernels.msaa_settle(planes, scene.pattern, scene.table)
        assert planes["noted"][0] == 0
        for name, expected in (("z", scene.z), ("id", scene.ids)):
            got = of_samples(planes, name)
            assert np.array_equal(bits(got[:, scene.shown]), bits(expected[:, scene.shown])), name
        blocks = of_samples(planes, "z").reshape(count, TILE // BLOCK, BLOCK, TILE // BLOCK, BLOCK)
        assert (bounds["zmin"][0] <= blocks.min(axis=(0, 2, 4)).ravel()).all()
        assert (bounds["zmax"][0] >= blocks.max(axis=(0, 2, 4)).ravel()).all()
        measured = ~np.isnan(columns)
        farthest = blocks.max(axis=(0, 2)).reshape(-1, BLOCK)
        assert np.array_equal(columns[measured], farthest[measured])


@all_backends
@pytest.mark.parametrize("count", COUNTS)
def test_pixels_are_parted_and_listed(kernels, count):
    scene = Scene(count, count)
    planes, shared = planes_at_lines(count, scene.place), planes_at_lines(1, scene.place)
    planes["id"][:, :SAMPLES], planes["noted"] = scene.ids.reshape(count, -1), 0
    differs = (scene.ids != scene.ids[0]).any(axis=0)
    for width, height in ((TILE, TILE), (1, 1), (37, 9)):
        mixed = np.zeros(TILE, np.uint64)
        gaps = kernels.msaa_split(planes, count, width, height, mixed, shared)
        got = (mixed[:height, None] >> np.arange(TILE, dtype=np.uint64) & np.uint64(1)).astype(bool)
        assert np.array_equal(got, differs[:height] & (np.arange(TILE) < width))
        own = of_samples(shared, "id")[0, :height, :width]
        alike = ~differs[:height, :width]
        assert np.array_equal(own, np.where(alike, scene.ids[0, :height, :width], -1))
        assert bool(gaps) == (alike & (own < 0)).any()
    check_list(kernels, planes, scene.ids.reshape(count, -1), np.flatnonzero(differs))


def check_list(kernels, planes, ids, pixels):
    """Each surface of a pixel is one colour, at the first sample that shows it."""
    runs, listed = np.zeros(SAMPLES + 2 * PAD, layouts.RUN), record("mixed_list")
    listed["pixels"], listed["pixel"][0, : len(pixels)] = len(pixels), pixels
    following, count = 0, len(ids)
    while following < len(pixels):
        first = following
        following = kernels.list_mixed(planes, count, first, runs, listed)
        assert first < following <= len(pixels)
        part, colors = pixels[first:following], int(listed["colors"][0])
        numbers, seen = listed["of"][0, :count, first:following], ids[:, part]
        empty = seen < 0
        assert (numbers[empty] == layouts.MIXED_BACKGROUND).all()
        assert np.array_equal(np.sort(np.unique(numbers[~empty])), np.arange(colors))
        assert np.array_equal(runs["length"][:colors], np.arange(colors))
        assert np.array_equal(runs["owner"][numbers[~empty]], seen[~empty])
        for k, pixel in enumerate(part):
            for n in np.unique(numbers[~empty[:, k], k]):
                s = int(np.flatnonzero(numbers[:, k] == n)[0])
                assert runs["sample"][n] == pixel | s << layouts.SHOWN_NUMBER
                assert np.array_equal(numbers[:, k] == n, seen[:, k] == seen[s, k])


@all_backends
@pytest.mark.parametrize("count", COUNTS)
def test_covers(kernels, count):
    """What a record covers of samples in front of what shows; of equal depths the first."""
    rng = np.random.default_rng(count)
    orders = np.zeros((1, 3), RECORD)
    orders["order"] = [[0, 5, 9]]
    ties = 0
    for _ in range(30):
        pattern, (width, height, x, y) = pattern_of(rng, count), random_tile(rng, "medium")
        corners = random_corners(rng, str(rng.choice(["small", "medium", "sliver"])), x, y)
        pieces, limit = np.zeros(count, PIECE), np.full((count, SAMPLES + PAD), BEYOND_FAR, F)
        kept = rng.choice([-1, 0, 2], limit.shape).astype(np.int32)
        live, cover = 0, np.zeros((TILE, TILE), np.int64)
        depth = rng.choice([0.25, rng.uniform(0, 1)])
        limit[:, :SAMPLES] = rng.choice([depth, 0.1, 0.9, BEYOND_FAR], (count, SAMPLES))
        for s in range(count):
            moved = corners - offset(pattern, s)
            triangle = Triangle(moved[:, 0], moved[:, 1], width, height)
            made = None if triangle.area == 0 else piece_of(triangle, x, y)
            if made is None:
                continue
            live |= 1 << s
            pieces[s] = made[0]
            inside = triangle.covers(x + COLUMNS, y + ROWS)
            own, first = limit[s, :SAMPLES].reshape(TILE, TILE), kept[s, :SAMPLES] == 2
            equal = inside & (own == F(depth))
            ties += equal.sum()
            cover |= (inside & (F(depth) < own) | equal & first.reshape(TILE, TILE)) << s
        for name, value in (("x0", 0), ("y0", 0), ("x1", TILE - 1), ("y1", TILE - 1)):
            pieces[name] = value
        pieces["z0"] = pieces["zmin"] = pieces["zmax"] = depth
        pieces["slot"], pieces["order"] = 1, 5
        shown, covers = np.zeros(1, SHOWN), np.zeros(SHOWN_ROOM + 2 * PAD, np.int32)
        out = record("msaa_list", pattern=pattern, shown=shown, cover=covers)
        for name, array in (("limit", limit), ("kept", kept)):
            out[name][0, :count] = [row.ctypes.data for row in array]
        table = record_table(orders.view(np.uint8))
        assert kernels.cover_msaa(pieces, live, 0, TILE - 1, table, out) == TILE
        pixels, total = np.flatnonzero(cover), int(shown["count"][0])
        expected = cover.ravel()[pixels]
        lowest = np.log2(expected & -expected).astype(int)
        assert np.array_equal(shown["sample"][0, :total], pixels | lowest << layouts.SHOWN_NUMBER)
        assert np.array_equal(covers[:total], expected)
        assert shown["primitives"][0] == (total > 0)
    assert ties > 50


@all_backends
def test_take_placed(kernels):
    """Samples, the numbers of the pattern's, and surfaces, as far as the batch has room."""
    rng = np.random.default_rng(7)
    shown = np.zeros(1, SHOWN)
    words = rng.integers(0, SAMPLES << 4, shown["sample"].shape)
    shown["sample"], shown["of"] = words, np.sort(rng.integers(0, 90, words.shape))
    for first, count, before in ((0, 1, 0), (5, 40, 3), (9, BATCH, 0), (100, 300, 17), (7, 9, 250)):
        batch = np.zeros(1, BATCH_RECORD)
        batch["count"] = before
        some = kernels.take_placed(shown, first, count, 2, batch)
        assert some == min(count, BATCH - before)
        assert batch["count"][0] == before + some
        taken, room = slice(first, first + some), slice(before, before + some)
        assert np.array_equal(batch["sample"][0, room], words[0, taken] & (SAMPLES - 1))
        assert np.array_equal(batch["number"][0, room], words[0, taken] >> layouts.SHOWN_NUMBER)
        assert np.array_equal(batch["surface"][0, room], shown["of"][0, taken] - 2)

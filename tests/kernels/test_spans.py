"""cover_records, show_alone: what records cover, row by row and without depths (R10, R12).

The oracle asks each edge function in 64 bits at every sample.
"""

import functools

import numpy as np
from kernels.harness import Records, all_backends, check_poisoned
from kernels.layouts import COVER, COVER_ROWS, MOST_COVERING, PAD, RECORD, RUN_LENGTH, SHOWN, TILE
from kernels.pieces import Triangle, meta_of
from kernels.test_raster import random_tile
from kernels.test_visible import STRIPS, corners_of, shown_in

SIDE = 256 * STRIPS
SCENES = 60
KINDS = ["tiny", "small", "small", "medium", "centers", "sliver", "level", "limit"]
NEXT_AFTER_1 = np.nextafter(np.float32(1), np.float32(2))


def level_corners(rng, place):
    """An edge along a row of samples, or beside it: it bounds the row, or not."""
    corners = corners_of(rng, "small", *place[2:])
    corners[1, 1] = corners[0, 1] = corners[0, 1] // 256 * 256 + rng.choice([127, 128, 129])
    return corners


def triangle_of(rng, place):
    """One of sides that are short enough, which touches the tile; or None."""
    kind = rng.choice(KINDS)
    corners = level_corners(rng, place) if kind == "level" else corners_of(rng, kind, *place[2:])
    triangle = Triangle(corners[:, 0], corners[:, 1], *place[:2])
    fits = (np.ptp(corners, axis=0) <= SIDE).all()
    if not fits or triangle.empty or triangle.right < place[2] or triangle.bottom < place[3]:
        return None
    if triangle.left >= place[2] + TILE or triangle.top >= place[3] + TILE:
        return None
    return triangle


def size_in(place):
    """Samples of the tile inside the viewport, across and down."""
    width, height, tile_x, tile_y = place
    return min(width - tile_x, TILE), min(height - tile_y, TILE)


def covers_in(place, triangles):
    """A (TILE, TILE) bool of each: the samples of the viewport that it covers."""
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    return [t.covers(place[2] + columns, place[3] + rows) & shown_in(place) for t in triangles]


class Scene:
    """Records of a tile, as bins list them, and the samples of the viewport that each covers."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.place = random_tile(rng, "small")
        self.size = size_in(self.place)
        most, self.triangles = int(rng.choice([1, 5, 20, 60])), []
        for _ in range(20 * most):
            triangle = triangle_of(rng, self.place)
            if triangle and meta_of(triangle) is not None and len(self.triangles) < most:
                self.triangles.append(triangle)
        self.records = np.zeros(len(self.triangles), RECORD)
        for record, triangle in zip(self.records, self.triangles, strict=True):
            record["x"], record["y"] = triangle.x, triangle.y
        self.records["zmax"] = rng.choice(np.float32([-1, 0.5, 1]), len(self.triangles))
        self.ids = np.arange(len(self.triangles), dtype=np.uint32)
        self.covers = covers_in(self.place, self.triangles)

    @functools.cached_property
    def layers(self):
        return np.sum(self.covers, axis=0)

    @functools.cached_property
    def runs(self):
        """Those of each record's cover."""
        return [runs_of(covers) for covers in self.covers]

    @functools.cached_property
    def alone(self):
        """Whether each covers only what no other covers."""
        return np.array([self.layers[covers].max(initial=0) < 2 for covers in self.covers])


@functools.cache
def scenes():
    made = [Scene(seed) for seed in range(SCENES)]
    return [scene for scene in made if len(scene.ids)]


def empty_cover(place, size):
    cover = Records(COVER, 1)
    for name in ("count", "used", "once", "twice"):
        cover.fields[name] = 0
    cover.fields["x"], cover.fields["y"] = place
    cover.fields["width"], cover.fields["height"] = size
    return cover


def cover_of(scene, kernels, shown, parts=1):
    """What the records of a scene cover, a part of them at a time."""
    cover, table = empty_cover(scene.place[2:], scene.size), scene.records.view(np.uint8)[None]
    for part in np.array_split(scene.ids, parts):
        if len(part):
            assert kernels.cover_records(cover.rows[0], table, part, shown)
    cover.check_gaps()
    return cover


def empty_lists(count):
    lists = Records(SHOWN, count)
    lists.fields["count"] = lists.fields["primitives"] = 0
    return lists


def runs_of(covers):
    """(runs,): of each row that is covered, the first sample and how many: all side by side."""
    rows = np.flatnonzero(covers.any(axis=1))
    first, length = covers[rows].argmax(axis=1), covers[rows].sum(axis=1)
    for row, start, count in zip(rows, first, length, strict=True):
        assert covers[row, start : start + count].all()
    return rows * TILE + first | length << RUN_LENGTH


def check_list(fields, scene, numbers):
    """The primitives are those records that show anything, in order, each with its runs."""
    numbers = [number for number in numbers if scene.covers[number].any()]
    runs = [scene.runs[number] for number in numbers]
    count = sum(map(len, runs))
    assert (fields["count"], fields["primitives"]) == (count, len(numbers))
    assert np.array_equal(fields["sample"][:count], np.concatenate([[], *runs]))
    primitives = np.repeat(np.arange(len(numbers)), list(map(len, runs)))
    assert np.array_equal(fields["of"][:count], primitives)
    named = fields["primitive"][: len(numbers)]
    assert np.array_equal(named["id"], scene.ids[numbers])
    assert np.array_equal(named["first"], np.searchsorted(primitives, np.arange(len(numbers))))
    for name in ("sample", "of"):
        check_poisoned({name: fields[name][count + TILE + PAD :]}, [name])


def bits_of(samples):
    """(rows,) uint64: bit x of sample x."""
    return np.packbits(samples, axis=1, bitorder="little").view(np.uint64)[:, 0]


def check_spans(fields, scene):
    """Each record's rows, those without samples, too."""
    assert fields["count"] == len(scene.ids)
    for number, entry in enumerate(fields["record"][: len(scene.ids)]):
        assert entry["record"] == scene.records[number : number + 1].ctypes.data
        assert entry["id"] == scene.ids[number]
        rows = slice(entry["y0"], entry["y1"] + 1)
        assert not np.delete(scene.covers[number], rows, axis=0).any()
        spans = fields["span"][entry["at"] :][: entry["y1"] - entry["y0"] + 1]
        spans = spans[spans >> RUN_LENGTH > 0]
        assert np.array_equal(spans, scene.runs[number])


@all_backends
def test_cover_records(kernels):
    """Runs of every record, hidden or not, and the samples that one, and more than one, cover."""
    lists = empty_lists(len(scenes()))
    for row, fields, scene in zip(lists.rows, lists.fields, scenes(), strict=True):
        cover = cover_of(scene, kernels, row, parts=3).fields[0]
        check_list(fields, scene, scene.ids)
        check_spans(cover, scene)
        assert np.array_equal(cover["once"][:TILE], bits_of(scene.layers > 0))
        assert np.array_equal(cover["twice"][:TILE], bits_of(scene.layers > 1))
        assert not cover["once"][TILE:].any()
    lists.check_gaps()


@all_backends
def test_show_alone(kernels):
    """Those that nobody meets are listed; the others are the rest, in order."""
    lists, met = empty_lists(len(scenes())), 0
    for row, fields, scene in zip(lists.rows, lists.fields, scenes(), strict=True):
        cover = cover_of(scene, kernels, empty_lists(1).rows[0])
        before, rest = cover.rows[0].copy(), np.zeros(MOST_COVERING, np.uint16)
        left = kernels.show_alone(cover.rows[0], row, rest)
        assert np.array_equal(scene.ids[rest[:left]], scene.ids[~scene.alone])
        check_list(fields, scene, np.flatnonzero(scene.alone))
        assert np.array_equal(cover.rows[0], before)
        met += left
    assert met > len(scenes())  # or nobody met anybody
    lists.check_gaps()


@all_backends
def test_what_needs_depths_is_refused(kernels):
    """A side too long for single precision, and what may lie beyond the far plane."""
    scene = next(scene for scene in scenes() if len(scene.ids) >= 20)
    for number in (0, 7, len(scene.ids) - 1):
        for change in ("x", "y", "far", "nan"):
            records = scene.records.copy()
            if change in "xy":
                least = records[change][number].min()
                records[change][number, records[change][number].argmax()] = least + SIDE + 1
            else:
                records["zmax"][number] = NEXT_AFTER_1 if change == "far" else np.nan
            table, lists = records.view(np.uint8)[None], empty_lists(1)
            cover = empty_cover(scene.place[2:], scene.size)
            shown = kernels.cover_records(cover.rows[0], table, scene.ids, lists.rows[0])
            assert not shown, change


def fill(kernels, corners, count):
    """How many copies of one record there is room for, of `count`; nothing is written past that."""
    record = np.zeros(1, RECORD)
    record["x"], record["y"] = corners
    lists, cover = empty_lists(1), empty_cover((0, 0), (TILE, TILE))
    ids, table = np.arange(count, dtype=np.uint32) * 0, record.view(np.uint8)[None]
    while len(ids) and kernels.cover_records(cover.rows[0], table, ids[:1], lists.rows[0]):
        ids = ids[1:]
    lists.check_gaps()
    cover.check_gaps()
    assert cover.fields["count"][0] == count - len(ids)
    return count - len(ids), lists.fields[0], cover.fields[0]


@all_backends
def test_what_is_full_refuses_more(kernels):
    """More runs than a tile has samples, more rows than there is room for, more records."""
    large, shown, _ = fill(kernels, ([0, SIDE, 0], [0, 0, SIDE]), TILE + 1)
    assert (large, shown["count"]) == (TILE, TILE * TILE)
    tall = [100, 101, 100], [0, 0, SIDE]  # of few samples, in many rows
    room, shown, cover = fill(kernels, tall, MOST_COVERING)
    assert room >= COVER_ROWS // TILE - 1
    assert shown["count"] < TILE * TILE
    assert cover["used"] <= COVER_ROWS
    small, _, cover = fill(kernels, ([100, 300, 100], [100, 100, 300]), MOST_COVERING + 1)
    assert small == MOST_COVERING

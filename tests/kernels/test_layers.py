"""show_layers: what shows of records that meet, sample by sample (R14-R16).

The oracle is that of `test_visible`: one record after the other, in the order of R16.
"""

import functools

import numpy as np
import pytest
from kernels.harness import Records, all_backends, hostile
from kernels.layouts import LAYERS, RECORD, RUN_LENGTH, TILE
from kernels.pieces import meta_of, plane_through
from kernels.test_raster import random_tile
from kernels.test_spans import cover_of, covers_in, empty_lists, size_in, triangle_of
from kernels.test_visible import draw, shown_in

SCENES = 120
CONTESTED = 512  # samples whose depths are compared, before all are
FEW = np.float32([0.0, 0.25, 0.5, 1.0])


def depths_of(rng, kind):
    """(3,) float32 depths of corners: of one of few layers, near one, or anywhere."""
    if kind == "level":
        return np.full(3, rng.choice(FEW))
    if kind == "near":
        return np.clip(rng.choice(FEW) + rng.normal(0, 0.02, 3), 0, 1).astype(np.float32)
    return rng.random(3, np.float32)


def fill_depths(rng, record, triangle, kind):
    zn = depths_of(rng, kind)
    plane = np.float32(plane_through(triangle, zn))
    if kind == "wild":
        plane = hostile(rng, 3, rate=1.0, finite=True)
    record["z0"], record["gx"], record["gy"] = plane
    record["zmin"], record["zmax"] = zn.min(), zn.max()
    return np.isfinite(plane).all()


class Scene:
    """Records of a tile, what each covers, and what the depths leave of it."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.place = random_tile(rng, "small")
        self.size = size_in(self.place)
        kind, most = rng.choice(["level", "near", "any", "wild"]), int(rng.choice([2, 8, 30]))
        made = []
        while len(made) < most:
            triangle, record = triangle_of(rng, self.place), np.zeros(1, RECORD)
            if triangle is None or meta_of(triangle) is None:
                continue
            if fill_depths(rng, record, triangle, kind):
                record["x"], record["y"] = triangle.x, triangle.y
                made.append((record, triangle))
        self.records = np.concatenate([record for record, _ in made])
        self.records["order"] = rng.permutation(most) // 2  # twos are pieces of one triangle
        self.ids = np.arange(most, dtype=np.uint32)
        triangles = [triangle for _, triangle in made]
        with np.errstate(all="ignore"):
            _, self.kept = draw(self.records, triangles, self.place)
        self.inside, covers = shown_in(self.place), covers_in(self.place, triangles)
        self.meetings = np.sum([np.sum(a & b) for i, a in enumerate(covers) for b in covers[:i]])

    @property
    def order(self):
        """The records' numbers, the nearest first."""
        return np.argsort(self.records["zmin"], kind="stable").astype(np.uint16)


@functools.cache
def scene(seed):
    return Scene(seed)


def owners_of(fields):
    """(TILE, TILE): the record that shows at each sample, -1 where none does; no run is empty."""
    owners = np.full(TILE * TILE, -1)
    runs, primitives = fields["sample"][: fields["count"]], fields["of"][: fields["count"]]
    assert (np.diff(primitives) >= 0).all()
    assert np.array_equal(np.unique(primitives), np.arange(fields["primitives"]))
    named = fields["primitive"][: fields["primitives"]]
    assert np.array_equal(
        named["first"], np.searchsorted(primitives, np.arange(fields["primitives"]))
    )
    for run, primitive in zip(runs, primitives, strict=True):
        first, length = run & (TILE * TILE - 1), run >> RUN_LENGTH
        assert length > 0
        assert first // TILE == (first + length - 1) // TILE
        assert (owners[first : first + length] == -1).all()
        owners[first : first + length] = named["id"][primitive]
    return owners.reshape(TILE, TILE)


@all_backends
def test_show_layers(kernels):
    """Each sample is shown once, by the record that the rules choose; few scenes are refused."""
    shown, taken, lists = 0, 0, empty_lists(SCENES)
    for seed, (row, fields) in enumerate(zip(lists.rows, lists.fields, strict=True)):
        one, layers = scene(seed), Records(LAYERS, 1)
        table = one.records.view(np.uint8)[None]
        cover = cover_of(one, kernels, empty_lists(1).rows[0])
        before = cover.rows[0].copy()
        if kernels.show_layers(cover.rows[0], table, one.order, layers.rows[0], row):
            assert np.array_equal(owners_of(fields), np.where(one.inside, one.kept, -1))
            shown += 1
            taken += layers.fields["taken"][0] != 0
        else:
            assert one.meetings > CONTESTED
        assert np.array_equal(cover.rows[0], before)
        layers.check_gaps()
    lists.check_gaps()
    assert shown > SCENES // 2
    assert taken > SCENES // 10  # or later records never were nearer


@all_backends
def test_behind_what_is_listed_already(kernels):
    """Primitives are added to the list, even where some are listed again."""
    one = next(s for s in map(scene, range(SCENES)) if 0 < s.meetings < CONTESTED)
    table, layers, lists = one.records.view(np.uint8)[None], Records(LAYERS, 1), empty_lists(1)
    cover, row, fields = (
        cover_of(one, kernels, empty_lists(1).rows[0]),
        lists.rows[0],
        lists.fields[0],
    )
    assert kernels.show_layers(cover.rows[0], table, one.order, layers.rows[0], row)
    count, primitives = int(fields["count"]), int(fields["primitives"])
    assert kernels.show_layers(cover.rows[0], table, one.order, layers.rows[0], row)
    assert (fields["count"], fields["primitives"]) == (2 * count, 2 * primitives)
    assert np.array_equal(fields["sample"][:count], fields["sample"][count : 2 * count])
    assert np.array_equal(fields["of"][:count] + primitives, fields["of"][count : 2 * count])


@pytest.mark.parametrize("far_first", [False, True])
@all_backends
def test_only_from_near_to_far(kernels, far_first):
    """What hides is known of what comes later only because that begins behind it."""
    one = next(s for s in map(scene, range(SCENES)) if 0 < s.meetings < CONTESTED)
    assert len(np.unique(one.records["zmin"])) > 1
    table, layers, row = (
        one.records.view(np.uint8)[None],
        Records(LAYERS, 1),
        empty_lists(1).rows[0],
    )
    cover, order = cover_of(one, kernels, empty_lists(1).rows[0]), one.order
    order = np.ascontiguousarray(order[::-1]) if far_first else order
    assert kernels.show_layers(cover.rows[0], table, order, layers.rows[0], row) != far_first

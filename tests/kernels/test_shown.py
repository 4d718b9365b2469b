"""show_records, show_fragments: the samples that these show, in order; take_shown: to batches."""

import numpy as np
import pytest
from kernels.harness import Records, all_backends, check_poisoned
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    FRAGMENT_ID,
    FRAGMENT_LINK,
    LINK_FRAGMENTS,
    PAD,
    SHOWN,
    TILE,
)
from kernels.test_visible import RECORDS, TILES, Tile, scene

FEW = 1024  # samples: smaller boxes may be listed strip by strip


def settled_tile(kernels, some, rng):
    """A tile of a scene, a few samples of which fragments have taken over."""
    tile = Tile(*some.place[2:])
    kernels.raster_visible(tile.bytes, some.table, some.ids[some.arrivals[0]])
    kernels.raster_settle(tile.bytes, some.table, False)
    ids = tile.fields["id"][0]
    ids[rng.integers(0, TILE * TILE, rng.choice([0, 200]))] = FRAGMENT_ID + 5
    ids[: TILE * TILE].reshape(TILE, TILE)[~some.shown] = -1
    return tile


def samples_of(tile, record_id):
    """The samples that bear an ID, row by row."""
    return np.flatnonzero(tile.fields["id"][0, : TILE * TILE] == np.int32(record_id))


@all_backends
@pytest.mark.parametrize("parts", [1, 2, RECORDS])
def test_show_records(kernels, parts):
    """Every sample of each record that shows, once, in whatever order it arrives; nobody else's."""
    lists, hidden = Records(SHOWN, TILES), 0
    for seed, (row, fields) in enumerate(zip(lists.rows, lists.fields, strict=True)):
        rng, some = np.random.default_rng(seed), scene(seed)
        tile = settled_tile(kernels, some, rng)
        before = tile.bytes.copy()
        fields["count"], fields["primitives"], fields["runs"] = 0, 0, 7
        for part in np.array_split(some.arrivals[1], parts):
            kernels.show_records(tile.bytes, some.table, some.ids[part], row)
        assert np.array_equal(tile.bytes, before)
        count, primitives = int(fields["count"]), int(fields["primitives"])
        named = fields["primitive"][:primitives]
        ends = np.append(named["first"], count)
        for number, (record_id, first) in enumerate(named):
            assert np.array_equal(
                np.sort(fields["sample"][first : ends[number + 1]]), samples_of(tile, record_id)
            )
            assert (fields["of"][first : ends[number + 1]] == number).all()
        showing = [number for number in some.ids if len(samples_of(tile, number))]
        assert sorted(named["id"]) == sorted(showing)
        assert count == sum(len(samples_of(tile, number)) for number in showing)
        for name in ("sample", "of"):
            check_poisoned({name: fields[name][count + 2 * PAD :]}, [name])
        check_poisoned({"primitive": fields["primitive"][primitives + 1 :]}, ["primitive"])
        assert fields["runs"] == 7
        hidden += RECORDS - primitives
    assert hidden > TILES  # or nothing was left out
    lists.check_gaps()


def fragment_links(rng, tile):
    """Fragments, some of which show: one or several of each triangle, in two links."""
    count = int(rng.integers(2, LINK_FRAGMENTS))
    ids = FRAGMENT_ID + np.repeat(rng.permutation(1000), rng.choice([1, 1, 1, 2, 5], 1000))
    at = rng.permutation(TILE * TILE)[: 2 * count]
    links = np.zeros(2, FRAGMENT_LINK)
    links["count"] = count, rng.integers(0, count)
    for number in range(2):
        some = slice(number * count, (number + 1) * count)
        links["id"][number, :count] = ids[some]
        links["sample"][number, :count] = at[some]
        shows = at[some][rng.random(count) < rng.choice([0, 0.3, 1])]
        tile.fields["id"][0, shows] = ids[some][np.isin(at[some], shows)]
    return links


@all_backends
def test_show_fragments(kernels):
    """Those that show, in order; of one triangle they are one primitive, in two links, too."""
    lists, primitives = Records(SHOWN, 200), 0
    for seed, (row, fields) in enumerate(zip(lists.rows, lists.fields, strict=True)):
        rng, tile = np.random.default_rng(seed), Tile(0, 0)
        links = fragment_links(rng, tile)
        before = tile.bytes.copy()
        fields["count"], fields["primitives"] = 0, 0
        ids, samples = [], []
        for link in links:
            kernels.show_fragments(tile.bytes, link.reshape(1).view(np.uint8), row)
            all_ids, at = (link[name][: link["count"]] for name in ("id", "sample"))
            shows = tile.fields["id"][0, at] == all_ids
            ids, samples = np.append(ids, all_ids[shows]), np.append(samples, at[shows])
        assert np.array_equal(tile.bytes, before)
        fresh = np.flatnonzero(np.diff(ids, prepend=-1))
        assert fields["count"] == len(ids) and fields["primitives"] == len(fresh)
        assert np.array_equal(fields["sample"][: len(ids)], samples)
        assert np.array_equal(
            fields["of"][: len(ids)], np.cumsum(np.diff(ids, prepend=-1) != 0) - 1
        )
        assert np.array_equal(fields["primitive"]["id"][: len(fresh)], ids[fresh])
        assert np.array_equal(fields["primitive"]["first"][: len(fresh)], fresh)
        for name in ("sample", "of"):
            check_poisoned({name: fields[name][len(ids) + PAD :]}, [name])
        check_poisoned({"primitive": fields["primitive"][len(fresh) + 1 :]}, ["primitive"])
        primitives += len(fresh)
    assert primitives > 5000
    lists.check_gaps()


@all_backends
def test_neighbours_stay_neighbours(kernels):
    """The samples of a record that shows on a large box are listed row by row."""
    large = 0
    for seed in range(2 * TILES):  # few records are as large
        some = scene(seed)
        tile, row = settled_tile(kernels, some, np.random.default_rng(seed)), Records(SHOWN, 1)
        row.fields["count"] = row.fields["primitives"] = 0
        kernels.show_records(tile.bytes, some.table, some.ids, row.rows[0])
        named = row.fields["primitive"][0, : row.fields["primitives"][0]]
        for record_id, first in named:
            own = samples_of(tile, record_id)
            columns, rows = np.ptp(own % TILE) + 1, np.ptp(own // TILE) + 1
            if columns >= 8 and columns * rows > FEW:
                assert np.array_equal(row.fields["sample"][0, first : first + len(own)], own)
                large += 1
    assert large > 50


@all_backends
def test_take_shown(kernels):
    """As many as there is room for, and the last one again behind them."""
    rng = np.random.default_rng(1)
    batches, shown = Records(BATCH_RECORD, 300), Records(SHOWN, 1)
    fields = shown.fields[0]
    fields["sample"][:] = rng.integers(0, TILE * TILE, len(fields["sample"]))
    fields["of"][:] = np.sort(rng.integers(0, TILE * TILE, len(fields["of"])))
    for row, batch in zip(batches.rows, batches.fields, strict=True):
        first, primitive = int(rng.integers(0, 2000)), int(rng.integers(-5, 6))
        batch["count"], taken = 0, 0
        while taken < BATCH:
            asked = int(rng.choice([1, 2, 15, 16, 17, 100, 400]))
            more = kernels.take_shown(shown.rows[0], first + taken, asked, primitive, row)
            assert more == min(asked, BATCH - taken)
            taken += more
            assert batch["count"] == taken
            some = slice(first, first + taken)
            for name, values in (
                ("sample", fields["sample"][some]),
                ("surface", fields["of"][some] - primitive),
            ):
                got = batch[name][: taken + PAD]
                assert np.array_equal(got, np.append(values, [values[-1]] * PAD)), name
        check_poisoned(batch, ["weight", "r", "position", "normal", "uv", "color", "lod"])
    batches.check_gaps()

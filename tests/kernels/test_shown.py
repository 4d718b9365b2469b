"""show_records: the samples that records show, one after the other; take_shown: them to a batch."""

import numpy as np
import pytest
from kernels.harness import Records, all_backends, check_poisoned
from kernels.layouts import BATCH, BATCH_RECORD, FRAGMENT_ID, PAD, SHOWN, TILE
from kernels.test_visible import RECORDS, TILES, Tile, scene


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
        fields["count"], fields["pieces"], fields["runs"] = 0, 0, 7
        for part in np.array_split(some.arrivals[1], parts):
            kernels.show_records(tile.bytes, some.table, some.ids[part], row)
        assert np.array_equal(tile.bytes, before)
        count, pieces = int(fields["count"]), int(fields["pieces"])
        named = fields["piece"][:pieces]
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
        check_poisoned({"piece": fields["piece"][pieces + 1 :]}, ["piece"])
        assert fields["runs"] == 7
        hidden += RECORDS - pieces
    assert hidden > TILES  # or nothing was left out
    lists.check_gaps()


@all_backends
def test_neighbours_stay_neighbours(kernels):
    """The samples of a wide record are listed row by row."""
    for seed in range(TILES):
        some = scene(seed)
        tile, row = settled_tile(kernels, some, np.random.default_rng(seed)), Records(SHOWN, 1)
        row.fields["count"] = row.fields["pieces"] = 0
        kernels.show_records(tile.bytes, some.table, some.ids, row.rows[0])
        named = row.fields["piece"][0, : row.fields["pieces"][0]]
        for record_id, first in named:
            own = samples_of(tile, record_id)
            if np.ptp(own % TILE) >= 8:
                assert np.array_equal(row.fields["sample"][0, first : first + len(own)], own)


@all_backends
def test_take_shown(kernels):
    """As many as there is room for, and the last one again behind them."""
    rng = np.random.default_rng(1)
    batches, shown = Records(BATCH_RECORD, 300), Records(SHOWN, 1)
    fields = shown.fields[0]
    fields["sample"][:] = rng.integers(0, TILE * TILE, len(fields["sample"]))
    fields["of"][:] = np.sort(rng.integers(0, TILE * TILE, len(fields["of"])))
    for row, batch in zip(batches.rows, batches.fields, strict=True):
        first, piece = int(rng.integers(0, 2000)), int(rng.integers(-5, 6))
        batch["count"], taken = 0, 0
        while taken < BATCH:
            asked = int(rng.choice([1, 2, 15, 16, 17, 100, 400]))
            more = kernels.take_shown(shown.rows[0], first + taken, asked, piece, row)
            assert more == min(asked, BATCH - taken)
            taken += more
            assert batch["count"] == taken
            some = slice(first, first + taken)
            for name, values in (
                ("sample", fields["sample"][some]),
                ("surface", fields["of"][some] - piece),
            ):
                got = batch[name][: taken + PAD]
                assert np.array_equal(got, np.append(values, [values[-1]] * PAD)), name
        check_poisoned(batch, ["b", "r", "position", "normal", "uv", "color", "lod"])
    batches.check_gaps()

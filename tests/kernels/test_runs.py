"""find_runs: neighbouring samples of a row that show the same slot; take_runs: their samples."""

import itertools

import numpy as np
from kernels.harness import POISON, Records, all_backends, check_poisoned
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    BLOCK,
    PAD,
    RUN,
    RUN_LENGTH,
    SHOWN,
    TILE,
    VISIBLE_TILE,
)

TILES = 250  # of 4096 samples: 10^6 and more
BLOCKS = (TILE // BLOCK, TILE // BLOCK)
NOTHING_NOTED = np.zeros(BLOCKS, bool), np.zeros(BLOCKS, np.int32)
ROOM = np.dtype([("runs", RUN, TILE * TILE + 1)])


def random_slots(rng):
    """A tile of runs of random lengths, a third of them empty; poison behind it."""
    lengths = rng.choice([1, 1, 2, 3, 15, 16, 17, 63, 64, 200], TILE * TILE)
    owners = rng.choice([-1, 0, 1, 2**31 - 1], TILE * TILE)
    slots = np.repeat(owners, lengths)[: TILE * TILE].astype(np.int32)
    return np.append(slots, np.full(PAD, POISON, np.uint32).view(np.int32))


def random_notes(rng):
    """Which blocks are noted, those of whole rows more often than not, and for what."""
    rows = rng.choice([0.0, 0.5, 0.9, 1.0], (BLOCKS[0], 1))
    noted = rng.random(BLOCKS) < rows
    changes = rng.random(noted.size) < rng.choice([0.0, 0.3, 1.0])
    ids = rng.choice([-1, 0, 1, 2**31 - 1], noted.size)[np.cumsum(changes) % noted.size]
    return noted, ids.reshape(noted.shape).astype(np.int32)


def tile_of(slots, noted, ids):
    """A tile whose noted blocks' samples are poison, and what all of its samples show."""
    tile = Records(VISIBLE_TILE, 1)
    samples = np.repeat(np.repeat(noted, BLOCK, 0), BLOCK, 1).ravel()
    shown = np.repeat(np.repeat(ids, BLOCK, 0), BLOCK, 1).ravel()
    kept = tile.fields["id"][0]
    kept[TILE * TILE :] = slots[TILE * TILE :]
    kept[: TILE * TILE][~samples] = slots[: TILE * TILE][~samples]
    tile.fields["noted_id"] = ids.ravel()
    tile.fields["noted"] = np.packbits(noted.ravel(), bitorder="little").view(np.uint64)
    return tile, np.where(samples, shown, slots[: TILE * TILE])


def expected_runs(slots, width, height):
    """(owner, first sample, length), row by row."""
    runs = []
    for row in range(height):
        first = TILE * row
        for owner, samples in itertools.groupby(slots[first : first + width].tolist()):
            length = len(list(samples))
            if owner >= 0:
                runs.append((owner, first, length))
            first += length
    return np.array(runs, RUN)


def check(kernels, slots, width, height, notes=NOTHING_NOTED):
    tile, shown = tile_of(slots, *notes)
    before = tile.fields.copy()
    out = Records(ROOM, 1)
    poison = out.rows[0].copy()
    count, gaps = kernels.find_runs(tile.rows[0], width, height, out.rows[0])
    expected, got = expected_runs(shown, width, height), out.fields["runs"][0, :count]
    assert count == len(expected)
    assert gaps == (expected["length"].sum() < width * height)
    assert np.array_equal(got, expected)
    end = (count + 1) * RUN.itemsize  # the next one may be started
    assert np.array_equal(out.rows[0][end:], poison[end:])
    written = tile.fields["id"][0] != before["id"][0]
    assert np.array_equal(tile.fields["id"][0][written], np.append(shown, np.zeros(PAD))[written])
    for name in set(VISIBLE_TILE.names) - {"id"}:
        assert tile.fields[name].tobytes() == before[name].tobytes(), name
    out.check_gaps()
    tile.check_gaps()


@all_backends
def test_random_tiles(kernels):
    rng = np.random.default_rng(0)
    for number in range(TILES):
        width, height = (TILE, TILE) if number % 2 else rng.integers(1, TILE + 1, 2)
        check(kernels, random_slots(rng), int(width), int(height))


@all_backends
def test_noted_blocks(kernels):
    """In rows of nothing else, and beside others."""
    rng = np.random.default_rng(2)
    for number in range(TILES):
        width, height = (TILE, TILE) if number % 2 else rng.integers(1, TILE + 1, 2)
        check(kernels, random_slots(rng), int(width), int(height), random_notes(rng))


@all_backends
def test_every_width(kernels):
    """One run over the whole tile, none at all (noted or not), and runs of one sample each."""
    alternating = np.arange(TILE * TILE + PAD, dtype=np.int32) % 2
    for slots in (np.full_like(alternating, 7), np.full_like(alternating, -1), alternating):
        for width in range(1, TILE + 1):
            check(kernels, slots, width, 3)
    for owner in (7, -1):
        for width in range(1, TILE + 1):
            check(kernels, alternating, width, 11, (~NOTHING_NOTED[0], np.full(BLOCKS, owner)))


def random_runs(rng, shown):
    """Runs of about twice as many samples as a batch holds; first samples and lengths."""
    lengths = rng.choice([1, 2, 3, 7, 8, 9, 15, 16, 17, 63, 64], 2 * BATCH)
    lengths = lengths[np.cumsum(lengths) <= 2 * BATCH]
    samples = rng.integers(0, TILE * TILE - 64, len(lengths))
    shown["sample"][: len(lengths)] = samples | lengths << RUN_LENGTH
    shown["of"][: len(lengths)] = np.arange(len(lengths)) // 2
    return samples, lengths


@all_backends
def test_take_runs(kernels):
    """Some at a time: those that fit, in order, and the last sample again behind them.

    However few or many the tile has, which is told to be one or another.
    """
    rng = np.random.default_rng(1)
    batches, lists = Records(BATCH_RECORD, 500), Records(SHOWN, 1)
    for row, fields in zip(batches.rows, batches.fields, strict=True):
        (samples, lengths), taken = random_runs(rng, lists.fields[0]), 0
        lists.fields[0]["count"] = rng.choice([1, TILE, 4 * TILE, TILE * TILE])
        primitive, fields["count"], fields["steps"] = int(rng.integers(-5, 6)), 0, 0
        fitting = int(np.searchsorted(np.cumsum(lengths), BATCH, "right"))
        while taken < fitting:
            some = int(min(rng.integers(1, len(lengths)), len(lengths) - taken))
            more = kernels.take_runs(lists.rows[0], taken, some, primitive, row)
            assert more == min(some, fitting - taken)
            taken += more
        left = len(lengths) - taken
        assert kernels.take_runs(lists.rows[0], taken, left, primitive, row) == 0
        runs = list(zip(samples[:taken], lengths[:taken], strict=True))
        samples = np.concatenate([first + np.arange(length) for first, length in runs])
        surfaces = np.repeat(np.arange(taken) // 2 - primitive, lengths[:taken])
        assert fields["count"] == len(samples)
        for name, values in (("sample", samples), ("surface", surfaces)):
            more = -len(samples) % PAD
            got = fields[name][: len(samples) + more]
            assert np.array_equal(got, np.append(values, [values[-1]] * more)), name
        assert not fields["steps"].any()
        check_poisoned(fields, ["weight", "r", "position", "normal", "uv", "color", "lod"])
    batches.check_gaps()

"""find_runs: neighbouring samples of a row that show the same slot."""

import itertools

import numpy as np
from kernels.harness import POISON, Records, all_backends
from kernels.layouts import PAD, RUN, TILE

TILES = 250  # of 4096 samples: 10^6 and more
ROOM = np.dtype([("runs", RUN, TILE * TILE + 1)])


def random_slots(rng):
    """A tile of runs of random lengths, a third of them empty; poison behind it."""
    lengths = rng.choice([1, 1, 2, 3, 15, 16, 17, 63, 64, 200], TILE * TILE)
    owners = rng.choice([-1, 0, 1, 2**31 - 1], TILE * TILE)
    slots = np.repeat(owners, lengths)[: TILE * TILE].astype(np.int32)
    return np.append(slots, np.full(PAD, POISON, np.uint32).view(np.int32))


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


def check(kernels, slots, width, height):
    out = Records(ROOM, 1)
    poison = out.rows[0].copy()
    count = kernels.find_runs(slots, width, height, out.rows[0])
    expected = expected_runs(slots, width, height)
    assert count == len(expected)
    assert np.array_equal(out.fields["runs"][0, :count], expected)
    end = (count + 1) * RUN.itemsize  # the next one may be started
    assert np.array_equal(out.rows[0][end:], poison[end:])
    out.check_gaps()


@all_backends
def test_random_tiles(kernels):
    rng = np.random.default_rng(0)
    for number in range(TILES):
        width, height = (TILE, TILE) if number % 2 else rng.integers(1, TILE + 1, 2)
        check(kernels, random_slots(rng), int(width), int(height))


@all_backends
def test_every_width(kernels):
    """One run over the whole tile, none at all, and runs of one sample each."""
    alternating = np.arange(TILE * TILE + PAD, dtype=np.int32) % 2
    for slots in (np.full_like(alternating, 7), np.full_like(alternating, -1), alternating):
        for width in range(1, TILE + 1):
            check(kernels, slots, width, 3)

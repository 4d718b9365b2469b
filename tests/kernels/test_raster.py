"""raster_depth, raster_overwrite, raster_count and raster_mark against R10, R12 and R14–R17.

The oracle knows nothing of tiles: it evaluates each triangle's edge functions in 64 bits at every
sample of the tile. What the kernel is given is prepared as the pipeline does.
"""

import collections
import functools
import itertools

import numpy as np
import pytest
from kernels.arithmetic import clamp
from kernels.harness import POISON, all_backends, bits, hostile
from kernels.layouts import PAD, TILE
from kernels.pieces import Triangle, piece_of

BEYOND_FAR = np.float32(float.fromhex("0x1.000002p0"))
GUARD = 128  # elements of poison before the tile; after it PAD may change, the next ones not
COVERS = ("raster_depth", "raster_overwrite", "raster_count", "raster_mark")
LARGEST = 65536  # samples a side of the largest viewport
REGION = 256 * 33280  # 1/256 sample: half the guard band and a line's width, from the centre
PIECES_A_TILE = 40
TILES = 40


def random_corners(rng, kind, tile_x, tile_y):
    """(3, 2) int64: corners of a triangle that probably touches the tile."""
    centre = 256 * (np.array([tile_x, tile_y]) + rng.uniform(0, TILE, 2))
    if kind == "small":
        corners = centre + rng.uniform(-1, 1, (3, 2)) * 256 * rng.choice([0.7, 2, 5, 9])
    elif kind == "medium":
        corners = centre + rng.uniform(-1, 1, (3, 2)) * 256 * rng.choice([16, 64, 300])
    elif kind == "centers":  # corners and edges on sample centres
        corners = centre + rng.integers(-6, 7, (3, 2)) * rng.choice([128, 256, 1024])
        return corners.astype(np.int64) // 128 * 128
    elif kind == "sliver":
        along = rng.uniform(-1, 1, 2) * 256 * rng.choice([8, 60, 2000])
        corners = centre + np.outer([-1, 0, 1], along) + rng.integers(-3, 4, (3, 2))
    else:  # "budget": an edge across the whole guard band, through the tile
        corners = budget_corners(rng, centre)
    low, high = 128 * LARGEST - REGION, 128 * LARGEST + REGION
    return np.clip(corners, low, high).astype(np.int64)


def budget_corners(rng, centre):
    """Two corners at the ends of the allowed region, so that |E / 256| comes close to 2^31."""
    low, high = 128 * LARGEST - REGION, 128 * LARGEST + REGION
    ends = np.array([(low, low), (high, high)])
    if rng.random() < 0.5:
        ends[:, 1] = ends[::-1, 1]
    aside = rng.integers(0, 300, 2)  # up to more than a sample: past a corner of the tile
    third = np.array(rng.choice([low, high], 2)) if rng.random() < 0.5 else centre
    ends = ends + np.where(ends == low, aside, 0)
    return np.concatenate([ends, [third]])[rng.permutation(3)]


def random_tile(rng, kind):
    """The viewport's size and the tile's first sample."""
    if kind == "budget":
        # On a diagonal of the guard band, which the longest edges follow, or beside it.
        at = int(rng.integers(1, LARGEST // TILE - 1)) * TILE
        other = at if rng.random() < 0.5 else LARGEST - TILE - at
        return LARGEST, LARGEST, at, other + int(rng.choice([0, -TILE, TILE]))
    width, height = rng.choice([1, 7, 63, 64, 65, 200, 1000, LARGEST], 2)
    column, row = (int(rng.integers(0, -(-size // TILE))) * TILE for size in (width, height))
    return int(width), int(height), column, row


def depth_plane(rng, piece):
    """Random planes: steep, constant, equal to others, and with the worst finite numbers."""
    steepness = rng.choice([0.0, 1e-4, 0.02, 1.0])
    piece["z0"], low, high = rng.choice([-1.0, -0.0, 0.0, 0.5, 1.0, rng.uniform(-1, 1.2)], 3)
    piece["gx"], piece["gy"] = rng.uniform(-steepness, steepness, 2)
    piece["zmin"], piece["zmax"] = min(low, high), max(low, high)
    if rng.random() < 0.1:
        for name in ("z0", "gx", "gy", "zmin", "zmax"):
            piece[name] = hostile(rng, 1, rate=1.0, finite=True)
        piece["zmin"], piece["zmax"] = sorted([piece["zmin"][0], piece["zmax"][0]])


def depth_at(piece, columns, rows):
    """R14 for the samples of a tile."""
    dx = (columns - piece["base_x"]).astype(np.float32)
    dy = (rows - piece["base_y"]).astype(np.float32)
    z = (piece["z0"] + dx * piece["gx"]) + dy * piece["gy"]
    return clamp(z, piece["zmin"], piece["zmax"])


class Tile:
    """A tile's buffers, in the middle of poison."""

    def __init__(self, z, slot):
        self._z = self._room(z)
        self._slot = self._room(slot.astype(np.int32))
        self.buffers = self._z[GUARD:].view(np.float32), self._slot[GUARD:].view(np.int32)

    @staticmethod
    def _room(values):
        room = np.full(GUARD + TILE * TILE + PAD + GUARD + 16, POISON, np.uint32)
        start = -room.ctypes.data % 64 // 4  # buffers are aligned to 64 bytes
        room = room[start : start + GUARD + TILE * TILE + PAD + GUARD]
        room[GUARD : GUARD + TILE * TILE] = values.ravel().view(np.uint32)
        return room

    def check(self, z, slot, shown):
        """The samples of the viewport are as expected, and the poison around them is whole."""
        for room in (self._z, self._slot):
            assert (room[:GUARD] == POISON).all() and (room[-GUARD:] == POISON).all()
        size = TILE * TILE
        for name, got, expected in zip(("z", "slot"), self.buffers, (z, slot), strict=True):
            differ = shown & (bits(got[:size].reshape(TILE, TILE)) != bits(expected))
            assert not differ.any(), f"{name} at (row, column) {np.argwhere(differ)[0]}"


def expect_depth(piece, covered, new, z, slot, orders):
    taken = np.where(slot >= 0, orders[slot.clip(0)], 0)
    first = (slot >= 0) & (int(piece["order"][0]) < taken)
    wins = covered & (new < z)
    ties = covered & (new == z) & first
    z[wins | ties] = new[wins | ties]  # of two zeros, the sign
    slot[wins | ties] = piece["slot"][0]


def expect_overwrite(piece, covered, new, z, slot, orders):
    passes = covered & (new < BEYOND_FAR)
    z[passes] = new[passes]
    slot[passes] = piece["slot"][0]


def expect_count(piece, covered, new, z, slot, orders):
    slot[covered & (new < z)] += 1


def expect_mark(piece, covered, new, z, slot, orders):
    slot[covered & (new < z)] = piece["slot"][0]


EXPECTATIONS = {
    "raster_depth": expect_depth,
    "raster_overwrite": expect_overwrite,
    "raster_count": expect_count,
    "raster_mark": expect_mark,
}


def first_depths(rng):
    """Depths before the first piece."""
    if rng.random() < 0.5:
        return np.full((TILE, TILE), BEYOND_FAR)
    return rng.choice(np.float32([-1, 0.25, 0.5, 1, BEYOND_FAR]), (TILE, TILE))


def first_slots(use):
    """Slots before the first piece."""
    return np.full((TILE, TILE), -1 if use in ("raster_depth", "raster_overwrite") else 0, np.int32)


def random_pieces(rng, kind):
    """What is drawn into a random tile: the samples shown, first depths, orders, and the pieces.

    Each piece comes with the samples that its triangle covers, and its depth at all of them.
    """
    width, height, tile_x, tile_y = random_tile(rng, kind)
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    shown = (columns < width - tile_x) & (rows < height - tile_y)
    z, pieces = first_depths(rng), []
    orders = rng.permutation(PIECES_A_TILE).astype(np.uint32) // 3  # a few of one primitive
    for number in range(PIECES_A_TILE):
        corners = random_corners(rng, kind, tile_x, tile_y)
        triangle = Triangle(corners[:, 0], corners[:, 1], width, height)
        covered = triangle.covers(tile_x + columns, tile_y + rows)
        piece = None if triangle.empty else piece_of(triangle, tile_x, tile_y)
        if piece is None:
            assert triangle.empty or not (covered & shown).any()
            continue
        depth_plane(rng, piece)
        piece["slot"], piece["order"] = number, orders[number]
        pieces.append((piece, covered, depth_at(piece, columns, rows)))
    return shown, z, orders, pieces


@functools.cache
def random_tiles():
    """(kind, pieces) of each tile, the same for every kernel."""
    rng = np.random.default_rng(3)
    kinds = ["small", "medium", "centers", "sliver", "budget"]
    chosen = itertools.islice(itertools.cycle(kinds), TILES)
    return [(kind, random_pieces(rng, kind)) for kind in chosen]


def draw_pieces(kernels, use, shown, first, orders, pieces):
    """Draw pieces one after the other; after each the tile is as expected."""
    z, slot = first.copy(), first_slots(use)
    tile = Tile(z, slot)
    for piece, covered, new in pieces:
        getattr(kernels, use)(piece.view(np.uint8), *tile.buffers, orders)
        EXPECTATIONS[use](piece, covered, new, z, slot, orders)
        tile.check(z, slot, shown)


@all_backends
@pytest.mark.parametrize("use", EXPECTATIONS)
def test_random_pieces(kernels, use):
    drawn = collections.Counter()
    for kind, (shown, z, orders, pieces) in random_tiles():
        draw_pieces(kernels, use, shown, z, orders, pieces)
        drawn[kind] += len(pieces)
    assert len(drawn) == 5 and min(drawn.values()) > 40
    assert sum(drawn.values()) * TILE * TILE > 10**6


def test_budget_pieces_come_close_to_32_bits():
    """The tests reach edge functions of more than 2^31 - 2^26, and none beyond 2^31."""
    rng = np.random.default_rng(4)
    largest = 0
    for _ in range(400):
        width, height, tile_x, tile_y = random_tile(rng, "budget")
        corners = random_corners(rng, "budget", tile_x, tile_y)
        triangle = Triangle(corners[:, 0], corners[:, 1], width, height)
        piece = None if triangle.empty else piece_of(triangle, tile_x, tile_y)
        if piece is None:
            continue
        e, a, b = (piece[name][0].astype(np.int64) for name in ("e", "a", "b"))
        for column, row in itertools.product((0, TILE - 1), repeat=2):
            largest = max(largest, int(np.abs(e + a * column + b * row).max()))
    assert 2**31 - 2**26 < largest < 2**31


def rectangle(x0, y0, x1, y1):
    """The two triangles of a box of samples, ends included."""
    corners = 256 * np.array([(x0, y0), (x1 + 1, y0), (x1 + 1, y1 + 1), (x0, y1 + 1)])
    for half in ([0, 1, 2], [0, 2, 3]):
        yield Triangle(corners[half, 0], corners[half, 1], TILE, TILE)


@functools.cache
def half_boxes():
    """First depths and the piece of half rectangles of every width at a third of the columns."""
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    rng, made = np.random.default_rng(5), []
    for x0 in range(0, TILE, 3):
        for x1 in [*range(x0, min(x0 + 18, TILE)), TILE - 1]:
            y0, y1 = sorted(rng.integers(0, TILE, 2))
            for triangle in rectangle(x0, y0, x1, y1):
                piece = piece_of(triangle, 0, 0)
                piece["zmin"], piece["zmax"], piece["gx"], piece["slot"] = -1, 1, 1 / 64, 7
                covered, new = triangle.covers(columns, rows), depth_at(piece, columns, rows)
                made.append((first_depths(rng), (piece, covered, new)))
    return made


@all_backends
@pytest.mark.parametrize("use", EXPECTATIONS)
def test_every_box(kernels, use):
    """Each alone in a tile, of a random height."""
    everywhere, orders = np.ones((TILE, TILE), bool), np.zeros(8, np.uint32)
    for z, piece in half_boxes():
        draw_pieces(kernels, use, everywhere, z, orders, [piece])

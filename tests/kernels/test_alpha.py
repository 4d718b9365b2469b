"""raster_alpha, alpha, lay and blend against R80, R83 and R84."""

import functools

import numpy as np
import pytest
from kernels.arithmetic import ONE, clamp
from kernels.harness import all_backends, bits, check_lanes, check_poisoned, hostile
from kernels.layouts import PAD, RECORD, SHOWN, SHOWN_ROOM, TEXTURE_BATCH, TILE
from kernels.pieces import Triangle, piece_of
from kernels.surfaces import LANES, at, bytes_of, fill, planes, random_batches, random_surfaces
from kernels.test_interpolate import dot
from kernels.test_paint import SAMPLES, random_samples
from kernels.test_raster import BEYOND_FAR, depth_plane, random_corners, random_tile
from kernels.test_texture import (
    SIDE_WRAPS,
    SIZES,
    UNITS,
    chain_sizes,
    numbers_of,
    random_coordinates,
    sampled,
    stored,
)

from engine3d._native.rasterizer import FILTERS

LEAST_ALPHA = np.float32(2.0**-24)
NEARBY, AT, SLOT = 5, 7, 6  # IDs before and behind a piece's own, which has the same order


def over(planes, color, alpha, samples):
    """R84 of different samples: what the planes hold afterwards."""
    after = planes.copy()
    alpha = np.where(alpha >= LEAST_ALPHA, alpha, np.float32(0))
    rest = ONE - alpha
    for k in range(3):
        after[k, samples] = clamp(color[k], 0, ONE) * alpha + planes[k, samples] * rest
    after[3, samples] = alpha + planes[3, samples] * rest
    return after


def random_planes(rng):
    made = rng.random((4, SAMPLES + PAD), np.float32)
    made[3, ::3], made[:, ::5] = 1, 0
    made[3] = made.max(axis=0)  # colours are multiplied by their alphas
    return made


@all_backends
def test_lay(kernels):
    rng = np.random.default_rng(80)
    batches = random_batches(rng)
    random_samples(rng, batches)
    fields = batches.fields
    fields["color"] = hostile(rng, fields["color"].size, 1.5).reshape(fields["color"].shape)
    alpha = rng.random(fields["alpha"].shape, np.float32)
    alpha[:, ::3], alpha[:, ::4], alpha[:, 1::7] = 0, 1, LEAST_ALPHA * np.float32(0.5)
    fields["alpha"] = alpha
    for row, one in zip(batches.rows, fields, strict=True):
        count, got = int(one["count"]), random_planes(rng)
        expected = over(got, one["color"][:, :count], one["alpha"][:count], one["sample"][:count])
        kernels.lay(row, got)
        assert np.array_equal(bits(got), bits(expected)), f"{count} samples"


def through_one(planes, color, through, sample):
    """R135"""
    alpha = color[3] if color[3] >= LEAST_ALPHA else np.float32(0)
    rest = (ONE - alpha) + alpha * through
    planes[:3, sample] = np.minimum(color[:3] * alpha + planes[:3, sample] * rest, ONE)
    mean = ((rest[0] + rest[1]) + rest[2]) * np.float32(1 / 3)
    most = planes[:3, sample].max()
    planes[3, sample] = (ONE - mean) + planes[3, sample] * mean
    if most >= LEAST_ALPHA:
        planes[3, sample] = max(planes[3, sample], most)


@functools.cache  # for all backends
def through_rounds():
    """Batches, and of each of them its textures, the planes before it and those after it."""
    rng = np.random.default_rng(135)
    batches = random_batches(rng)
    random_samples(rng, batches)
    fields = batches.fields
    fields["color"] = hostile(rng, fields["color"].size, 1.5).reshape(fields["color"].shape)
    fields["alpha"] = rng.choice(
        np.array([1, 1, 0, 0.5, 2.0**-25], np.float32), fields["alpha"].shape
    )
    rounds = []
    for one in fields:
        count, before, textures = int(one["count"]), random_planes(rng), np.zeros(1, TEXTURE_BATCH)
        textures["through"] = rng.random(textures["through"].shape, np.float32)
        textures["through"][0, :, ::5], textures["through"][0, :, 1::7] = 1, 0
        before[:, ::9] = 0
        expected = before.copy()
        color = np.concatenate([clamp(one["color"], 0, ONE), one["alpha"][np.newaxis]])
        for n in range(count):
            through_one(expected, color[:, n], textures["through"][0, :, n], one["sample"][n])
        rounds.append((textures.view(np.uint8), before, expected))
    return batches, rounds


@all_backends
def test_lay_through(kernels):
    batches, rounds = through_rounds()
    for row, (textures, before, expected) in zip(batches.rows, rounds, strict=True):
        got = before.copy()
        kernels.lay_through(row, textures, got)
        assert np.array_equal(bits(got), bits(expected))
        assert (got[:3] <= np.maximum(got[3], LEAST_ALPHA)).all()
        assert got.max() <= 1


def alphas_of(texture_alpha, base, surface, w, r, by_vertex, by_instance):
    """R80"""
    alpha = np.full(r.shape, base, np.float32) if texture_alpha is None else texture_alpha
    if by_vertex:
        alpha = alpha * (dot(w, [surface["alpha"][..., k] for k in range(3)]) * r)
    if by_instance:
        alpha = alpha * surface["instance_alpha"]
    return clamp(alpha, np.float32(0), ONE)


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def rounds_without_a_texture(by_vertex, by_instance):
    """Batches, the bytes of their surfaces, what kernels take besides, and the alphas of it."""
    made = []
    for seed in range(2):
        rng = np.random.default_rng(seed)
        surfaces, batches = random_surfaces(rng), random_batches(rng)
        for name in ("alpha", "instance_alpha"):
            surfaces[name] = hostile(rng, surfaces[name].shape, 1.2, 0.03)
        shape = batches.fields["color"].shape
        w = hostile(rng, shape, 1.0, 0.03)
        r = hostile(rng, (shape[0], shape[2]), 1.0, 0.03)
        fill(batches, "weight", w)
        fill(batches, "r", r)
        base = np.float32(rng.choice([0.3, 1.0, np.nan, 7.0]))
        surface = at(surfaces, batches.fields["surface"])
        expected = alphas_of(None, base, surface, planes(w), r, by_vertex, by_instance)
        made.append((batches, bytes_of(surfaces), base, expected))
    return made


@all_backends
@pytest.mark.parametrize("by_vertex", [False, True])
@pytest.mark.parametrize("by_instance", [False, True])
def test_alpha_without_a_texture(kernels, by_vertex, by_instance):
    for template, surfaces, base, expected in rounds_without_a_texture(by_vertex, by_instance):
        batches = template.copy()
        for row in batches.rows:
            kernels.alpha(row, surfaces, None, base, by_vertex, by_instance)
        check_lanes("alpha", batches.fields["alpha"], expected, batches.fields["count"])
        check_poisoned(batches.fields, ["position", "normal", "uv", "lod", "energy", "shine"])
        batches.check_gaps()


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def rounds_of_a_texture(filter_name, width, wrap, opaque):
    """As `rounds_without_a_texture`."""
    unit, made = UNITS[filter_name == "nearest", width], []
    for seed in (3,) if opaque else (2, 7):
        rng = np.random.default_rng(seed)
        batches = random_batches(rng)
        sizes = chain_sizes(*SIZES[seed], levels=16 if filter_name == "trilinear" else 1)
        count = int((sizes[:, 0].astype(np.int64) * sizes[:, 1]).sum())
        most = 255 if width == 8 else 32767
        texels = rng.integers(0, most + 1, (count, 4)).astype(np.uint16)
        if opaque:
            texels[:, 3] = most
        uv = random_coordinates(rng, batches.fields["uv"].shape, sizes)
        lod = rng.integers(0, (len(sizes) - 1) * 256 + 1, (len(uv), LANES)).astype(np.int32)
        lod[::3] &= ~255
        fill(batches, "uv", uv)
        batches.fields["lod"] = lod
        base = np.float32(rng.random())
        given = stored(texels, sizes, wrap, width)
        texture = given, width, sizes, FILTERS[filter_name], numbers_of(wrap), opaque
        surfaces = bytes_of(random_surfaces(rng))
        alpha_first = np.roll(texels, 1, axis=1)
        values = sampled(alpha_first, sizes, filter_name, wrap, planes(uv), lod, width)[..., 0]
        expected = clamp(values.astype(np.float32) * (base * unit), np.float32(0), ONE)
        made.append((batches, surfaces, texture, base, expected))
    return made


@all_backends
@pytest.mark.parametrize("opaque", [False, True])
@pytest.mark.parametrize("wrap", SIDE_WRAPS[::2], ids="-".join)
@pytest.mark.parametrize(
    ("filter_name", "width"),
    [("nearest", 8), ("bilinear", 8), ("nearest", 16), ("bilinear", 16), ("trilinear", 16)],
)
def test_alpha_of_a_texture(kernels, filter_name, width, wrap, opaque):
    rounds = rounds_of_a_texture(filter_name, width, wrap, opaque)
    for template, surfaces, texture, base, expected in rounds:
        batches = template.copy()
        for row in batches.rows:
            kernels.alpha(row, surfaces, texture, base, False, False)
        check_lanes("alpha", batches.fields["alpha"], expected, batches.fields["count"])


def depths_of(piece, column, row):
    """R14"""
    p = piece[0]
    dx, dy = (column - p["base_x"]).astype(np.float32), (row - p["base_y"]).astype(np.float32)
    with np.errstate(invalid="ignore", over="ignore"):
        return clamp((p["z0"] + dx * p["gx"]) + dy * p["gy"], p["zmin"], p["zmax"])


def random_pieces(rng, wanted):
    """(triangle, piece, first sample of its tile), of every size."""
    kinds = ["small", "medium", "centers", "sliver", "budget"]
    while wanted:
        kind = str(rng.choice(kinds))
        width, height, x, y = random_tile(rng, kind)
        corners = random_corners(rng, kind, x, y)
        triangle = Triangle(corners[:, 0], corners[:, 1], width, height)
        if triangle.empty:
            continue
        piece = piece_of(triangle, x, y)
        if piece is not None:
            depth_plane(rng, piece)
            wanted -= 1
            yield triangle, piece, (x, y)


@all_backends
def test_raster_alpha(kernels):
    """Every sample in front of what is kept, row by row; of equal depths what comes first."""
    rng = np.random.default_rng(83)
    records = np.zeros((1, 8), RECORD)
    records["order"] = [[0, 0, 0, 0, 0, 9, 9, 9]]
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    ties = 0
    for triangle, piece, (x, y) in random_pieces(rng, 300):
        piece["slot"], piece["order"] = SLOT, 9
        z = depths_of(piece, columns, rows)
        limit = np.full(SAMPLES + PAD, BEYOND_FAR, np.float32)
        limit[:SAMPLES] = np.where(rng.random(SAMPLES) < 0.3, z.ravel(), limit[:SAMPLES])
        limit[:SAMPLES:5] = rng.uniform(-1, 1, limit[:SAMPLES:5].shape)
        kept = rng.choice([-1, 2, NEARBY, AT], SAMPLES + PAD).astype(np.int32)
        equal = z.ravel() == limit[:SAMPLES]
        inside = triangle.covers(columns + x, rows + y)
        p = piece[0]
        inside &= (columns >= p["x0"]) & (columns <= p["x1"])
        inside &= (rows >= p["y0"]) & (rows <= p["y1"])
        shows = inside.ravel() & ((z.ravel() < limit[:SAMPLES]) | (equal & (kept[:SAMPLES] == AT)))
        ties += (inside.ravel() & equal).sum()
        shown, depth = np.zeros(1, SHOWN), np.zeros(SHOWN_ROOM + 2 * PAD, np.float32)
        given = piece.view(np.uint8), records.view(np.uint8), limit, kept
        following, again = kernels.raster_alpha(*given, shown.view(np.uint8), depth)
        count = int(shown["count"][0])
        expected = np.flatnonzero(shows)
        assert (following, again) == (p["y1"] + 1, False)
        assert np.array_equal(shown["sample"][0, :count], expected)
        assert np.array_equal(bits(depth[:count]), bits(z.ravel()[expected]))
        assert shown["primitives"][0] == (count > 0)
        assert (shown["of"][0, :count] == 0).all()
        if count:
            assert tuple(shown["primitive"][0, 0]) == (SLOT, 0)
            _, again = kernels.raster_alpha(*given, shown.view(np.uint8), depth)
            assert not again  # each call begins a list of bits of its own
    assert ties > 1000


@all_backends
def test_a_full_list_is_gone_on_with(kernels):
    """Whole rows, as many as fit; the rest from the row that is returned on."""
    corners = np.array([(-99999, -99999), (99999, -99999), (0, 199999)])
    triangle = Triangle(corners[:, 0], corners[:, 1], TILE, TILE)
    piece = piece_of(triangle, 0, 0)
    records = np.zeros((1, 1), RECORD).view(np.uint8)
    limit = np.full(SAMPLES + PAD, BEYOND_FAR, np.float32)
    kept = np.full(SAMPLES + PAD, -1, np.int32)
    shown, depth = np.zeros(1, SHOWN), np.zeros(SHOWN_ROOM + 2 * PAD, np.float32)
    shown["count"] = 1000
    given = records, limit, kept, shown.view(np.uint8), depth
    row, _ = kernels.raster_alpha(piece.view(np.uint8), *given)
    assert row == (SHOWN_ROOM - 1000) // TILE
    assert shown["count"][0] == 1000 + row * TILE
    piece["y0"], shown["count"] = row, 0
    assert kernels.raster_alpha(piece.view(np.uint8), *given)[0] == TILE
    assert shown["count"][0] == (TILE - row) * TILE
    assert np.array_equal(shown["sample"][0, : (TILE - row) * TILE], np.arange(row * TILE, SAMPLES))


@all_backends
@pytest.mark.parametrize("transmits", [False, True])
def test_blend(kernels, transmits):
    """Sorted by depth; samples that have much, or the same depth twice, are left."""
    rng = np.random.default_rng(84)
    for most in (1, 3, 20, 64, 80):
        counts = rng.integers(0, most + 1, SAMPLES)
        counts[rng.random(SAMPLES) < 0.95] = 0
        first = np.concatenate([[0], np.cumsum(counts)]).astype(np.uint32)
        total = int(first[-1])
        depth = rng.choice(np.arange(-(2**30), 2**30, 1001), total + PAD, False).astype(np.int32)
        tied = rng.random(SAMPLES) < 0.2
        for s in np.flatnonzero(tied & (counts > 1)):
            depth[first[s]] = depth[first[s + 1] - 1]
        which = rng.permutation(total).astype(np.uint32)
        color = rng.random((max(total, 1), 4), np.float32)
        color[::5, 3], color[::7, 3], color[::9, 3] = 0, 1, -0.5
        through = rng.random(color.shape, np.float32)
        through[:, 3] = transmits * rng.integers(0, 2, len(color))
        got, left = random_planes(rng), np.zeros(SAMPLES, np.uint16)
        expected, skipped = got.copy(), []
        for s in np.flatnonzero(counts):
            own = slice(first[s], first[s + 1])
            if counts[s] > 64 or (tied[s] and counts[s] > 1):
                skipped.append(s)
                continue
            for n in which[own][np.argsort(-depth[own].astype(np.int64))]:
                if through[n, 3]:
                    through_one(expected, color[n], through[n, :3], s)
                else:
                    expected = _over_one(expected, color[n], s)
        shares = through if transmits else None
        count = kernels.blend(first, depth, which, color, got, left, shares)
        assert left[:count].tolist() == skipped
        assert np.array_equal(bits(got), bits(expected))


def lay_light(lit, light, through):
    """R123: of one fragment."""
    alpha = light[3] if light[3] >= LEAST_ALPHA else np.float32(0)
    rest = ONE - alpha + (alpha * through[:3] if through[3] else np.float32(0))
    return light[:3] * alpha + lit * rest


@all_backends
@pytest.mark.parametrize("axis", [1, 2, 4])
def test_blend_lays_light(kernels, axis):
    """Radiance, of any brightness, over that of the pixels whose samples these are."""
    rng = np.random.default_rng(85)
    counts = rng.integers(0, 4, SAMPLES)
    first = np.concatenate([[0], np.cumsum(counts)]).astype(np.uint32)
    total = int(first[-1])
    depth = rng.choice(np.arange(2**20), total + PAD, False).astype(np.int32)
    which = rng.permutation(total).astype(np.uint32)
    color, through = rng.random((2, total, 4), np.float32)
    through[:, 3] = rng.integers(0, 2, total)
    light = (2.0 ** rng.uniform(-9, 9, (total, 4))).astype(np.float32)
    light[:, 3] = rng.random(total, np.float32)
    light[::5, 3] = 0
    got = rng.random((SAMPLES, 3), np.float32)
    expected = got.copy()
    side = TILE // axis
    for y, x in np.ndindex(side, side):
        s = (y * axis + axis // 2) * TILE + x * axis + axis // 2
        own, pixel = slice(first[s], first[s + 1]), y * TILE + x
        for n in which[own][np.argsort(-depth[own])]:
            expected[pixel] = lay_light(expected[pixel], light[n], through[n])
    left = np.zeros(SAMPLES, np.uint16)
    planes_of = random_planes(rng), left, through, light, got, axis
    assert kernels.blend(first, depth, which, color, *planes_of) == 0
    assert np.array_equal(bits(got), bits(expected))


def _over_one(planes, color, sample):
    alpha = color[3] if color[3] >= LEAST_ALPHA else np.float32(0)
    rest = ONE - alpha
    whole = np.array([*color[:3], 1], np.float32)
    planes[:, sample] = whole * alpha + planes[:, sample] * rest
    return planes

"""paint: the pixels, or samples, of what each step's kernel gives; put: those of colours."""

import functools
import itertools

import numpy as np
import pytest
from kernels.arithmetic import clamp
from kernels.harness import all_backends, bits, every_count, hostile
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    PAD,
    TILE,
    WANT_FLAT,
    WANT_LEVEL,
    WANT_NORMAL,
    WANT_POSITION,
    WANT_SURFACE,
    WANT_UV,
    WANT_WEIGHTS,
)
from kernels.surfaces import bytes_of, random_batches, random_surfaces
from kernels.test_encode import expected_bytes
from kernels.test_light import random_lights, reach_of
from kernels.test_texture import WRAP_PAIRS, chain_sizes, numbers_of, stored

from engine3d._native.rasterizer import FILTERS

UNTOUCHED = 0x12345678
SAMPLES = TILE * TILE


def random_samples(rng, batches):
    """Each sample once, as whole rows, as short runs and scattered; repeated to the pad's end."""
    fields = batches.fields
    fields["count"] = np.maximum(every_count(rng, BATCH, len(fields)), 1)
    for row in fields:
        run = int(rng.choice([1, 5, 16, 64]))
        starts = rng.permutation(SAMPLES // run)[: BATCH // run + 1] * run
        samples = (starts[:, None] + np.arange(run)).ravel()
        last = np.minimum(np.arange(BATCH + PAD), row["count"] - 1)
        row["sample"] = samples[last]
        row["surface"] = row["surface"][last]


@functools.cache
def surfaces_and_batches():
    """The bytes of random surfaces, and batches of samples of them, to be copied."""
    rng = np.random.default_rng(7)
    surfaces, batches = random_surfaces(rng), random_batches(rng)
    random_samples(rng, batches)
    return bytes_of(surfaces), batches


def random_texture(rng, filter_name, bits):
    sizes = chain_sizes(37, 50, levels=16 if filter_name == "trilinear" else 1)
    count = int((sizes[:, 0].astype(np.int64) * sizes[:, 1]).sum())
    texels = rng.integers(0, 256 if bits == 8 else 32768, (count, 4)).astype(np.uint16)
    wrap = WRAP_PAIRS[rng.integers(len(WRAP_PAIRS))]
    return stored(texels, sizes, wrap, bits), bits, sizes, FILTERS[filter_name], numbers_of(wrap)


def random_material(rng, texture, lit):
    """The arguments of paint from `wanted` to `srgb`, some of the choices at random."""
    wanted = WANT_SURFACE | (WANT_UV if texture else 0)
    by_vertex, by_instance = (bool(rng.integers(2)) for _ in range(2))
    if by_vertex:
        wanted |= WANT_WEIGHTS
    if texture and texture[3] == FILTERS["trilinear"]:
        wanted |= WANT_LEVEL
    lighting, shiny = None, bool(rng.integers(2))
    base, emissive = rng.random(3).astype(np.float32), hostile(rng, 3, 0.2, finite=True)
    if rng.integers(2):
        base, emissive = (np.repeat(v[:1], 3) for v in (base, emissive))
    if lit:
        wanted |= WANT_NORMAL | WANT_POSITION | (WANT_FLAT if rng.integers(2) else 0)
        lights = random_lights(rng, int(rng.integers(0, 5)))
        grey = bool(rng.integers(2))
        if grey:
            lights["color"] = lights["color"][:, :1]
        eye = np.float32([(0.5, 2, 4, 1), (0, 0.6, 0.8, 0)][rng.integers(2)])
        clamp = np.float32([(0, np.inf), (0.1, 1)][rng.integers(2)])
        ambient = rng.random(1 if grey else 3).astype(np.float32) * np.ones(3, np.float32)
        lighting = lights.view(np.uint8), reach_of(lights), ambient, clamp, eye
    return {
        "wanted": wanted,
        "texture": texture,
        "base": base,
        "by_vertex": by_vertex,
        "by_instance": by_instance,
        "lighting": lighting,
        "shininess": 20.0 if shiny else 0.0,
        "specular": rng.random(3).astype(np.float32) if shiny else None,
        "emissive": emissive if rng.integers(2) else None,
        "srgb": bool(rng.integers(2)),
    }


def untouched():
    """The planes of a tile's samples: three of colours, and whether they count."""
    return np.full((4, SAMPLES + PAD), UNTOUCHED, np.uint32).view(np.float32)


def kept(colors, samples):
    """What the planes hold after samples of these colours, (3, n)."""
    planes = untouched()
    planes[:3, samples] = clamp(colors, np.float32(0), np.float32(1))
    planes[3, samples] = 1
    return planes


def step_by_step(kernels, row, batch, surfaces, m):
    """The tile, and the planes of samples, after every kernel in turn."""
    kernels.interpolate(row, surfaces, m["wanted"])
    batch["color"] = m["base"][:, None]
    if m["texture"]:
        texels, bits, sizes, filter_number, wrap = m["texture"]
        kernels.texture(row, texels, bits, sizes, filter_number, wrap, m["base"])
    if m["by_vertex"] or m["by_instance"]:
        kernels.tint(row, surfaces, m["by_vertex"], m["by_instance"])
    if m["lighting"]:
        kernels.light(row, *m["lighting"], m["shininess"])
        nothing = np.zeros(3, np.float32)
        kernels.combine(row, m["specular"], nothing if m["emissive"] is None else m["emissive"])
    pixels, tile = np.zeros(BATCH + PAD, np.uint32), np.full(SAMPLES + PAD, UNTOUCHED, np.uint32)
    count = int(batch["count"])
    kernels.encode(*(np.ascontiguousarray(c) for c in batch["color"]), count, m["srgb"], pixels)
    tile[batch["sample"][:count]] = pixels[:count]
    return tile, kept(batch["color"][:, :count], batch["sample"][:count])


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def random_materials(filter_name, lit, count):
    rng, made = np.random.default_rng(7), []
    depths = [16] if filter_name == "trilinear" else [8, 16]
    for channel_bits in itertools.islice(itertools.cycle(depths), count):
        texture = random_texture(rng, filter_name, channel_bits) if filter_name else None
        made.append(random_material(rng, texture, lit))
    return made


@all_backends
@pytest.mark.parametrize("filter_name", [None, *FILTERS])
@pytest.mark.parametrize("lit", [False, True])
def test_paint(kernels, filter_name, lit):
    surfaces, batches = surfaces_and_batches()
    batches, differing = batches.copy(), set()
    materials = random_materials(filter_name, lit, len(batches.rows))
    for row, fields, material in zip(batches.rows, batches.fields, materials, strict=True):
        tile, planes = np.full(SAMPLES + PAD, UNTOUCHED, np.uint32), untouched()
        before = row.copy()
        kernels.paint(row, surfaces, *material.values(), tile, planes)
        assert (tile == UNTOUCHED).all()  # where samples are kept, there are no pixels yet
        row[:] = before
        kernels.paint(row, surfaces, *material.values(), tile)
        for name in ("count", "sample", "surface"):
            given = before.view(BATCH_RECORD)[name]
            assert np.array_equal(row.view(BATCH_RECORD)[name], given), f"{name} was written"
        row[:] = before
        expected = step_by_step(kernels, row, fields, surfaces, material)
        assert np.array_equal(tile, expected[0]), f"{fields['count']} samples, {material}"
        assert np.array_equal(bits(planes), bits(expected[1])), (
            f"{fields['count']} samples, {material}"
        )
        differing.update(tile[fields["sample"][: fields["count"]]])
    assert len(differing) > 1000  # colours, not the one value of a broken test
    batches.check_gaps()


@all_backends
@pytest.mark.parametrize("srgb", [False, True])
def test_put(kernels, srgb):
    """Each colour where its sample is, whatever stands behind the batch's end."""
    rng = np.random.default_rng(8)
    batches = surfaces_and_batches()[1].copy()
    batches.fields["color"] = rng.random(batches.fields["color"].shape, np.float32)
    for row, fields in zip(batches.rows, batches.fields, strict=True):
        count, tile = int(fields["count"]), np.full(SAMPLES + PAD, UNTOUCHED, np.uint32)
        kernels.put(row, srgb, tile)
        expected = np.full_like(tile, UNTOUCHED)
        expected[fields["sample"][:count]] = expected_bytes(fields["color"][:, :count], srgb)
        assert np.array_equal(tile, expected), f"{count} samples"

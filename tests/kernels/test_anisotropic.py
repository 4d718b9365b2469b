"""texture, of anisotropic ones, against R110 to R113."""

import functools

import numpy as np
import pytest
from kernels.arithmetic import ONE, UNORM15_BLENDED, clamp, greatest, least, round_even
from kernels.harness import all_backends, check_lanes, check_poisoned, hostile
from kernels.layouts import TILE
from kernels.surfaces import BATCHES, LANES, at, bytes_of, fill, random_batches, random_surfaces
from kernels.test_texture import chain_sizes, numbers_of, random_coordinates, sampled, stored

from engine3d._native.rasterizer import FILTERS

MOST_TEXELS, LEAST_AXIS = np.float32(2.0**30), np.float32(2.0**-60)
HALF, FOUR = np.float32(0.5), np.float32(4)


def changes(words, fields):
    """R25, and the limits of R111: along the row and down the column, of u and v each."""
    sample = fields["sample"]
    dx = (sample % TILE).astype(np.float32) - words["base_x"]
    dy = (sample // TILE).astype(np.float32) - words["base_y"]
    r2 = fields["r"] * fields["r"]
    slope = words["slope"]
    along = [(slope[..., k, 0] + dy * slope[..., k, 2]) * r2 for k in range(2)]
    down = [(slope[..., k, 1] - dx * slope[..., k, 2]) * r2 for k in range(2)]
    return [[clamp(v, -MOST_TEXELS, MOST_TEXELS) for v in pair] for pair in (along, down)]


def probes(along, down, most, sizes, scale):
    """R111 and R112: how many, their steps in u and v, and the level."""
    a = along[0] * along[0] + down[0] * down[0]
    c = along[1] * along[1] + down[1] * down[1]
    b = along[0] * along[1] + down[0] * down[1]
    d = a - c
    root = np.sqrt(d * d + (b * b) * FOUR)
    longest2 = greatest(((a + c) + root) * HALF, ONE)
    longest = np.sqrt(longest2)
    area = np.abs(along[0] * down[1] - along[1] * down[0])
    shortest = greatest(area / longest, ONE)
    x = np.where(d >= 0, np.abs(d) + root, b + b)
    y = np.where(d >= 0, b + b, np.abs(d) + root)
    inverse = ONE / greatest(np.sqrt(x * x + y * y), LEAST_AXIS)
    count = round_even(least(longest / shortest, np.float32(most)))
    share = ONE / count.astype(np.float32)
    steps = []
    for k, axis in enumerate((x, y)):
        side = ONE / (np.float32(sizes[0, k]) * np.float32(scale))
        steps.append(((axis * inverse) * (longest * share)) * side)
    q = greatest(longest2 * (share * share), shortest * shortest)
    lod = (q.view(np.int32) - ONE.view(np.int32)) >> 16
    return count, steps, np.minimum(lod, (len(sizes) - 1) * 256)


def read(texels, sizes, wrap, uv, found):
    """R113"""
    count, steps, lod = found
    middle = (count.astype(np.float32) - ONE) * HALF
    total = np.zeros((*lod.shape, 3), np.float32)
    for k in range(count.max()):
        at_k = [uv[c] + (np.float32(k) - middle) * steps[c] for c in range(2)]
        value = sampled(texels, sizes, "trilinear", wrap, at_k, lod, 16)
        total = np.where((k < count)[..., None], total + value if k else value, total)
    return total / count.astype(np.float32)[..., None]


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def random_case(most, size, wrap, scale):
    """Batches, what kernels take of a texture, the surfaces' bytes, and the colours of it."""
    rng = np.random.default_rng(most * size[0])
    surfaces = random_surfaces(rng)
    stretch = 2.0 ** rng.uniform(-6, 10, surfaces["slope"].shape)
    tame = rng.random(surfaces["slope"].shape[-1]) < 0.9
    surfaces["slope"][..., tame] = (rng.normal(size=stretch.shape) * stretch)[..., tame]
    surfaces["slope"][:, 2, tame] *= np.float32(0.01)
    batches = random_batches(rng)
    sizes = chain_sizes(*size)
    count = int((sizes[:, 0].astype(np.int64) * sizes[:, 1]).sum())
    texels = rng.integers(0, 32768, (count, 4)).astype(np.uint16)
    uv = random_coordinates(rng, batches.fields["uv"].shape, sizes)
    uv = np.where(np.isfinite(uv), uv, np.float32(0.5))
    fill(batches, "uv", uv)
    r = np.abs(hostile(rng, (BATCHES, LANES), 1.0, 0.02, finite=True)) + np.float32(0.5)
    fill(batches, "r", r)
    base = np.array([0.5, 1.5, 1.0], np.float32)
    with np.errstate(all="ignore"):
        words = at(surfaces, batches.fields["surface"])
        fields = {"sample": batches.fields["sample"], "r": r}
        along, down = changes(words, fields)
        found = probes(along, down, most, sizes, scale)
        values = read(texels, sizes, wrap, [uv[:, 0], uv[:, 1]], found)
    assert found[0].max() == most
    assert found[0].min() == 1
    given = stored(texels, sizes, wrap, 16)
    texture = given, 16, sizes, FILTERS["trilinear"], numbers_of(wrap), base
    expected = [values[..., k] * (base[k] * UNORM15_BLENDED) for k in range(3)]
    return batches, texture, bytes_of(surfaces), expected


@all_backends
@pytest.mark.parametrize(
    ("most", "size", "wrap", "scale"),
    [
        (2, (64, 64), ("repeat", "repeat"), 1.0),
        (16, (256, 64), ("repeat", "mirror"), 1.0),
        (7, (37, 41), ("clamp", "clamp"), 0.75),
        (16, (1, 1), ("mirror", "repeat"), 2.0),
    ],
)
def test_anisotropic(kernels, most, size, wrap, scale):
    template, texture, surfaces, expected = random_case(most, size, wrap, scale)
    batches = template.copy()
    for row in batches.rows:
        kernels.texture(row, *texture, most, scale, surfaces)
    for k in range(3):
        got = batches.fields["color"][:, k]
        check_lanes(f"color[{k}]", got, expected[k], batches.fields["count"])
    check_poisoned(batches.fields, ["weight", "position", "normal", "lod", "energy", "shine"])
    batches.check_gaps()

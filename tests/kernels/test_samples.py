"""keep and average against R33: the colours of several samples a pixel, and their means."""

import numpy as np
import pytest
from kernels.harness import POISON, all_backends, bits, hostile
from kernels.layouts import PAD, TILE
from kernels.surfaces import random_batches
from kernels.test_encode import expected_bytes
from kernels.test_paint import SAMPLES, kept, random_samples, untouched

ONE = np.float32(1)


@all_backends
def test_keep(kernels):
    """Each colour where its sample is, whatever stands behind the batch's end."""
    rng = np.random.default_rng(8)
    batches = random_batches(rng)
    random_samples(rng, batches)
    colors = batches.fields["color"]
    batches.fields["color"] = hostile(rng, colors.size, 1.5).reshape(colors.shape)
    for row, fields in zip(batches.rows, batches.fields, strict=True):
        count, planes = int(fields["count"]), untouched()
        kernels.keep(row, planes)
        expected = kept(fields["color"][:, :count], fields["sample"][:count])
        assert np.array_equal(bits(planes), bits(expected)), f"{count} samples"


def averages(planes, axis, row, width, background, srgb):
    """R33, sample after sample."""
    tile = planes[:, :SAMPLES].reshape(4, TILE, TILE)[:, row : row + axis, : width * axis]
    total = np.zeros((4, width), np.float32)
    for y in range(axis):
        for x in range(axis):
            total = total + tile[:, y, x::axis]
    count = total[3]
    means = total[:3] * (ONE / np.maximum(count, ONE))
    means = np.where(count > 0, means, background[:, None])
    alpha = np.rint(np.float32(255) * (count / np.float32(axis**2)))
    pixels = expected_bytes(list(means), srgb) & np.uint32(0xFFFFFF)
    return pixels | alpha.astype(np.uint32) << 24


@all_backends
@pytest.mark.parametrize("axis", [2, 4])
@pytest.mark.parametrize("srgb", [False, True])
def test_average(kernels, axis, srgb):
    """Every width, with all, some and none of a pixel's samples counting."""
    rng = np.random.default_rng(9)
    planes = np.zeros((4, SAMPLES + PAD), np.float32)
    for share in (0.0, 0.1, 0.7, 1.0):
        planes[3] = rng.random(SAMPLES + PAD) < share
        planes[:3] = rng.random((3, SAMPLES + PAD), np.float32) * planes[3]
        planes[:3, ::7] = planes[3, ::7]
        background = rng.random(3, np.float32)
        for width in range(1, TILE // axis + 1):
            row = int(rng.integers(TILE // axis)) * axis
            rgba = np.full(width + PAD, POISON, np.uint32)
            kernels.average(planes, axis, row, width, background, srgb, rgba)
            expected = averages(planes, axis, row, width, background, srgb)
            assert np.array_equal(rgba[:width], expected), (share, width)

"""The kernel of lenses against R204, pixel by pixel."""

import numpy as np
import pytest
from kernels.arithmetic import ONE
from kernels.harness import all_backends, bits
from kernels.layouts import layout

FACES = ((0, 40, 30), (1280, 25, 50), (2560, 1, 3))  # start, width, height
TOTAL = 2563
MOST = 64


def weights(at, half, side):
    """The pixels along an axis that weigh something, and their weights."""
    numbers = np.arange(side)
    found = half - np.abs(256 * numbers + 128 - at)
    return numbers[found > 0], found[found > 0]


def mean(light, face, x, y, across, down):
    start, width, height = FACES[face]
    columns, wide = weights(x, across, width)
    rows, high = weights(y, down, height)
    total = np.zeros(4, np.float32)
    for row, share in zip(rows, high, strict=True):
        part = np.zeros(4, np.float32)
        for column, weight in zip(columns, wide, strict=True):
            part = part + light[start + row * width + column].astype(np.float32) * np.float32(
                weight
            )
        total = total + part * np.float32(share)
    whole = np.float32(wide.sum()) * np.float32(high.sum())
    return total * (ONE / whole if whole > 0 else np.float32(0))


@all_backends
@pytest.mark.parametrize("count", [1, 3, 4, 5, 8, 15, 16, 17, MOST])
@pytest.mark.parametrize("widest", [257, 700, 8192])
def test_means_are_those_of_the_rule(kernels, count, widest):
    rng = np.random.default_rng(count + widest)
    light = rng.integers(0, 65536, (TOTAL, 4)).astype(np.uint16)
    light[rng.integers(0, TOTAL, 200)] = 65535
    batch = np.zeros(1, layout("e3d_lens_batch"))
    faces = rng.integers(0, len(FACES), batch["x"].shape[-1])
    faces[count:] = faces[count - 1]  # as whoever fills it promises
    sides = np.array(FACES)[faces]
    for name, column in (("start", 0), ("width", 1), ("height", 2)):
        batch[name] = sides[:, column]
    for name, most in (("x", 256 * sides[:, 1]), ("y", 256 * sides[:, 2])):
        batch[name] = rng.integers(0, most)
        batch[name][0, count:] = batch[name][0, count - 1]
    for name in ("across", "down"):
        batch[name] = rng.integers(256, widest, batch[name].shape)
    batch["count"] = count
    kernels.lens(light, batch)
    for i in range(count):
        where = [int(batch[name][0, i]) for name in ("x", "y", "across", "down")]
        wanted = mean(light, faces[i], *where)
        assert np.array_equal(bits(batch["light"][0, :, i].copy()), bits(wanted))

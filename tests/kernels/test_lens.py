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
@pytest.mark.parametrize("face", range(len(FACES)))
@pytest.mark.parametrize("count", [1, 3, 4, 5, 8, 15, 16, 17, MOST])
@pytest.mark.parametrize("widest", [257, 400, 700, 8192])
def test_means_are_those_of_the_rule(kernels, face, count, widest):
    rng = np.random.default_rng(count + widest)
    light = rng.integers(0, 65536, (TOTAL, 4)).astype(np.uint16)
    light[rng.integers(0, TOTAL, 200)] = 65535
    shown = np.zeros(1, layout("e3d_lens_face"))
    shown["start"], shown["width"], shown["height"] = FACES[face]
    pixels = np.zeros(count, layout("e3d_lens_pixel"))
    for name, most in (("x", 256 * FACES[face][1]), ("y", 256 * FACES[face][2])):
        pixels[name] = rng.integers(0, most, count)
    for name in ("across", "down"):
        pixels[name] = rng.integers(256, widest, count)
    got = np.full((count + 1, 4), 7, np.float32)
    kernels.lens(light, shown, pixels, count, got)
    for pixel, light_of in zip(pixels, got[:-1], strict=True):
        where = [int(pixel[name]) for name in ("x", "y", "across", "down")]
        assert np.array_equal(bits(light_of), bits(mean(light, face, *where)))
    assert np.all(got[-1] == 7)

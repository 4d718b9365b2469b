"""Section 31 of docs/exactness: the filter of colours, by an oracle written from its rules."""

import itertools

import numpy as np
import pytest

from engine3d._native import lens as native
from engine3d._native import rasterizer

BACKENDS = [k for k in rasterizer.BACKENDS.values() if rasterizer.backend_available(k)]
SIZE = 24, 16  # of the lens's picture
FACES = ((0, 40, 30), (1280, 25, 50))  # start, width, height


def codes(is_srgb):
    room = np.empty(native.CODES_BYTES, np.uint8)
    native.fill_codes(room, is_srgb)
    return room, room[:512].view(np.uint16), room[512:]


def random_case(seed):
    """Pixels that look anywhere into two faces, with filters of every width."""
    rng = np.random.default_rng(seed)
    width, height = SIZE
    kind = [("x", "<i4"), ("y", "<i4"), ("face", "<i4"), ("across", "<u2"), ("down", "<u2")]
    pixels = np.zeros((height, width), kind)
    pixels["face"] = rng.integers(-1, 2, (height, width))
    sides = np.array([face[1:] for face in FACES])[pixels["face"]]
    pixels["x"] = rng.uniform(0, 256 * sides[..., 0] - 1)
    pixels["y"] = rng.uniform(0, 256 * sides[..., 1] - 1)
    for name in ("across", "down"):
        pixels[name] = rng.choice([256, 300, 384, 385, 700, 1500], (height, width))
    colors = rng.integers(0, 256, (1280 + 25 * 50, 4), dtype=np.uint8)
    if seed % 3:
        colors[:, 3] = 255
    elif seed % 2:
        colors[:, 3] = rng.choice([0, 255], len(colors))
    return pixels, colors


def taps(at, half, side):
    """The pixels along an axis that count, and their weights."""
    numbers = np.arange(side)
    weights = half - np.abs(256 * numbers + 128 - at)
    return numbers[weights > 0], weights[weights > 0].astype(np.float32)


def filtered(pixel, colors, light):
    """R204 in f32, one sum at a time."""
    start, width, height = FACES[pixel["face"]]
    columns, across = taps(int(pixel["x"]), int(pixel["across"]), width)
    rows, down = taps(int(pixel["y"]), int(pixel["down"]), height)
    total = np.zeros(4, np.float32)
    for row, weight in zip(rows, down, strict=True):
        part = np.zeros(4, np.float32)
        for column, share in zip(columns, across, strict=True):
            byte = colors[start + row * width + column].astype(int)
            opaque = [(int(light[c]) * byte[3] + 127) // 255 for c in byte[:3]]
            value = np.array([*opaque, byte[3] * 257], np.float32)
            part = part + value * share
        total = total + part * weight
    return total * (np.float32(1.0) / (across.sum() * down.sum()))


def encoded(mean, light, code, behind):
    """R205."""
    full, half = np.float32(65535.0), np.float32(0.5)
    alpha = int(mean[3] + half)
    color = mean[:3]
    if alpha < 65535 and behind is not None:
        apart = np.float32(1.0) - mean[3] * (np.float32(1.0) / full)
        color, alpha = color + apart * light[behind[:3]].astype(np.float32), 65535
    elif alpha < 65535:
        color = color * (full / mean[3] if alpha > 0 else np.float32(0.0))
    bytes_ = [code[min(int(value + half), 65535)] for value in color]
    return [*bytes_, (alpha * 255 + 32767) // 65535]


@pytest.mark.parametrize("is_srgb", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_colours_are_filtered_by_the_rules(seed, is_srgb):
    pixels, colors = random_case(seed)
    room, light, code = codes(is_srgb)
    width, height = SIZE
    rows = [(*face, np.eye(3).tolist()) for face in FACES]
    raw = pixels.view(np.uint8).reshape(height, width, native.PIXEL_BYTES)
    lens = native.NativeLens(rows, raw, np.zeros((height, width, 3)))
    behind = None
    if seed % 2:
        behind = np.random.default_rng(seed).integers(0, 256, (height, width, 4), dtype=np.uint8)
    for backend, threads in itertools.product(BACKENDS, (1, 3)):
        drawn = np.empty((height, width, 4), np.uint8)
        scratch = np.empty((len(colors), 4), np.uint16)
        lens.draw(colors, scratch, behind, room, (1, 2, 3, 4), backend, threads, drawn)
        for row in range(height):
            for column in range(width):
                pixel = pixels[row, column]
                if pixel["face"] < 0:
                    assert drawn[row, column].tolist() == [1, 2, 3, 4]
                    continue
                under = None if behind is None else behind[row, column].astype(int)
                wanted = encoded(filtered(pixel, colors, light), light, code, under)
                assert drawn[row, column].tolist() == wanted


def test_codes_are_inverse():
    for is_srgb in (True, False):
        _, light, code = codes(is_srgb)
        assert code[light].tolist() == list(range(256))
        assert (np.diff(code.astype(int)) >= 0).all()

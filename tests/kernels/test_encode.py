"""encode against R33 and R34: colours, clamped, to bytes."""

import functools
import re
from pathlib import Path

import numpy as np
from kernels.arithmetic import clamp
from kernels.harness import POISON, all_backends, hostile
from kernels.layouts import PAD

TABLES = Path(__file__).parents[2] / "csrc" / "data" / "srgb_tables.c"
COUNT = 1 << 17
GUARD = 64


@functools.cache
def srgb_thresholds():
    """The 255 stored thresholds, read from the C file."""
    text = TABLES.read_text("utf-8")
    body = re.search(r"SRGB_THRESHOLDS\[256\] = \{(.*?)\}", text, re.DOTALL).group(1)
    values = [float.fromhex(word.strip().rstrip("f")) for word in body.split(",") if word.strip()]
    return np.array(values[:255], np.float32)


def expected_bytes(planes, srgb):
    planes = [clamp(plane, np.float32(0), np.float32(1)) for plane in planes]
    if srgb:
        codes = [np.searchsorted(srgb_thresholds(), plane, side="right") for plane in planes]
    else:
        codes = [np.rint(np.float32(255) * plane) for plane in planes]
    red, green, blue = (code.astype(np.uint32) for code in codes)
    return red | green << 8 | blue << 16 | np.uint32(0xFF000000)


def run(kernels, planes, count, srgb):
    """Encode the first `count`; everything beyond the pad must still be poison."""
    room = np.full(GUARD + len(planes[0]) + PAD + GUARD, POISON, np.uint32)
    kernels.encode(*planes, count, srgb, room[GUARD:])
    assert (room[:GUARD] == POISON).all()
    assert (room[GUARD + count + PAD :] == POISON).all()
    return room[GUARD : GUARD + count]


def worst_values():
    """Every threshold and every boundary of the float's upper bits, and their neighbours."""
    edges = np.concatenate(
        [
            srgb_thresholds(),
            (np.arange(0, 0x3F80 * 4, dtype=np.uint32) << 14).view(np.float32),
            ((np.arange(256) + np.float32(0.5)) / np.float32(255)).astype(np.float32),
            np.arange(256, dtype=np.float32) / np.float32(255),
            np.float32([0, 1e-45, 1e-38, 1]),
        ]
    )
    near = [np.nextafter(edges, np.float32(end)) for end in (0, 2)]
    return np.clip(np.concatenate([edges, *near]), 0, 1)


def srgb_codes(linear):
    """The sRGB formula (IEC 61966-2-1) in float64, before it is rounded to a code."""
    linear = np.asarray(linear, np.float64)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def test_thresholds_are_the_srgb_formula():
    """Each stored threshold is a 22nd of a code at most from where the formula passes the half.

    Direct3D 11.3 (section 3.2.3.7) allows a tenth.
    """
    error = srgb_codes(srgb_thresholds()) - (np.arange(255) + 0.5)
    assert np.abs(error).max() < 1 / 22


def test_codes_that_are_decoded_come_back():
    codes = np.arange(256)
    exact = np.where(codes <= 10, codes / 255 / 12.92, ((codes / 255 + 0.055) / 1.055) ** 2.4)
    for linear in (exact, np.rint(exact * 65535) / 65535):  # as texels are stored, too
        found = np.searchsorted(srgb_thresholds(), linear.astype(np.float32), side="right")
        assert np.array_equal(found, codes)


@all_backends
def test_random_and_worst_values(kernels):
    rng = np.random.default_rng(0)
    values = [worst_values(), rng.random(COUNT, np.float32), rng.random(COUNT, np.float32) ** 8]
    tiny = rng.integers(0, 0x3F800001, COUNT, np.uint32).view(np.float32)  # every exponent alike
    values = np.concatenate([*values, tiny, hostile(rng, COUNT, 2.0)])
    planes = [rng.permutation(values) for _ in range(3)]
    padded = [np.append(plane, np.zeros(PAD, np.float32)) for plane in planes]
    for srgb in (False, True):
        got = run(kernels, padded, len(values), srgb)
        assert np.array_equal(got, expected_bytes(planes, srgb))


@all_backends
def test_every_length(kernels):
    rng = np.random.default_rng(1)
    for count in range(2 * PAD + 2):
        planes = [rng.random(4 * PAD, np.float32) for _ in range(3)]
        for plane in planes:
            plane[count + PAD :] = 7.0
        for srgb in (False, True):
            got = run(kernels, planes, count, srgb)
            expected = expected_bytes([plane[:count] for plane in planes], srgb)
            assert np.array_equal(got, expected)


@all_backends
def test_grey(kernels):
    """Whole vectors of grey, which are looked up once, beside some of which one sample is not."""
    rng = np.random.default_rng(2)
    grey = np.append(rng.permutation(worst_values()), hostile(rng, COUNT, 2.0))
    planes = [grey, grey.copy(), grey.copy()]
    for plane in planes[1:]:
        plane[rng.integers(0, len(grey), len(grey) // 100)] = 0.5
    padded = [np.append(plane, np.zeros(PAD, np.float32)) for plane in planes]
    for srgb in (False, True):
        got = run(kernels, padded, len(grey), srgb)
        assert np.array_equal(got, expected_bytes(planes, srgb))

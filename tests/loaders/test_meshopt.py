"""Buffer views that meshopt packed, against streams packed one number after the other."""

import random

import numpy as np
import pytest
from loaders.meshopt_reference import pack_attributes, pack_indices, random_triangles

from engine3d._native.loaders import unpack_meshopt


def elements_of(choice, count, stride):
    """Elements that resemble each other, as those of meshes do."""
    rows = np.cumsum(
        np.random.default_rng(choice.randrange(1 << 30)).integers(
            -choice.choice([0, 1, 3, 100]), choice.choice([1, 2, 4, 100]), (count, stride)
        ),
        axis=0,
    )
    return rows.astype(np.uint8)


@pytest.mark.parametrize("version", [0, 1])
@pytest.mark.parametrize("stride", [4, 8, 12, 16, 64, 256])
def test_attributes(version, stride):
    for seed in range(12):
        choice = random.Random(f"{version} {stride} {seed}")
        elements = elements_of(choice, choice.choice([1, 15, 16, 17, 255, 256, 257, 700]), stride)
        packed = pack_attributes(elements, version, choice)
        found = unpack_meshopt(packed, "ATTRIBUTES", "NONE", len(elements), stride)
        assert np.array_equal(found.reshape(elements.shape), elements)


@pytest.mark.parametrize("stride", [2, 4])
def test_triangles_and_indices(stride):
    for seed in range(20):
        choice = random.Random(seed)
        packed, corners = random_triangles(choice.choice([1, 2, 30, 400]), choice)
        expected = np.array(corners, np.uint32).astype(f"<u{stride}")
        found = unpack_meshopt(packed, "TRIANGLES", "NONE", len(corners), stride)
        assert np.array_equal(found.view(f"<u{stride}"), expected)
        indices = [choice.randrange(1 << choice.choice([4, 16, 29])) for _ in range(100)]
        found = unpack_meshopt(pack_indices(indices, choice), "INDICES", "NONE", 100, stride)
        assert np.array_equal(
            found.view(f"<u{stride}"), np.array(indices, np.uint32).astype(f"<u{stride}")
        )


def test_the_example_of_the_specification():
    group = bytes.fromhex("175ff0bc77a9210034b5")
    deltas = [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0]
    stream = b"\xa0" + b"\2" + group + b"\0\0\0" + bytes(32)
    found = unpack_meshopt(stream, "ATTRIBUTES", "NONE", 16, 4).reshape(16, 4)
    assert np.array_equal(found[:, 0], np.cumsum(deltas).astype(np.uint8))
    assert not found[:, 1:].any()


@pytest.mark.parametrize("kind", ["ATTRIBUTES", "TRIANGLES", "INDICES"])
def test_damaged_streams_are_refused(kind):
    choice = random.Random(kind)
    if kind == "ATTRIBUTES":
        packed, count, stride = pack_attributes(elements_of(choice, 300, 12), 1, choice), 300, 12
    elif kind == "TRIANGLES":
        (packed, corners), stride = random_triangles(100, choice), 4
        count = len(corners)
    else:
        packed, count, stride = pack_indices(list(range(100)), choice), 100, 4
    assert unpack_meshopt(packed, kind, "NONE", count, stride) is not None
    for size in range(len(packed)):
        assert unpack_meshopt(packed[:size], kind, "NONE", count, stride) is None
    assert unpack_meshopt(packed[:1] + b"\0" + packed[1:], kind, "NONE", count, stride) is None
    assert unpack_meshopt(b"\x99" + packed[1:], kind, "NONE", count, stride) is None
    for _ in range(2000):
        data = bytearray(packed)
        data[choice.randrange(len(data))] = choice.randrange(256)
        unpack_meshopt(bytes(data), kind, "NONE", count, stride)


@pytest.mark.parametrize(
    ("mode", "filter", "count", "stride"),
    [
        ("ATTRIBUTES", "NONE", 16, 6),
        ("ATTRIBUTES", "NONE", 16, 260),
        ("ATTRIBUTES", "NONE", 16, 0),
        ("ATTRIBUTES", "OCTAHEDRAL", 16, 12),
        ("ATTRIBUTES", "QUATERNION", 16, 4),
        ("ATTRIBUTES", "COLOR", 16, 12),
        ("ATTRIBUTES", "SOFT", 16, 4),
        ("TRIANGLES", "NONE", 16, 4),
        ("TRIANGLES", "NONE", 15, 3),
        ("INDICES", "EXPONENTIAL", 15, 4),
        ("NOTHING", "NONE", 15, 4),
    ],
)
def test_what_makes_no_sense_is_refused(mode, filter, count, stride):
    assert unpack_meshopt(bytes(1000), mode, filter, count, stride) is None


def unfiltered(elements, filter):
    """What a filter makes of elements (N, stride) uint8."""
    packed = pack_attributes(elements, 0, random.Random(1))
    found = unpack_meshopt(packed, "ATTRIBUTES", filter, *elements.shape)
    return found.reshape(elements.shape)


@pytest.mark.parametrize(("code", "bits"), [(np.int8, 8), (np.int16, 12)])
def test_octahedral(code, bits):
    rng = np.random.default_rng(5)
    normals = rng.normal(size=(200, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    one, most = (1 << (bits - 1)) - 1, np.iinfo(code).max
    flat = normals / np.abs(normals).sum(axis=1, keepdims=True)
    folded = (1 - np.abs(flat[:, 1::-1])) * np.where(flat[:, :2] < 0, -1, 1)
    xy = np.where(flat[:, 2:] < 0, folded, flat[:, :2])
    elements = np.empty((200, 4), code)
    elements[:, :2], elements[:, 2], elements[:, 3] = np.rint(xy * one), one, 7
    found = unfiltered(elements.view(np.uint8), "OCTAHEDRAL").view(code)
    assert np.abs(found[:, :3] / most - normals).max() < 4 / one
    assert (found[:, 3] == 7).all()


def test_quaternions():
    rng = np.random.default_rng(6)
    q = rng.normal(size=(100, 4))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    largest, one = np.abs(q).argmax(axis=1), (1 << 11) - 1
    elements = np.empty((100, 4), np.int16)
    for row, (value, k) in enumerate(zip(q, largest, strict=True)):
        value *= np.sign(value[k])
        rest = [value[(k + i) % 4] for i in (1, 2, 3)]
        elements[row, :3] = np.rint(np.array(rest) * np.sqrt(2) * one)
        elements[row, 3] = one & ~3 | k
    found = unfiltered(elements.view(np.uint8), "QUATERNION").view(np.int16) / 32767
    assert np.abs(found - q).max() < 2 / one


def test_exponentials_are_exact():
    mantissas = np.array([0, 1, -1, 12345, -(2**23), 2**23 - 1], np.int32)
    exponents = np.array([-100, -24, 0, 3, 100, 20], np.int32)
    words = (exponents << 24 | mantissas & 0xFFFFFF).astype(np.int32)
    found = unfiltered(words.reshape(-1, 1).view(np.uint8), "EXPONENTIAL").view(np.float32)
    expected = np.ldexp(mantissas.astype(np.float64), exponents).astype(np.float32)
    assert np.array_equal(found[:, 0], expected)


def test_colors():
    rng = np.random.default_rng(7)
    rgba = rng.integers(0, 256, (100, 4))
    r, g, b, a = rgba.T // 2  # of 7 bits
    y, co, cg = (r + 2 * g + b) >> 2, (r - b) >> 1, (2 * g - r - b) >> 2
    elements = np.stack([y, co, cg, a // 2 | 64], axis=1).astype(np.int8)
    found = unfiltered(elements.view(np.uint8), "COLOR")
    assert np.abs(found.astype(int) - rgba).max() <= 12

"""The parser in C by itself: its numbers are Python's, and pieces make no difference."""

import random
import struct
from decimal import Decimal, getcontext

import numpy as np
import pytest

from engine3d._native import loaders as native


def parsed(text, step=1 << 30):
    reader = native.ObjReader(text)
    while reader.read(step):
        pass
    assert reader.end() == native.DONE, reader.error
    return reader.take()


def coordinates(words):
    """The words read as coordinates, as bits."""
    words = [*words, *["0"] * (-len(words) % 3)]
    rows = ["v " + " ".join(words[k : k + 3]) for k in range(0, len(words), 3)]
    return parsed("\n".join(rows).encode())["positions"].ravel().view(np.uint64)


def check_numbers(words):
    expected = np.array([float(word) for word in words]).view(np.uint64)
    wrong = np.flatnonzero(coordinates(words)[: len(words)] != expected)
    assert not len(wrong), [words[k] for k in wrong[:5]]


def random_double(choice):
    """Any finite double, exponents evenly spread."""
    while True:
        (value,) = struct.unpack("<d", struct.pack("<Q", choice.getrandbits(64)))
        if value - value == 0:
            return value


def test_numbers_as_programs_write_them():
    choice = random.Random(1)
    words = [f"{choice.uniform(-1000, 1000):.{choice.randrange(20)}f}" for _ in range(6000)]
    words += [f"{choice.uniform(-1, 1) * 10 ** choice.randint(-30, 30):g}" for _ in range(3000)]
    words += [repr(choice.uniform(-1, 1)) for _ in range(3000)]
    check_numbers(words)


def test_numbers_of_any_size_and_precision():
    choice = random.Random(2)
    check_numbers([f"{random_double(choice):.{choice.randrange(40)}e}" for _ in range(6000)])
    digits = [str(choice.getrandbits(choice.randint(1, 64))) for _ in range(6000)]
    check_numbers([f"{d}e{choice.randint(-345, 310)}" for d in digits])


def test_points_halfway_between_two_numbers():
    """Exactly halfway, and one in the last of up to 780 digits beside it."""
    getcontext().prec = 1200
    choice = random.Random(3)
    words = []
    for _ in range(300):
        bits = choice.getrandbits(choice.choice([20, 52, 63])) % (2047 << 52)
        (low, high) = struct.unpack("<dd", struct.pack("<QQ", bits, bits + 1))
        if high - high != 0:
            continue
        half = (Decimal(low) + Decimal(high)) / 2
        beside = half.scaleb(-770) / 10
        words += [f"{value:e}" for value in (half, half + beside, half - beside)]
    check_numbers(words)


@pytest.mark.parametrize(
    "word",
    [
        *("0", "-0", "0.", ".0", "1.", "+.5", "1e5", "1E+5", "1e-5", "00012", "1e0000000000000003"),
        *("1e308", "1.8e308", "1.7976931348623158e308", "1.7976931348623159e308", "1e309"),
        *("1e99999", "-1e-99999999999999999999"),
        *("5e-324", "2e-324", "2.5e-324", "2.2250738585072011e-308", "1e-400"),
        *("0." + "0" * 400 + "1", "1" + "0" * 400, "0." + "0" * 400 + "1e401", "9" * 900),
        *("0e99999999999999999999", "123456789012345678901234567890", "9007199254740993"),
        *("inf", "-Infinity", "nan"),
    ],
    ids=lambda word: word[:24],
)  # fmt: skip
def test_number(word):
    expected = np.array([float(word)])
    assert np.array_equal(coordinates([word])[:1].view(np.float64), expected, equal_nan=True)
    if expected[0] == 0:
        assert np.signbit(expected) == np.signbit(coordinates([word])[:1].view(np.float64))


@pytest.mark.parametrize(
    "word",
    ["", "-", "+", ".", "-.", "e5", "1e", "1e+", "0x10", "1_0", "1d5", "--1", "1-", "in", "1.#"],
)
def test_no_number(word):
    reader = native.ObjReader(f"v 0 0 0\nv 1 2 {word}\n".encode())
    while reader.read(100):
        pass
    assert reader.end() == (native.NOT_A_NUMBER if word else native.FEW_NUMBERS)
    assert reader.error[2:] == (2, word.encode())


TEXT = b"""\xef\xbb\xbf# all there is
mtllib a b.mtl # c
v 0 0 0 1 .5 0\r\nv 1 0 0\rv 0 1 \\
0 # origin
vt .5 .25
vn 0 0 1
usemtl a#b
s 2
f 1/1/1 2//1 \\\r\n 3
f 1 2 3 1 # four
l 1 2
p 3
\\
o last \\"""


@pytest.mark.parametrize("step", [1, 7, 50])
def test_steps_make_no_difference(step):
    whole, pieces = parsed(TEXT), parsed(TEXT, step)
    assert bytes(whole["names"]) == bytes(pieces["names"]) == b"a b.mtla#blast"
    for name in ("positions", "uvs", "normals", "colors", "setters"):
        assert np.array_equal(whole[name], pieces[name])
    for name in ("faces", "lines", "points"):
        (sizes, indices, *rest), (other_sizes, other_indices, *other_rest) = (
            whole[name],
            pieces[name],
        )
        assert sizes.tolist() == other_sizes.tolist()
        assert str(indices) == str(other_indices)
        assert rest == other_rest


def test_lines_joined_and_cut():
    found = parsed(TEXT)
    assert found["positions"].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    sizes, indices, *_ = found["faces"]
    assert sizes.tolist() == [3, 4]
    assert indices[0].tolist() == [0, 1, 2, 0, 1, 2, 0]
    assert indices[1].tolist() == [0, -1, -1, -1, -1, -1, -1]
    assert found["setters"]["line"].tolist() == [2, 9, 10, 17]
    assert found["setters"]["faces"].tolist() == [0, 0, 0, 2]


def test_every_beginning_of_a_file_is_read_within_its_bytes():
    """Each cut-off file is its own allocation, for the sanitizer to see."""
    for size in range(len(TEXT)):
        reader = native.ObjReader(bytearray(TEXT[:size]))
        while reader.read(1):
            pass
        reader.end()
        assert reader.consumed <= size


@pytest.mark.parametrize("crowd", [10, 2000])
def test_welded_vertices_are_sorted_and_equal_corners_share_them(crowd):
    """Against np.unique, with a few corners a position, and with very many."""
    choice = np.random.default_rng(crowd)
    count = 5000
    corners = choice.integers([0, -1, -1], [count // crowd, 6, 9], (count, 3)).astype(np.int32)
    positions, uvs, normals = corners.T.copy()
    faces, *vertices = native.weld_corners(positions, uvs, normals, count)
    expected, numbers = np.unique(corners, axis=0, return_inverse=True)
    assert np.stack(vertices, axis=1).tolist() == expected.tolist()
    assert faces.tolist() == numbers.ravel().tolist()

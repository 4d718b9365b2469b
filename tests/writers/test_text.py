"""Numbers as text: the shortest words for floats, and the lines of faces."""

import numpy as np
import pytest

from engine3d._native import writers as native
from engine3d.errors import InvalidArgumentError
from engine3d.io.writing.rows import float_words


@pytest.mark.parametrize(
    ("number", "word"),
    [
        (0.0, b"0"),
        (-0.0, b"-0"),
        (1, b"1"),
        (0.1, b"0.1"),
        (-1.5, b"-1.5"),
        (16.25, b"16.25"),
        (0.00010000001, b"0.00010000001"),
        (0.0001, b"1e-04"),
        (1.5e-05, b"1.5e-05"),
        (999999.94, b"999999.94"),
        (1e6, b"1e+06"),
        (16777216, b"1.6777216e+07"),
        (3.4028235e38, b"3.4028235e+38"),
        (1.1754944e-38, b"1.1754944e-38"),
        (1e-45, b"1e-45"),
        (np.inf, b"inf"),
        (-np.inf, b"-inf"),
        (np.nan, b"nan"),
    ],
)
def test_words(number, word):
    assert float_words(np.array([number], np.float32)) == [word]


def fewest_digits(number):
    """By trying: the digits of the shortest decimal that reads back, nearest first."""
    return next(p for p in range(9) if np.float32(f"{number:.{p}e}") == number) + 1


def test_words_are_the_shortest_that_read_back():
    """All powers of two with their neighbours, where the gaps change, and random bits."""
    powers = np.arange(1, 255, dtype=np.uint32) << 23
    random = np.random.default_rng(5).integers(0, 255 << 23, 3000, dtype=np.uint32)
    bits = np.concatenate([powers - 1, powers, powers + 1, random, [1, 2, 9, 0x7FFFFF]])
    numbers = bits.astype(np.uint32).view(np.float32)
    words = float_words(numbers)
    assert (np.array(words).astype(np.float32).view(np.uint32) == bits).all()
    for number, word in zip(numbers.tolist(), words, strict=True):
        digits = word.split(b"e")[0].replace(b".", b"").strip(b"0")
        assert len(digits) <= fewest_digits(np.float32(number)), word


def test_rows():
    rows = np.array([(1, -2), (0.5, 3e10)], np.float32)
    text = native.float_rows(rows, [b"vt ", b" ", b"\n"])
    assert text.tobytes() == b"vt 1 -2\nvt 0.5 3e+10\n"
    assert len(native.float_rows(rows[:0], [b"vt ", b" ", b"\n"])) == 0
    with pytest.raises(InvalidArgumentError):
        native.float_rows(rows, [b"v "])


def test_lines_of_faces():
    sizes = np.array([3, 4, 0], np.int32)
    positions = np.array([1, 2, 3, 9, 10, 2147483647, 4], np.int32)
    others = positions[::-1].copy()
    lines = {
        form: native.face_lines(sizes, positions, None if form == native.V else others, form)
        for form in (native.V, native.V_VT, native.V_VN, native.V_VT_VN)
    }
    plain, ends = lines[native.V]
    assert plain.tobytes() == b"f 1 2 3\nf 9 10 2147483647 4\nf\n"
    assert ends.tolist() == [8, 28, 30]
    for form, corner in (
        (native.V_VT, "{}/{}"),
        (native.V_VN, "{}//{}"),
        (native.V_VT_VN, "{0}/{1}/{1}"),
    ):
        words = list(map(corner.format, positions.tolist(), others.tolist()))
        expected = f"f {' '.join(words[:3])}\nf {' '.join(words[3:])}\nf\n"
        assert lines[form][0].tobytes() == expected.encode()
    with pytest.raises(InvalidArgumentError):
        native.face_lines(sizes, positions, others[1:], native.V_VT)
    with pytest.raises(InvalidArgumentError):
        native.face_lines(sizes, positions[1:], None, native.V)

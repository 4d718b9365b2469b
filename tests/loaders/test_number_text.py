"""Numbers out of text: bodies of nothing but numbers, and lines that have forms."""

import random

import numpy as np
import pytest

from engine3d._native import loaders as native
from engine3d.errors import InvalidArgumentError
from engine3d.io.reading.number_arrays import NotANumberError, ended, read_numbers

ENDS = ["\n", "\r\n", "\r", "\n\n", " \t\v\f\n"]


def read(text, comments=native.NO_COMMENTS, **more):
    return read_numbers(ended(text.encode()), comments, **more)


def test_the_numbers_and_widths_are_those_of_split_and_float():
    choice = random.Random(3)
    for _ in range(200):
        lines = [
            [repr(choice.uniform(-1, 1) * 10.0 ** choice.randint(-30, 30)) for _ in range(width)]
            for width in (choice.randrange(5) for _ in range(choice.randrange(6)))
        ]
        text = "".join("\t ".join(line) + choice.choice(ENDS) for line in lines)
        found = read(text, widths=True)
        assert found.values.tolist() == [float(word) for line in lines for word in line]
        assert found.widths.tolist() == [len(line) for line in lines if line]


@pytest.mark.parametrize("end", ENDS)
def test_comments(end):
    lines = ["1 2 # 3", "#4", "", "5#6 7"]
    assert read(end.join(lines), native.HASH_COMMENTS).values.tolist() == [1, 2, 5]
    lines = ["comment 1", "  obj_info: 2", "3", "comment", "\tcomment\t4", "5"]
    assert read(end.join(lines), native.PLY_COMMENTS).values.tolist() == [3, 5]


def test_as_many_rows_as_are_asked_for():
    text = b"\n1 2\n\n3\n4 5 6\n"
    found = read_numbers(text, native.NO_COMMENTS, 2, widths=True)
    assert (found.values.tolist(), found.widths.tolist()) == ([1, 2, 3], [2, 1])
    assert text[found.end :] == b"4 5 6\n"
    assert len(read_numbers(text, native.NO_COMMENTS, 10**30).values) == 6


@pytest.mark.parametrize(
    ("text", "comments", "word"),
    [
        ("1 2\n3 x4 5", native.NO_COMMENTS, b"x4"),
        ("1 2\n3 0x10", native.NO_COMMENTS, b"0x10"),
        ("1 2\n3 # 5", native.NO_COMMENTS, b"#"),
        ("1 2\n3 1_0#", native.HASH_COMMENTS, b"1_0"),
        ("1 2\n3 commentary", native.PLY_COMMENTS, b"commentary"),
        ("1 2\n3 comment 5", native.PLY_COMMENTS, b"comment"),
        ("1 2\n3 \0", native.NO_COMMENTS, b"\0"),
        ("1 2\n3 inf()", native.NO_COMMENTS, b"inf()"),
    ],
)
def test_what_is_no_number_is_told(text, comments, word):
    with pytest.raises(NotANumberError) as caught:
        read(text, comments, widths=True)
    assert (caught.value.word, caught.value.position) == (word, 6)
    assert caught.value.widths.tolist() == [2]


def test_words_for_what_is_not_finite():
    values = read("inf -INFINITY 1.#INF nan -nan(ind) nan(snan) 1.#QNAN 1e999").values
    assert values[[0, 1, 2, 7]].tolist() == [np.inf, -np.inf, np.inf, np.inf]
    assert np.isnan(values[3:7]).all()


def test_a_text_must_be_ended():
    for text in (b"1", b"1 2x"):
        with pytest.raises(InvalidArgumentError, match="does not end"):
            native.read_numbers(text, native.NO_COMMENTS)
    assert ended(b"1\r") == b"1\r"
    assert len(read("").values) == 0


def test_lists_are_walked_and_copied():
    values = np.array([9, 2, 5, 6, 8, 9, 0, 8, 9, 1, 7, 8], np.float64)
    problem, places, starts, sizes, end, _ = native.walk_number_rows(values, 0, [1], 1, 3)
    assert (problem, end) == (native.PLY_DONE, 12)
    assert places.tolist() == [0, 5, 8]
    assert sizes.ravel().tolist() == [2, 0, 1]
    assert native.copy_numbers(values, starts, sizes, 0).tolist() == [5, 6, 7]


@pytest.mark.parametrize("length", [-1, 0.5, np.nan, np.inf, -np.inf])
def test_lengths_that_are_none(length):
    values = np.array([1, 5, length, 5], np.float64)
    problem, *_, place, row = native.walk_number_rows(values, 0, [0], 0, 2)
    assert (problem, place, row) == (native.PLY_BAD_LIST, 2, 1)


@pytest.mark.parametrize("length", [3, 1e18, 1e300])
def test_lists_longer_than_what_is_left(length):
    problem, *_ = native.walk_number_rows(np.array([length, 1, 2], float), 0, [0], 0, 1)
    assert problem == native.PLY_SHORT


@pytest.mark.parametrize("wrong", [-1, 4, 0.5, np.nan, np.inf, 1e300, -1e300, 2.0**32])
def test_indices(wrong):
    values = np.array([[0, 1, 9], [2, 3, 9], [wrong, 0, 9]], np.float64)
    indices, place = native.indices_of(values[:2, :2], 4)
    assert (indices.tolist(), indices.dtype, place) == ([[0, 1], [2, 3]], np.int32, None)
    assert native.indices_of(values[:, :2], 4)[1] == 4


FORMS = (
    (b"Point #_:_X:%|_U:%", native.ROW, 2, 3, -1.0, 0),
    (b"use @ ?", native.ROW, 2, 9, 0.0, 0),
    (b"name:", native.MARKED, 0, 0, 0.0, 1),
    (b"skip ", native.SKIPPED, 0, 0, 0.0, 0),
)


def test_forms():
    text = b"Point 0: X:1.5\r\n\n Point 1 :  X: 2 U:3 \n\tuse 1 0\nskip it\nname: a b\nskip\nname:"
    text += b"c\n"
    reader = native.FormReader(text, FORMS)
    assert reader.read(0) == len(text)
    assert reader.count(0) == (2, 1)
    marks = reader.take_marks()
    assert [text[a:b] for a, b in zip(marks["start"], marks["end"], strict=True)] == [b" a b", b"c"]
    assert marks["rows"].tolist() == [1, 1]
    assert reader.take_rows(0).tolist() == [[1.5, -1], [2, 3]]
    assert reader.take_rows(1).tolist() == [[1, 0]]
    assert len(reader.take_marks()) == len(reader.take_rows(0)) == 0


@pytest.mark.parametrize(
    "line",
    [
        b"Point 1: X:1",
        b"Point 00: X:1",
        b"Point0: X:1",
        b"Point 0: X :1",
        b"Point 0: X:one",
        b"Point 0: X:1 U:",
        b"Point 0: X:1 U:2 3",
        b"point 0: X:1",
        b"use 1 0",
        b"use 0 2",
        b"use 0 0 0",
        b"use -1 0",
        b"skips",
        b"other",
    ],
)
def test_reading_stops_at_a_line_of_no_form(line):
    before = b"skip\n" + b"Point 0: X:1\n" * line.startswith(b"use")
    text = before + line + b"\nskip\n"
    reader = native.FormReader(text, FORMS)
    assert reader.read(0) == len(before)
    assert reader.read(len(before)) == len(before)
    assert reader.read(len(before) + len(line) + 1) == len(text)


def test_no_more_rows_than_there_may_be():
    lines = [b"Point %d: X:1\n" % k for k in range(5)]
    reader = native.FormReader(b"".join(lines), FORMS)
    assert reader.read(0) == len(b"".join(lines[:3]))
    reader.add(0, [7, 8])
    assert reader.take_rows(0)[-1].tolist() == [7, 8]
    with pytest.raises(InvalidArgumentError):
        reader.add(0, [7])


def test_case_may_not_matter():
    reader = native.FormReader(
        b"VERTEX 1 2 3\nVertex 4 5 6\n", ((b"vertex % % %", 0, 3, 9, 0.0, 0),), True
    )
    reader.read(0)
    assert reader.take_rows(0).tolist() == [[1, 2, 3], [4, 5, 6]]

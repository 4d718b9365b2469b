"""Equal rows get equal numbers."""

import numpy as np
import pytest

from engine3d.loaders import welding


def expected(rows):
    seen = {}
    return [seen.setdefault(tuple(row), len(seen)) for row in (rows + 0).tolist()]


def test_numbers_follow_the_first_appearance():
    rows = np.random.default_rng(1).integers(0, 3, (500, 3)).astype(np.float32)
    numbers, first = welding.number_rows(rows)
    assert numbers.tolist() == expected(rows)
    assert (rows[first][numbers] == rows).all()
    assert (np.diff(first) > 0).all()


def test_zeros_are_equal_and_nan_equals_itself():
    rows = np.array([[0, np.nan], [-0.0, np.nan], [0, 1]], np.float32)
    assert welding.number_rows(rows)[0].tolist() == [0, 0, 1]


@pytest.mark.parametrize("columns", [1, 2, 3, 5])
def test_many_rows(columns):
    """More numbers than any table begins with, of every width."""
    rows = np.random.default_rng(2).integers(-40, 40, (20_000, columns)).astype(np.float32)
    numbers, first = welding.number_rows(rows)
    assert numbers.tolist() == expected(rows)
    assert (rows[first][numbers] == rows).all()


def test_bytes_are_no_floats():
    rows = np.array([[0, 0, 0, 128], [0, 0, 0, 0], [0, 0, 0, 128]], np.uint8)
    assert welding.number_rows(rows)[0].tolist() == [0, 1, 0]


@pytest.mark.parametrize("columns", [1, 3, 5])
def test_whether_rows_repeat(columns):
    """Rows without a repetition, and the same with a single one, far from the first or close."""
    rows = np.random.default_rng(3).permutation(50_000 * columns).reshape(-1, columns)
    rows = rows.astype(np.float32)
    assert not welding.rows_repeat(rows)
    rows[0, 0] = -0.0
    for other in (1, 777, len(rows) - 1):
        twin = rows.copy()
        twin[other] = rows[0] + 0
        assert welding.rows_repeat(twin)


def test_nothing():
    assert not welding.rows_repeat(np.zeros((0, 3), np.float32))
    numbers, first = welding.number_rows(np.zeros((0, 4), np.uint8))
    assert len(numbers) == len(first) == 0

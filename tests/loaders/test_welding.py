"""Equal rows get equal numbers."""

import numpy as np
import pytest

from engine3d._native import loaders as native
from engine3d.io.reading import welding


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


def facets_of_a_grid(rows, columns):
    """Corners (F, 3, 3) of the two halves of each quad, strip by strip: numbers go on regularly."""
    y, x = np.mgrid[: rows - 1, : columns - 1].reshape(2, -1, 1)
    corners = np.array([[0, 0], [0, 1], [1, 1], [0, 0], [1, 1], [1, 0]])
    flat = np.stack([x + corners[:, 1], y + corners[:, 0], x * 0 + corners[:, 1] * 0], axis=-1)
    return flat.reshape(-1, 3, 3).astype(np.float32) - 5


def weld(corners, facets_a_piece):
    records = np.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", 9), ("a", "<u2")])
    records["normal"], records["a"] = 7, 9
    records["corners"] = corners.reshape(-1, 9)
    data, step = records.tobytes(), 50 * facets_a_piece
    pieces = [(k // 50, data[k : k + step]) for k in range(0, len(data), step)]
    return native.weld_facets(pieces, 12, 50, len(corners))


def holes(corners):
    return corners[np.random.default_rng(4).random(len(corners)) > 0.1]


def other_zeros(corners):
    corners[np.random.default_rng(5).random(corners.shape) > 0.5] *= -1
    return np.where(np.abs(corners) == 5, np.float32(-0.0), corners)


def not_finite(corners):
    corners[np.random.default_rng(6).random(corners.shape) > 0.9] = np.nan
    return corners


def half_shuffled(corners):
    half = len(corners) // 2
    return np.concatenate([corners[:half], np.random.default_rng(7).permutation(corners[half:])])


def apart(corners):
    """Many more points than facets of a surface have: the table grows."""
    facets = np.arange(len(corners), dtype=np.float32)[:, np.newaxis, np.newaxis] % 3000
    return corners + np.random.default_rng(8).permutation(facets)


CHANGES = [np.copy, holes, other_zeros, not_finite, half_shuffled, apart]


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("facets_a_piece", [5242, 333, 3])
def test_facets_weld_as_rows(change, facets_a_piece):
    """Guessing the numbers of regular facets, and failing at it, gives what a dictionary gives."""
    corners = change(facets_of_a_grid(40, 90))
    faces, positions = weld(corners, facets_a_piece)
    bits = np.where(corners == 0, np.float32(0), corners).view(np.uint32).reshape(-1, 3)
    seen = {}
    numbers = [seen.setdefault(tuple(row), len(seen)) for row in bits.tolist()]
    assert faces.ravel().tolist() == numbers
    first = np.unique(numbers, return_index=True)[1]
    assert positions.tobytes() == corners.reshape(-1, 3)[first].tobytes()

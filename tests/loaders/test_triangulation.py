"""Polygons cut into triangles: area, winding, order, hidden edges, bounded work."""

import time

import numpy as np
import pytest
from loaders import triangulation_reference as reference
from loaders.ear_clipping_reference import WorkBudget as ReferenceBudget

from engine3d.errors import InvalidArgumentError
from engine3d.io.reading.triangulation import WorkBudget, triangulate
from engine3d.model.geometry.normals import face_area_vectors

STAR = [(np.cos(k * np.pi / 5) * r, np.sin(k * np.pi / 5) * r) for k, r in enumerate([1, 0.4] * 5)]
LETTER_U = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)]
# A square with a square hole, joined by a bridge whose two ends occur twice.
HOLED = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]
COMB = [(k, 0 if k % 2 else 5) for k in range(301)] + [(300, -1), (0, -1)]
SHAPES = {"star": STAR, "u": LETTER_U, "holed": HOLED, "comb": COMB}


def clip_ears(points, budget=None):
    """Triangles of one polygon in the plane."""
    flat = np.insert(np.array(points, float), 2, 0.0, axis=1)
    return triangulate(np.array([len(flat)]), flat, budget).corners.tolist()


def area(points):
    x, y = np.array(points, float).T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def signed_areas(points, triangles):
    x, y = np.array(points, float).T
    a, b, c = np.array(triangles).T
    return ((x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])) / 2


@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize("name", SHAPES)
def test_ears_cover_the_polygon_once(name, reverse):
    points = [(float(x), float(y)) for x, y in SHAPES[name]]
    points = points[::-1] if reverse else points
    triangles = clip_ears(points)
    areas = signed_areas(points, triangles)
    assert len(triangles) == len(points) - 2
    assert areas.sum() == pytest.approx(area(points))
    assert (areas * np.sign(area(points)) >= -1e-12).all()


@pytest.mark.parametrize("start", range(8))
def test_the_first_corner_does_not_matter(start):
    points = LETTER_U[start:] + LETTER_U[:start]
    areas = signed_areas(points, clip_ears(points))
    assert areas.sum() == pytest.approx(7)
    assert (areas >= 0).all()


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_polygons_may_lie_in_any_plane(axis):
    outline = np.insert(np.array(LETTER_U, float), axis, 7.0, axis=1)
    cut = triangulate(np.array([8]), outline)
    vectors = face_area_vectors(outline, cut.corners)
    assert np.abs(vectors.sum(axis=0)).tolist() == [14.0 * (k == axis) for k in range(3)]
    assert np.sqrt((vectors**2).sum(axis=1)).sum() == pytest.approx(14)


def test_order_and_hidden_edges_of_mixed_polygons():
    sizes = np.array([3, 5, 2, 4, 8])
    pentagon = [(np.cos(k * 1.2566), np.sin(k * 1.2566)) for k in range(5)]
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = [*square[:3], *pentagon, *square[:2], *square, *LETTER_U]
    cut = triangulate(sizes, np.insert(np.array(corners, float), 2, 0.0, axis=1))
    assert cut.polygons.tolist() == [0] + [1] * 3 + [3] * 2 + [4] * 6
    assert cut.corners[:4].tolist() == [[0, 1, 2], [3, 4, 5], [3, 5, 6], [3, 6, 7]]
    assert cut.edge_visible[:4].tolist() == [
        [True, True, True],
        [True, True, False],
        [False, True, False],
        [False, True, True],
    ]
    shown = np.bincount(cut.polygons, weights=cut.edge_visible.sum(axis=1))
    assert shown.tolist() == [3, 5, 0, 4, 8]


def test_flat_and_not_finite_polygons_still_give_their_triangles():
    corners = np.array([[0, 0, 0]] * 6 + [[np.nan, 0, 0]] * 5 + [[k, 0, 0] for k in range(7)])
    cut = triangulate(np.array([6, 5, 7]), corners.astype(float))
    assert len(cut.corners) == 4 + 3 + 5


@pytest.mark.parametrize("seed", range(2))
def test_self_intersecting_polygons_end_in_time(seed):
    points = np.random.default_rng(seed).random((3000, 2))
    started = time.process_time()
    triangles = clip_ears(points)
    assert len(triangles) == 2998
    assert time.process_time() - started < 5


def test_many_concave_polygons_share_one_budget():
    outline = np.insert(np.array(STAR), 2, 0.0, axis=1)
    sizes, corners = np.full(100, 10), np.tile(outline, (100, 1))
    assert triangulate(sizes, corners).is_complete
    cut = triangulate(sizes, corners, WorkBudget(1000))
    assert len(cut.corners) == 800
    assert not cut.is_complete


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("seed", range(8))
def test_polygons_are_cut_as_by_the_reference(dtype, seed):
    """Of all sizes; convex, star-shaped and tangled ones; on grids, in planes and far from flat."""
    rng = np.random.default_rng(seed)
    sizes = rng.integers(0, 24, 150)
    sizes[-1] = 130
    count = int(sizes.sum())
    angle = np.concatenate([np.arange(n) * 2 * np.pi / max(n, 1) for n in sizes])
    radius = rng.choice([1, 1, 1, 0.3], count)
    rings = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.1 * rng.random(count)], 1)
    tangled = rng.integers(-3, 4, (count, 3))
    kind = np.repeat(rng.integers(0, 3, len(sizes)), sizes)[:, np.newaxis]
    corners = np.where(kind == 0, tangled, np.where(kind == 1, rings @ rng.random((3, 3)), rings))
    corners[rng.integers(0, count, 3)] = [[np.nan, 0, 0], [np.inf, 1, 0], [1e300, 1e-300, 0]]
    with np.errstate(over="ignore"):
        corners = corners.astype(dtype)
    expected = reference.triangulate(sizes, corners.astype(np.float64), ReferenceBudget(10**9))
    order = rng.permutation(count)
    indices = np.argsort(order).astype(np.int32)
    for cut in (triangulate(sizes, corners), triangulate(sizes, corners[order], indices=indices)):
        for made, reference_made in zip(cut, expected, strict=True):
            assert np.array_equal(made, reference_made)
            assert np.asarray(made).dtype == np.asarray(reference_made).dtype


def test_indices_are_checked():
    sizes, positions = np.array([4]), np.zeros((4, 3))
    for indices in ([0, 1, 2, 4], [0, -1, 2, 3], [0, 1, 2]):
        with pytest.raises(InvalidArgumentError):
            triangulate(sizes, positions, indices=np.array(indices, np.int32))
    with pytest.raises(InvalidArgumentError):
        triangulate(np.array([5]), positions)
    with pytest.raises(InvalidArgumentError):
        triangulate(np.array([6, -2]), positions)


def test_nothing_gives_nothing():
    cut = triangulate(np.zeros(0, int), np.zeros((0, 3)))
    assert cut.corners.shape == (0, 3)

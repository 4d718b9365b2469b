"""Distances and deviations against brute force over dense samples, and against formulas."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.measuring import distance, hausdorff


def placed(mesh, **pose):
    return e3d.Scene().add(mesh, **pose)


def soup(random, count, spread=1.0):
    corners = random.normal(size=(count, 1, 3)) * spread + random.normal(size=(count, 3, 3)) * 0.4
    return e3d.Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def samples(mesh, steps=24):
    """Points on all faces, on a grid of barycentric coordinates."""
    weights = [(i, j, steps - i - j) for i in range(steps + 1) for j in range(steps + 1 - i)]
    corners = mesh.positions[mesh.faces].astype(float)
    return np.einsum("wk,fkx->fwx", np.array(weights) / steps, corners).reshape(-1, 3)


def to_points(points, others):
    return np.concatenate(
        [
            np.sqrt(((part[:, None] - others) ** 2).sum(axis=-1).min(axis=1))
            for part in np.array_split(points, max(len(points) // 500, 1))
        ]
    )


@pytest.mark.parametrize("seed", range(6))
def test_distances_are_those_of_dense_samples(seed):
    random = np.random.default_rng(seed)
    a, b = soup(random, 5), soup(random, 3)
    b = e3d.Mesh(b.positions + (4, 0.5, 1), b.faces)
    found = distance(a, b)
    sampled = to_points(samples(a), samples(b)).min()
    assert found.distance <= sampled + 1e-6
    assert found.distance >= sampled - 0.1
    assert np.linalg.norm(found.point_a - found.point_b) == pytest.approx(found.distance)
    for point, mesh in ((found.point_a, a), (found.point_b, b)):
        assert to_points(point[None], samples(mesh, 60))[0] < 0.05
    back = distance(b, a)
    assert back.distance == pytest.approx(found.distance, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_many_faces_have_the_distance_of_each_pair(seed):
    random = np.random.default_rng(seed)
    a, b = soup(random, 40), soup(random, 60)
    b = e3d.Mesh(b.positions + (3.5, 0, 0), b.faces)
    each = [
        distance(e3d.Mesh(a.positions[f], [(0, 1, 2)]), e3d.Mesh(b.positions[g], [(0, 1, 2)]))
        for f in a.faces[::8]
        for g in b.faces[::8]
    ]
    part_a, part_b = (e3d.Mesh(m.positions, m.faces[::8]) for m in (a, b))
    assert distance(part_a, part_b).distance == min(gap.distance for gap in each)


@pytest.mark.parametrize(
    ("shift", "expected"), [((3, 0, 0), 2), ((3, 4, 0), math.hypot(2, 3)), ((1, 0, 0), 0)]
)
def test_boxes_are_as_far_apart_as_they_are(shift, expected):
    found = distance(e3d.box(), placed(e3d.box(), translation=shift))
    assert found.distance == pytest.approx(expected)
    assert found.touching == (expected == 0) and not found.inside


def test_things_that_cross_touch():
    rod = placed(e3d.box((0.1, 5, 0.1)), translation=(0.2, 0.3, 0.1))
    found = distance(e3d.box(), rod)
    assert found.distance == 0 and found.touching
    assert abs(found.point_a).max() == pytest.approx(0.5)


def test_what_is_within_another_is_told():
    found = distance(e3d.icosphere(2.0, 4), placed(e3d.box(), translation=(0.3, 0, 0)))
    assert found.inside and not found.touching and found.distance > 0.5
    opened = e3d.icosphere(2.0, 4)
    opened = e3d.Mesh(opened.positions, opened.faces[1:])
    assert not distance(opened, e3d.box()).inside


def test_equal_surfaces_do_not_deviate():
    fine = e3d.uv_sphere(1.0, (48, 24))
    found = hausdorff(fine, fine)
    assert found.distance < 1e-7 and found.at_most < 4e-3


def test_a_bump_is_found_from_the_side_that_has_it():
    flat = e3d.plane((2, 2))
    low, high = flat.bounds
    bump = e3d.Mesh.concatenate([flat, e3d.box((0.1, 0.5, 0.1))])
    found = hausdorff(flat, bump)
    assert found.from_a == pytest.approx(0, abs=1e-6)
    assert found.distance == found.from_b
    assert found.distance == pytest.approx(0.25 if high[1] == low[1] else found.distance, abs=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_deviations_are_those_of_dense_samples(seed):
    random = np.random.default_rng(seed)
    a, b = soup(random, 6), soup(random, 6)
    found = hausdorff(a, b, tolerance=1e-3)
    one, other = to_points(samples(a), samples(b)), to_points(samples(b), samples(a))
    sampled = max(one.max(), other.max())
    assert found.distance <= found.at_most
    assert found.at_most >= sampled - 0.06  # the samples of the other side are apart
    assert found.distance <= sampled + 0.06
    assert np.linalg.norm(found.point - found.nearest) == pytest.approx(found.distance)
    corners = np.concatenate([a.positions, b.positions])
    assert found.at_most - found.distance <= 1.1e-3 * np.linalg.norm(np.ptp(corners, axis=0))


def test_the_largest_deviation_may_be_within_a_face():
    """Above the middle of a triangle: its corners touch the other surface."""
    roof = e3d.Mesh([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)])
    points = e3d.Mesh(
        [
            (0, 0, 0),
            (0.1, 0, 0),
            (0, 0.1, 0),
            (4, 0, 0),
            (3.9, 0, 0),
            (4, 0, 0.1),
            (0, 4, 0),
            (0, 3.9, 0),
            (0, 4, 0.1),
        ],
        np.arange(9).reshape(3, 3),
    )
    found = hausdorff(roof, points)
    assert found.from_a == pytest.approx(math.hypot(2, 2), rel=0.04)


def test_things_without_faces_are_refused():
    cloud = e3d.Mesh([(0, 0, 0)], points=[0])
    for measure in (distance, hausdorff):
        with pytest.raises(e3d.InvalidArgumentError, match="b has no faces"):
            measure(e3d.box(), cloud)
    with pytest.raises(e3d.InvalidArgumentError, match="tolerance"):
        hausdorff(e3d.box(), e3d.box(), tolerance=0)

"""Areas, volumes, centres and inertia against formulas, and against sums over random tetrahedra."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.measuring import measure


def tetrahedron(corners):
    return e3d.Mesh(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])


def test_a_box_has_the_measures_of_a_box():
    found = measure(e3d.box((2, 3, 5)))
    assert found.watertight and found.components == 1
    assert found.volume == pytest.approx(30) and found.area == pytest.approx(62)
    expected = np.diag([9 + 25, 4 + 25, 4 + 9]) * 30 / 12
    np.testing.assert_allclose(found.inertia, expected)
    np.testing.assert_array_equal(found.bounds, [(-1, -1.5, -2.5), (1, 1.5, 2.5)])
    np.testing.assert_allclose(found.center, 0, atol=1e-15)


def test_a_ball_comes_near_to_the_formulas():
    found = measure(e3d.icosphere(2.0, 5))
    volume = 4 / 3 * math.pi * 8
    assert found.volume == pytest.approx(volume, rel=2e-3)
    assert found.area == pytest.approx(16 * math.pi, rel=2e-3)
    np.testing.assert_allclose(found.inertia, np.eye(3) * 0.4 * volume * 4, rtol=4e-3, atol=1e-5)


@pytest.mark.parametrize("seed", range(8))
def test_random_tetrahedra_have_the_moments_of_their_points(seed):
    random = np.random.default_rng(seed)
    corners = random.normal(size=(4, 3)).astype(np.float32)
    found = measure(tetrahedron(corners))
    edges = corners[1:].astype(float) - corners[0]
    volume = np.linalg.det(edges) / 6
    assert found.volume == pytest.approx(volume)
    np.testing.assert_allclose(found.center, corners.astype(float).mean(axis=0), rtol=1e-9)
    # Quadrature of degree 2: points at a and b on the lines from the centre to the corners.
    a, b = 0.5854101966249685, 0.1381966011250105
    points = np.array([np.roll([a, b, b, b], k) for k in range(4)]) @ corners - found.center
    second = points.T @ points / 4 * abs(volume)
    np.testing.assert_allclose(found.inertia, np.eye(3) * np.trace(second) - second, atol=1e-9)


def test_open_surfaces_enclose_nothing():
    found = measure(e3d.plane())
    assert not found.watertight and found.volume is None and found.inertia is None
    np.testing.assert_allclose(found.center, 0, atol=1e-12)


def test_faces_that_look_inward_have_a_negative_volume():
    box = e3d.box()
    inward = e3d.Mesh(box.positions, box.faces[:, ::-1])
    assert measure(inward).volume == pytest.approx(-1)
    np.testing.assert_allclose(measure(inward).inertia, measure(box).inertia)


def test_nodes_are_measured_where_they_are():
    scene = e3d.Scene()
    node = scene.add(e3d.box(), translation=(5, 0, 0), scale=(2, 2, 2))
    hidden = scene.add(e3d.box(), translation=(0, 9, 0))
    hidden.visible = False
    assert measure(node).volume == pytest.approx(8)
    assert measure(scene).volume == pytest.approx(8)
    np.testing.assert_allclose(measure(scene).center, (5, 0, 0))
    grid = e3d.InstancedMesh(e3d.box(), np.array([(0, 0, 0, 1), (4, 0, 0, 2)]))
    assert measure([node, grid]).volume == pytest.approx(8 + 1 + 8)
    assert measure(grid).components == 2


def test_other_things_are_refused():
    with pytest.raises(e3d.InvalidArgumentError, match="the thing must be a mesh"):
        measure("box")
    assert measure(e3d.Mesh([(0, 0, 0)], points=[0])).area == 0

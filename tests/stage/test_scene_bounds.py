"""How far a scene reaches: the bounding sphere and the outline that a first view shows."""

import math

import numpy as np
import pytest
from stage.projection import project

import engine3d as e3d
from engine3d.stage.scene_bounds import bounding_sphere, turning_outline
from engine3d.stage.views.viewpoint import UP_DIRECTIONS, Sphere, Viewpoint


@pytest.mark.parametrize("up", UP_DIRECTIONS.values())
def test_a_framed_outline_holds_the_scene_however_it_turns(up):
    scene = e3d.Scene()
    scene.add(e3d.box((3.0, 1.0, 0.4)), translation=(1.0, 2.0, 3.0))
    scene.add(e3d.icosphere(0.6, 2), translation=(1.0, 3.0, 3.5))
    points = np.concatenate(
        [node.object.positions + node.translation for node in scene.nodes], dtype=np.float64
    )
    view = Viewpoint(np.zeros(3), 1.0, up=up)
    view.frame(turning_outline(scene, up), 1.5)
    reached = []
    for azimuth in np.linspace(0.0, 6.0, 13):
        view.azimuth = azimuth
        reached.append(np.abs(project(view, points, 300, 200)[:, :2]).max())
    assert max(reached) < 1.0
    assert max(reached) > 0.75


def test_the_outline_of_an_empty_scene_can_be_framed():
    view = Viewpoint(np.zeros(3), 1.0)
    view.frame(turning_outline(e3d.Scene(), (0, 1, 0)), 1.0)
    assert 1.0 < view.distance < 10.0


def test_bounding_sphere_reaches_the_farthest_vertex():
    scene = e3d.Scene()
    scene.add(e3d.icosphere(2.0, 3), translation=(5, 0, 0), scale=0.5)
    sphere = bounding_sphere(scene)
    np.testing.assert_allclose(sphere.center, (5, 0, 0), atol=1e-6)
    assert sphere.radius == pytest.approx(1.0, abs=1e-6)


def test_bounding_sphere_of_instances_holds_their_boxes():
    scene = e3d.Scene()
    poses = np.stack([np.eye(4), np.eye(4)])
    poses[1, 0, 3] = 4.0
    scene.add(e3d.InstancedMesh(e3d.box(), poses))
    sphere = bounding_sphere(scene)
    np.testing.assert_allclose(sphere.center, (2, 0, 0), atol=1e-6)
    assert sphere.radius == pytest.approx(math.sqrt(2.5**2 + 0.5), abs=1e-6)


def test_bounding_sphere_leaves_out_hidden_nodes_and_wild_vertices():
    scene = e3d.Scene()
    scene.add(e3d.box(), translation=(100, 0, 0)).visible = False
    positions = np.array([[-1, 0, 0], [1, 0, 0], [0, np.nan, 0]], dtype=np.float32)
    scene.add(e3d.Mesh(positions, [[0, 1, 2]]))
    assert bounding_sphere(scene).radius == 1.0


def test_an_empty_scene_has_a_sphere_of_radius_one():
    assert bounding_sphere(e3d.Scene()) == Sphere((0.0, 0.0, 0.0), 1.0)


def test_bounding_sphere_survives_an_extent_without_size():
    scene = e3d.Scene()
    scene.add(e3d.Mesh([[1, 2, 3]], points=[0]))
    assert bounding_sphere(scene) == Sphere((1.0, 2.0, 3.0), 1.0)

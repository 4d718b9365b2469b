"""Lights, cameras, empties and colliders are drawn as what they are, where they stand."""

import math

import numpy as np
import pytest
from editor.ui.test_properties_of_all_kinds import HELD

import engine3d as e3d
from engine3d import colliders
from engine3d.apps.editor.node_shapes import camera_frustum, collider_lines, icon, outline
from engine3d.io.scenes.object_kinds import KINDS

PLACE = np.array([1.0, 2.0, 3.0])


@pytest.mark.parametrize("kind", [*KINDS, "empty"])
def test_every_kind_has_an_icon_of_its_size(kind):
    held = None if kind == "empty" else HELD.get(kind, KINDS.get(kind))()
    node = e3d.Scene().add(held, translation=PLACE, scale=5.0)
    lines = icon(node, 0.5)
    assert len(lines) >= 1 and lines.shape[1:] == (2, 3)
    extent = np.abs(lines.reshape(-1, 3) - PLACE).max()
    assert 0.1 < extent <= 0.75, "whatever the node's scale"


def test_a_cone_has_its_angle_and_shines_down_its_axis():
    light = e3d.SpotLight(range=4.0, inner_cone_angle=0.2, outer_cone_angle=math.pi / 6)
    node = e3d.Scene().add(light)
    node.look_at((0, -1, 0), up=(0, 0, 1))
    points = outline(node, 100.0).reshape(-1, 3)
    far = points[np.linalg.norm(points, axis=1) > 1e-9]
    assert np.allclose(np.linalg.norm(far, axis=1), 4.0)
    angles = np.arccos(-far[:, 1] / 4.0)
    assert set(angles.round(6).tolist()) == {0.2, round(math.pi / 6, 6)}
    light.range = math.inf
    assert np.abs(outline(node, 2.0)).max() <= 2.0 + 1e-9


def test_surfaces_of_light_have_their_sizes():
    node = e3d.Scene().add(
        e3d.lights.RectangleLight(width=4.0, height=2.0), translation=PLACE, scale=3.0
    )
    corners = outline(node, 0.0)[:4, 0] - PLACE
    assert np.ptp(corners, axis=0).tolist() == [4.0, 2.0, 0.0]
    node = e3d.Scene().add(e3d.PointLight(range=2.5), translation=PLACE)
    distances = np.linalg.norm(outline(node, 9.0).reshape(-1, 3) - PLACE, axis=1)
    assert np.allclose(distances, 2.5)
    node.object = e3d.PointLight()
    assert len(outline(node, 9.0)) == 0


def test_a_sun_points_where_it_shines():
    node = e3d.Scene().add(e3d.DirectionalLight((1, 0, 0)), translation=PLACE)
    node.euler = (0.0, 0.0, -math.pi / 2)
    start, tip = outline(node, 3.0)[0]
    assert np.allclose(start, PLACE) and np.allclose(tip - start, (0, -3, 0))


def test_colliders_are_drawn_where_queries_find_them():
    node = e3d.Scene().add(e3d.box(), translation=PLACE, scale=2.0)
    assert len(collider_lines(node)) == 0
    node.collider = colliders.BoxCollider()
    points = collider_lines(node).reshape(-1, 3)
    assert np.allclose([points.min(0), points.max(0)], [PLACE - 1, PLACE + 1])
    node.collider = colliders.SphereCollider(0.75, (0.5, 0, 0))
    distances = np.linalg.norm(collider_lines(node).reshape(-1, 3) - PLACE - (1, 0, 0), axis=1)
    assert np.allclose(distances, 1.5)
    node.collider = colliders.MeshCollider()
    assert len(collider_lines(node)) == 36


def test_a_frustum_ends_at_its_far_plane_or_before():
    node = e3d.Scene().add(e3d.PerspectiveCamera(1.0, znear=1.0, zfar=3.0))
    assert camera_frustum(node, (160, 90), 100.0)[..., 2].min() == pytest.approx(-3.0)
    node.object = e3d.PerspectiveCamera(1.0, znear=1.0, zfar=math.inf)
    assert np.abs(camera_frustum(node, (160, 90), 10.0)).max() <= 10.0 + 1e-9

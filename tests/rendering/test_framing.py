"""Cameras that show a whole box or scene: nothing is cut, little is left empty."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg
from engine3d.model.scene.instances import instance_matrices
from engine3d.rendering import support_functions as support

ASPECTS = (0.25, 1.0, 3.0)
DIRECTIONS = [(0, 0, -1), (1, -2, 0.5), (0, -1, 0)]


def ndc(camera, pose, points, aspect=1.0):
    """Points (N, 3) as a camera sees them in an image 400 pixels high."""
    clip_from_world = camera.projection((round(400 * aspect), 400)) @ np.linalg.inv(pose)
    clip = np.c_[points, np.ones(len(points))] @ clip_from_world.T
    assert (clip[:, 3] > 0).all()
    return clip[:, :3] / clip[:, 3:]


def vertices(scene):
    """Every vertex of a scene's visible meshes and instances, in world space."""
    found = []
    for node in scene.nodes:
        thing = node.object
        mesh = getattr(thing, "mesh", thing)
        poses = (
            instance_matrices(thing.poses) if isinstance(thing, e3d.InstancedMesh) else [np.eye(4)]
        )
        if node.shown and len(mesh.positions):
            points = np.c_[mesh.positions, np.ones(len(mesh.positions))]
            found += [(points @ (node.world_pose @ pose).T)[:, :3] for pose in poses]
    points = np.concatenate(found)
    return points[np.isfinite(points).all(axis=1)]


def crowd(seed=1):
    """Round things of many sizes, turned and stretched, some of them instances, one hidden."""
    rng = np.random.default_rng(seed)
    scene = e3d.Scene()
    meshes = [e3d.icosphere(0.5, 1), e3d.torus(0.6, 0.2, (12, 8)), e3d.box()]
    for number in range(30):
        parts = {"rotation": rng.normal(size=4), "scale": rng.uniform(0.1, 1.2, 3)}
        scene.add(meshes[number % 3], translation=rng.normal(size=3) * (3, 1, 2), **parts)
    poses = np.array([linalg.compose(*parts) for parts in zip(*instance_parts(rng), strict=True)])
    scene.add(e3d.InstancedMesh(meshes[0], poses), translation=(1, 0, 0), scale=(1, 2, 1))
    scene.add(e3d.InstancedMesh(meshes[1], rng.uniform(0.1, 1, (9, 4))))
    scene.add(meshes[2], translation=(99, 0, 0)).visible = False
    return scene


def instance_parts(rng, count=12):
    return rng.normal(size=(count, 3)), rng.normal(size=(count, 4)), rng.uniform(0.2, 1, count)


@pytest.mark.parametrize("aspect", ASPECTS)
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_frame_bounds_fits_the_box_tightly(aspect, direction):
    bounds = np.array([[-1.0, 2.0, 3.0], [4.0, 2.5, 9.0]])
    camera, pose = e3d.frame_bounds(bounds, aspect=aspect, direction=direction, margin=1.0)
    corners = np.array(
        [[x, y, z] for x in bounds[:, 0] for y in bounds[:, 1] for z in bounds[:, 2]]
    )
    seen = ndc(camera, pose, corners, aspect)
    assert np.abs(seen).max() <= 1 + 1e-9
    assert np.abs(seen[:, :2]).max() == pytest.approx(1)
    forward = -pose[:3, 2]
    np.testing.assert_allclose(forward, np.array(direction) / np.linalg.norm(direction), atol=1e-12)


def test_frame_bounds_of_nothing_has_a_view():
    camera, pose = e3d.frame_bounds(np.zeros((2, 3)))
    assert 0 < camera.znear < camera.zfar
    assert np.isfinite(pose).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"bounds": [[0, 0, 0]]}, "bounds"),
        ({"bounds": [[1, 0, 0], [0, 1, 1]]}, "first corner"),
        ({"aspect": 0}, "aspect"),
        ({"direction": (0, 0, 0)}, "direction"),
        ({"margin": -1}, "margin"),
        ({"yfov": 4}, "yfov"),
    ],
)
def test_frame_bounds_arguments(options, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.frame_bounds(**{"bounds": [[0, 0, 0], [1, 1, 1]], **options})


@pytest.mark.parametrize("aspect", ASPECTS)
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_frame_scene_touches_the_vertices(aspect, direction):
    scene = crowd()
    camera, pose = e3d.frame_scene(scene, aspect=aspect, direction=direction, margin=1.0)
    seen = ndc(camera, pose, vertices(scene), aspect)
    low, high = seen.min(axis=0), seen.max(axis=0)
    assert (low[:2] >= -1 - 1e-9).all() and (high[:2] <= 1 + 1e-9).all()
    touches = np.isclose(low[:2], -1) & np.isclose(high[:2], 1)
    assert touches.any()
    np.testing.assert_allclose(low[:2], -high[:2], atol=0.02)
    assert -1 < low[2] < -0.95 and 0.95 < high[2] < 1


def test_frame_scene_leaves_the_margin_on_both_sides():
    scene = e3d.Scene()
    scene.add(e3d.icosphere(1.0, 3), translation=(3, -2, 1))
    camera, pose = e3d.frame_scene(scene, aspect=2.0, margin=1.25)
    seen = ndc(camera, pose, vertices(scene), 2.0)
    np.testing.assert_allclose([seen[:, 1].min(), seen[:, 1].max()], [-0.8, 0.8])
    np.testing.assert_allclose(seen[:, 0].min(), -seen[:, 0].max(), atol=1e-3)


def test_a_scene_without_a_camera_is_framed_by_frame_scene():
    scene = crowd(2)
    framed = render(scene, e3d.frame_scene(scene, aspect=1.5), size=(60, 40))
    np.testing.assert_array_equal(render(scene, size=(60, 40)).color, framed.color)


def test_automatic_framing_follows_what_moves():
    scene = e3d.Scene()
    node = scene.add(e3d.icosphere(0.5, 2))
    with Renderer((40, 30)) as renderer:
        before = renderer.render(scene).color.copy()
        node.scale = 4
        renderer.render(scene, e3d.frame_scene(scene))
        for change in (lambda: None, lambda: setattr(node, "translation", (5, 6, 7))):
            change()
            framed = render(scene, e3d.frame_scene(scene, aspect=4 / 3), size=(40, 30)).color
            for _ in range(3):
                np.testing.assert_array_equal(renderer.render(scene).color, framed)
        node.object.positions = node.object.positions * np.float32(0.25)
        node.translation = (0, 0, 0)
        np.testing.assert_allclose(renderer.render(scene).color, before, atol=1)
        renderer.resize((30, 40))
        framed = render(scene, e3d.frame_scene(scene, aspect=0.75), size=(30, 40)).color
        np.testing.assert_array_equal(renderer.render(scene).color, framed)


@pytest.mark.parametrize("limit", ["_MAX_VERTICES", "_MAX_INSTANCES"])
def test_what_is_too_much_to_look_at_is_shown_all_the_same(monkeypatch, limit):
    monkeypatch.setattr(support, limit, 5)
    scene = crowd()
    camera, pose = e3d.frame_scene(scene, margin=1.0)
    seen = ndc(camera, pose, vertices(scene))
    assert np.abs(seen).max() <= 1 + 1e-9
    assert np.abs(seen[:, :2]).max() > 0.7


def test_vertices_that_are_not_finite_do_not_count():
    positions = np.array([[-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, np.nan, 0], [np.inf, 9, 9]])
    scene = e3d.Scene()
    node = scene.add(e3d.Mesh(positions, [[0, 1, 2], [0, 1, 3], [0, 1, 4]]))
    expected = e3d.frame_bounds([[-1, 0, 0], [1, 1, 0]], direction=(0, 0, -1))
    camera, pose = e3d.frame_scene(scene, direction=(0, 0, -1))
    np.testing.assert_allclose(pose, expected[1], atol=1e-12)
    node.object.positions = np.full((5, 3), np.nan, np.float32)
    scene.add(node.object, translation=(1, 2, 3))
    camera, pose = e3d.frame_scene(scene)
    assert np.isfinite(pose).all() and camera.znear < camera.zfar


@pytest.mark.parametrize(
    "points",
    [
        [[1, 2, 3]],
        [[0, 0, -5], [0, 0, 5]],
        [[-5, 0, 0], [5, 0, 0]],
        [[0, -1, 0], [0, 1, 0], [1e-9, 0, 0]],
        [[1e7, 1e7, 1e7], [1e7 + 1, 1e7, 1e7], [1e7, 1e7 + 1, 1e7]],
        [[1e20, 1e20, 1e20], [2e20, 1e20, 1e20], [1e20, 2e20, 1e20]],
    ],
)
def test_flat_and_faraway_things_have_a_view(points):
    scene = e3d.Scene()
    scene.add(e3d.Mesh(points, points=list(range(len(points)))))
    for direction in [(0, 0, -1), (-1, 0, 0), (0, -1, 0), (-1, -1, -1)]:
        camera, pose = e3d.frame_scene(scene, direction=direction)
        assert np.abs(ndc(camera, pose, vertices(scene))).max() <= 1


def test_what_no_camera_shows_is_a_clear_error():
    scene = e3d.Scene()
    scene.add(e3d.Mesh([(1e17, 1e17, 1e17)], points=[0]))  # so far away that it has no size
    with pytest.raises(e3d.InvalidArgumentError, match="too large for a camera"):
        e3d.frame_scene(scene)


def test_frame_scene_of_nothing_has_a_view():
    camera, pose = e3d.frame_scene(e3d.Scene())
    expected = e3d.frame_bounds(np.zeros((2, 3)))
    np.testing.assert_array_equal(pose, expected[1])
    with pytest.raises(e3d.InvalidArgumentError, match="scene must be a path, a scene"):
        e3d.frame_scene(5)


def test_reach_of_points_goes_block_by_block(monkeypatch):
    points = np.random.default_rng(3).normal(size=(1000, 3)).astype(np.float32)
    points[17], points[500:520] = np.nan, np.inf
    directions = np.random.default_rng(4).normal(size=(7, 3))
    finite = points[np.isfinite(points).all(axis=1)].astype(np.float64)
    monkeypatch.setattr(support, "_BLOCK", 10)
    found = support.support_of_points(points)(directions)
    np.testing.assert_allclose(found, (directions @ finite.T).max(axis=1))

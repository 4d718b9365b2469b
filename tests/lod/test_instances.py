"""Levels of detail: chosen by the error on the screen, without flicker."""

import math

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d
from engine3d.errors import InvalidArgumentError

SIZE = (320, 240)
CAMERA = e3d.PerspectiveCamera(yfov=1.0, znear=0.1, zfar=1000.0)
FOCAL = 120 / math.tan(0.5)  # pixels of a unit at distance 1


def levels():
    spheres = [e3d.icosphere(1.0, k) for k in (3, 2, 1)]
    return list(zip(spheres, (0.0, 0.01, 0.05), strict=True))


def at(z):
    return e3d.look_at((0, 0, z), (0, 0, 0))


def expected_level(distance, pixels, scale=1.0):
    error = np.array([0.0, 0.01, 0.05]) * scale * FOCAL / (distance - scale)
    return int((error <= pixels).sum()) - 1


def test_the_coarsest_that_shows_no_error_is_drawn():
    poses = np.array([(0.0, 0.0, -5.0 * k, 1.0) for k in range(40)])
    spheres = e3d.detail.DetailedInstances(levels(), poses, hysteresis=0.0, pixels=0.15)
    assert spheres.update(CAMERA, at(10.0), SIZE)
    assert spheres.level.tolist() == [expected_level(10 + 5 * k, 0.15) for k in range(40)]
    assert set(spheres.level) == {0, 1, 2}
    for number, instances in enumerate(spheres.instances):
        np.testing.assert_array_equal(
            instances.poses, poses[spheres.level == number].astype(np.float32)
        )
    assert not spheres.update(CAMERA, at(10.0), SIZE)


def test_scale_and_parents_count():
    matrices = np.stack([e3d.linalg.scaling(s) for s in (1.0, 8.0)])
    big = e3d.detail.DetailedInstances(levels(), matrices, hysteresis=0.0)
    big.update(CAMERA, at(60.0), SIZE)
    assert big.level.tolist() == [expected_level(60, 1.0), expected_level(60, 1.0, 8.0)]
    scene = e3d.Scene()
    small = e3d.detail.DetailedInstances(levels(), matrices[:1], hysteresis=0.0)
    small.add_to(scene, parent=scene.add(scale=8.0))
    small.update(CAMERA, at(60.0), SIZE)
    assert small.level.tolist() == big.level[1:].tolist() != big.level[:1].tolist()


def test_orthographic_views_do_not_mind_the_distance():
    poses = np.array([(0.0, 0.0, -z, 1.0) for z in (0.0, 500.0)])
    spheres = e3d.detail.DetailedInstances(levels(), poses, hysteresis=0.0)
    for ymag, level in ((1.0, 0), (2.0, 1), (20.0, 2)):
        spheres.update(e3d.OrthographicCamera(ymag), at(10.0), SIZE)
        assert spheres.level.tolist() == [level, level]


def test_levels_do_not_flicker_at_the_limit():
    spheres = e3d.detail.DetailedInstances(levels(), [(0, 0, 0, 1.0)], hysteresis=0.3)
    limit = 1.0 + 0.01 * FOCAL  # where level 1 has an error of a pixel
    changes = sum(spheres.update(CAMERA, at(limit + 0.1 * (-1) ** k), SIZE) for k in range(20))
    assert changes == 0 and spheres.level.tolist() == [0]
    assert spheres.update(CAMERA, at(limit * 1.6), SIZE) and spheres.level.tolist() == [1]
    assert not spheres.update(CAMERA, at(limit + 0.1), SIZE)
    assert spheres.update(CAMERA, at(limit - 0.1), SIZE) and spheres.level.tolist() == [0]
    # Whatever the way there, no error is ever larger than the limit.
    rng = np.random.default_rng(1)
    for distance in rng.uniform(3.0, 60.0, 200):
        spheres.update(CAMERA, at(distance), SIZE)
        assert spheres.level[0] <= expected_level(distance, 1.0)


def test_colors_follow_their_instances_and_the_picture_stays():
    rng = np.random.default_rng(3)
    poses = np.column_stack((rng.uniform(-20, 20, (60, 3)), np.ones(60)))
    colors = rng.integers(0, 255, (60, 3)).astype(np.uint8)
    spheres = e3d.detail.DetailedInstances(levels(), poses, colors=colors, pixels=0.06)
    scene = e3d.Scene()
    spheres.add_to(scene, name="spheres")
    view = CAMERA, at(40.0)
    spheres.update(*view, SIZE)
    assert len(set(spheres.level)) > 1
    plain = e3d.Scene()
    plain.add(e3d.InstancedMesh(levels()[0][0], poses, colors=colors))
    frames = [render(s, view, size=SIZE, outputs=("color",)).color for s in (scene, plain)]
    difference = np.abs(frames[0].astype(int) - frames[1].astype(int)).max(axis=2)
    assert (difference > 40).mean() < 0.01


def test_a_scene_adds_all_nodes_of_them_as_it_adds_one():
    meshes = e3d.detail.DetailedMeshes([([e3d.box()], 0.0)])
    for made in (e3d.detail.DetailedInstances(levels(), np.eye(4)[np.newaxis]), meshes):
        scene = e3d.Scene()
        parent = scene.add(translation=(1.0, 0.0, 0.0))
        node = scene.add(made, name="balls", parent=parent, scale=2.0, cast_shadows=False)
        assert (node.name, node.parent, node.scale.tolist()) == ("balls", parent, [2.0, 2.0, 2.0])
        assert node.children and not any(child.cast_shadows for child in node.children)
    box = scene.add(e3d.box())
    with pytest.raises(InvalidArgumentError, match="several nodes: add it by scene.add"):
        box.object = made
    with pytest.raises(InvalidArgumentError, match="obj must be Mesh"):
        scene.add(e3d.detail.DetailedMeshes)


@pytest.mark.parametrize(
    ("options", "words"),
    [({"pixels": 0.0}, "pixels"), ({"pixels": math.nan}, "pixels"), ({"hysteresis": 1.0}, "hyst")],
)
def test_bad_options(options, words):
    with pytest.raises(InvalidArgumentError, match=words):
        e3d.detail.DetailedInstances(levels(), [(0, 0, 0, 1.0)], **options)


def test_bad_levels():
    mesh = e3d.box()
    for bad in ((), [(mesh, 1.0)], [(mesh, 0.0), (mesh, 2.0), (mesh, 1.0)], [mesh], [("box", 0.0)]):
        with pytest.raises(InvalidArgumentError, match="levels"):
            e3d.detail.DetailedInstances(bad, [(0, 0, 0, 1.0)])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((None, at(5.0), SIZE), "camera must be a Camera, not NoneType"),
        ((e3d.PerspectiveCamera(), 5, SIZE), "pose must have shape"),
        ((e3d.PerspectiveCamera(), at(5.0), 640), "size must be"),
        ((e3d.PerspectiveCamera(), at(5.0), (640, 0)), "height must be"),
    ],
)
def test_a_view_that_is_none(arguments, message):
    spheres = e3d.detail.DetailedInstances(levels(), [(0, 0, 0, 1.0)])
    meshes = e3d.detail.DetailedMeshes([([e3d.box()], 0.0)])
    for detailed in (spheres, meshes):
        with pytest.raises(InvalidArgumentError, match=message):
            detailed.update(*arguments)


def test_several_nodes_keep_the_flags_that_they_add_themselves():
    class Row:
        def add_to(self, scene):
            top = scene.add(name="row")
            scene.add(e3d.box(), name="one", parent=top, cast_shadows=False)
            scene.add(e3d.box(), name="two", parent=top, static=True)
            return top

    scene = e3d.Scene()
    scene.add(Row(), receive_shadows=False)
    one, two = scene.find("one"), scene.find("two")
    assert (one.cast_shadows, one.receive_shadows, one.static) == (False, False, False)
    assert (two.cast_shadows, two.receive_shadows, two.static) == (True, False, True)
    with pytest.raises(e3d.InvalidArgumentError, match="static must be"):
        scene.add(e3d.box(), static="yes")

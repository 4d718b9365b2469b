"""The scene's tree: poses and their parts, world poses, visibility, ids, bounds, arguments."""

import copy
import pickle

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d import linalg


@pytest.fixture
def scene():
    return e3d.Scene()


def test_ids_count_up_and_are_never_used_twice(scene):
    first, second = scene.add(), scene.add()
    scene.remove(second)
    third = scene.add()
    assert [first.id, second.id, third.id] == [0, 1, 2]
    assert scene.nodes == (first, third)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, pickle.dumps])
def test_a_scene_says_that_it_cannot_be_copied(scene, copied):
    with pytest.raises(TypeError, match=r"is copied by scene.copy\(\)"):
        copied(scene)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, pickle.dumps])
def test_nodes_and_renderers_say_that_they_cannot_be_copied(scene, copied):
    node = scene.add(e3d.box())
    with pytest.raises(TypeError, match="belongs to its Scene"):
        copied(node)
    with (
        Renderer((4, 4)) as renderer,
        pytest.raises(TypeError, match="make one in each process"),
    ):
        copied(renderer)


@pytest.mark.parametrize(
    "thing",
    [
        e3d.Scene(),
        e3d.Scene().add(e3d.PerspectiveCamera()),
        e3d.box(),
        e3d.InstancedMesh(e3d.box(), []),
        e3d.Material(),
        e3d.Texture(np.zeros((1, 1), np.uint8)),
        e3d.DirectionalLight(),
        e3d.PointLight(),
        e3d.Camera(np.eye(4)),
        e3d.PerspectiveCamera(),
        e3d.OrthographicCamera(1.0),
        e3d.IntrinsicsCamera(1.0, 1.0, 0.0, 0.0),
        Renderer((8, 8)),
        e3d.Scene().select(),
        e3d.Animator(e3d.Scene()),
        e3d.navigation.Walker(e3d.navigation.NavigationGrid(e3d.plane((4, 4))), 0, 0),
    ],
    ids=lambda thing: type(thing).__name__,
)
def test_attributes_that_there_are_not_cannot_be_assigned(thing):
    """Such as a position of a light, which would change nothing."""
    for name in ("position", "fov", "vertices"):
        with pytest.raises(AttributeError, match=f"no attribute '{name}'"):
            setattr(thing, name, 1.0)


def test_a_subclass_declares_its_own_attributes(scene):
    class Zoom(e3d.PerspectiveCamera):
        steps: int

        def __init__(self, steps):
            super().__init__()
            self.steps = steps
            self._private = steps

    camera = Zoom(3)
    scene.add(camera)
    camera.steps += 1
    assert camera.steps == 4
    with pytest.raises(AttributeError, match="a Zoom has no attribute 'stepz'"):
        camera.stepz = 3


def test_an_id_is_read_only(scene):
    """Colliders, rays and frames go by it."""
    node = scene.add(e3d.box())
    with pytest.raises(AttributeError):
        node.id = 7
    assert node.id == 0


def test_a_failed_add_uses_no_id(scene):
    with pytest.raises(e3d.InvalidArgumentError):
        scene.add(pose=np.eye(3))
    assert scene.nodes == ()
    assert scene.add().id == 0


def test_names(scene):
    mesh = e3d.box()
    mesh.name = "crate"
    assert scene.add(mesh).name == "crate"
    assert scene.add(mesh, name="other").name == "other"
    assert scene.find("other").id == 1
    assert scene.find("none") is None


def test_pose_in_parts(scene):
    half_turn = linalg.quaternion_from_axis_angle((0, 1, 0), np.pi)
    node = scene.add(translation=(1, 2, 3), rotation=half_turn, scale=2)
    np.testing.assert_allclose(node.pose @ [1, 1, 1, 1], [-1, 4, 1, 1], atol=1e-12)
    node.translation = (0, 0, 0)
    np.testing.assert_array_equal(node.rotation, half_turn)
    assert node.scale.tolist() == [2, 2, 2]
    node.scale = (1, 1, 3)
    np.testing.assert_allclose(node.pose @ [0, 0, 1, 1], [0, 0, -3, 1], atol=1e-12)


def test_parts_of_a_matrix(scene):
    pose = linalg.compose((1, 2, 3), (0, 0, np.sin(0.3), np.cos(0.3)), (1, 2, 3))
    node = scene.add(pose=pose)
    np.testing.assert_allclose(node.translation, (1, 2, 3))
    np.testing.assert_allclose(node.rotation, (0, 0, np.sin(0.3), np.cos(0.3)))
    np.testing.assert_allclose(node.scale, (1, 2, 3))
    node.rotation = (0, 0, 0, 1)
    np.testing.assert_allclose(node.pose, linalg.compose((1, 2, 3), (0, 0, 0, 1), (1, 2, 3)))


def test_what_is_read_is_read_only(scene):
    node = scene.add(translation=(1, 0, 0))
    for array in (node.pose, node.translation, node.rotation, node.scale, node.world_pose):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 5


def test_assigned_arrays_are_copied(scene):
    pose = np.eye(4)
    node = scene.add(pose=pose)
    pose[0, 3] = 9
    assert node.pose[0, 3] == 0


def test_world_pose_follows_ancestors(scene):
    sun = scene.add(translation=(1, 0, 0))
    earth = scene.add(parent=sun, translation=(0, 1, 0))
    moon = scene.add(parent=earth, translation=(0, 0, 1))
    assert moon.world_pose[:3, 3].tolist() == [1, 1, 1]
    sun.translation = (5, 0, 0)
    assert moon.world_pose[:3, 3].tolist() == [5, 1, 1]
    assert earth.world_pose[:3, 3].tolist() == [5, 1, 0]
    earth.translation = (0, 2, 0)
    assert moon.world_pose[:3, 3].tolist() == [5, 2, 1]


def test_world_pose_is_kept_until_something_moves(scene):
    parent = scene.add()
    node, other = scene.add(parent=parent), scene.add()
    kept = node.world_pose
    other.translation = (1, 1, 1)
    assert node.world_pose is kept
    parent.translation = (1, 1, 1)
    assert node.world_pose is not kept


def test_a_deep_chain(scene):
    node = None
    for _ in range(200):
        node = scene.add(parent=node, translation=(1, 0, 0))
    assert node.world_pose[0, 3] == 200


def test_hidden_parents_hide(scene):
    parent = scene.add()
    child = scene.add(parent=parent)
    parent.visible = False
    assert child.visible
    assert not child.shown
    parent.visible = True
    assert child.shown


def test_remove_takes_what_is_below(scene):
    parent = scene.add()
    child = scene.add(parent=parent)
    scene.add(parent=child)
    kept = scene.add()
    scene.remove(parent)
    assert scene.nodes == (kept,)
    with pytest.raises(e3d.InvalidArgumentError):
        scene.remove(child)


def test_removed_nodes_are_harmless(scene):
    node = scene.add()
    scene.remove(node)
    node.translation = (1, 2, 3)
    node.visible = False
    with pytest.raises(e3d.InvalidArgumentError, match="parent"):
        scene.add(parent=node)


def test_children_and_parent(scene):
    parent = scene.add()
    child = scene.add(parent=parent)
    assert parent.children == (child,)
    assert child.parent is parent
    scene.remove(child)
    assert parent.children == ()


def test_bounds(scene):
    assert scene.bounds.tolist() == [[0, 0, 0], [0, 0, 0]]
    scene.add(e3d.box(), translation=(10, 0, 0), scale=2)
    hidden = scene.add(e3d.box(), translation=(-50, 0, 0))
    hidden.visible = False
    parent = scene.add(translation=(0, 5, 0))
    scene.add(e3d.InstancedMesh(e3d.box(), [[0, 0, 7, 1]]), parent=parent)
    scene.add(e3d.PointLight(), translation=(0, 0, 99))
    np.testing.assert_array_equal(scene.bounds, [[-0.5, -1, -1], [11, 5.5, 7.5]])


def test_bounds_turn_with_the_node(scene):
    scene.add(e3d.box((2, 4, 6)), pose=linalg.rotation_z(np.pi / 2))
    np.testing.assert_allclose(scene.bounds, [[-2, -1, -3], [2, 1, 3]], atol=1e-12)


def test_empty_meshes_do_not_count(scene):
    scene.add(e3d.Mesh(np.zeros((0, 3))))
    scene.add(e3d.box(), translation=(5, 5, 5))
    np.testing.assert_array_equal(scene.bounds, [[4.5] * 3, [5.5] * 3])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"obj": "mesh"}, "obj must be Mesh"),
        ({"parent": "node"}, "parent"),
        ({"pose": np.eye(4), "scale": 2}, "not both"),
        ({"pose": np.eye(3)}, "pose"),
        ({"pose": np.full((4, 4), np.nan)}, "pose must be finite"),
        ({"pose": np.ones((4, 4))}, "affine"),
        ({"translation": (1, 2)}, "translation"),
        ({"translation": "far"}, "translation must be numbers"),
        ({"rotation": (0, 0, 0, 0)}, "zero quaternion"),
        ({"rotation": (0, 0, 1)}, "rotation"),
        ({"scale": (1, 2)}, "scale"),
        ({"scale": np.inf}, "scale must be finite"),
    ],
)
def test_add_arguments(scene, options, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        scene.add(**options)


def test_parent_of_another_scene(scene):
    with pytest.raises(e3d.InvalidArgumentError, match="parent must be a node of this scene"):
        scene.add(parent=e3d.Scene().add())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"background": (1, 2)}, "background"),
        ({"background": "bluish"}, "background"),
        ({"ambient": (-1, 0, 0)}, "ambient"),
        ({"light_clamp": 1}, "light_clamp"),
        ({"light_clamp": (1, 0)}, "light_clamp"),
    ],
)
def test_scene_arguments(options, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.Scene(**options)


def test_a_node_tells_its_scene_as_long_as_it_is_there():
    scene = e3d.Scene()
    above = scene.add()
    node = scene.add(e3d.box(), parent=above)
    assert node.scene is scene
    scene.remove(above)
    assert node.scene is None and above.scene is None
    scene.restore(above)
    assert node.scene is scene


def test_what_a_scene_keeps_is_not_replaced():
    scene, node = e3d.Scene(), e3d.Scene().add()
    with pytest.raises(AttributeError, match="data"):
        scene.data = e3d.Scene().data
    with pytest.raises(AttributeError, match="scene"):
        node.scene = scene

"""What people hand over: any integers that fit, 8-bit values as floats, lights with a position."""

import warnings

import numpy as np
import pytest

import engine3d as e3d

CORNERS = np.eye(3)
FACE = [[0, 1, 2]]


@pytest.mark.parametrize("dtype", [np.int64, np.uint64, np.int16, np.uint8, object])
def test_any_integers_that_fit_are_indices(dtype):
    faces = np.array(FACE, dtype)
    if dtype is object:
        with pytest.raises(e3d.InvalidArgumentError, match="faces must be integers"):
            e3d.Mesh(CORNERS, faces)
    else:
        assert e3d.Mesh(CORNERS, faces).faces.dtype == np.int32


@pytest.mark.parametrize("wrong", [2**31, 2**40, 2**63 - 1, -(2**31) - 5])
def test_an_index_that_does_not_fit_is_named(wrong):
    with pytest.raises(e3d.InvalidArgumentError, match=f"faces holds {wrong}"):
        e3d.Mesh(CORNERS, [[0, 1, wrong]])


@pytest.mark.parametrize("dtype", [np.int64, np.int32, np.uint16, np.int8])
def test_any_integers_that_fit_are_colours(dtype):
    colors = np.array([[100, 50, 0], [3, 2, 1], [0, 0, 127]], dtype)
    mesh = e3d.Mesh(CORNERS, FACE, colors=colors)
    assert mesh.colors.dtype == np.uint8
    assert mesh.colors.tolist() == [[*row, 255] for row in colors.tolist()]
    crowd = e3d.InstancedMesh(mesh, [(0, 0, 0, 1)] * 3, colors=colors)
    assert np.array_equal(crowd.colors, mesh.colors)


def test_integers_that_are_all_0_or_1_are_floats_as_in_single_colours():
    mesh = e3d.Mesh(CORNERS, FACE, colors=[[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert mesh.colors.dtype == np.float32
    assert mesh.colors[:, :3].tolist() == np.eye(3).tolist()
    assert e3d.Mesh(CORNERS, FACE, colors=np.eye(3, dtype=np.uint8)).colors.dtype == np.uint8


@pytest.mark.parametrize("wrong", [256, -1, 2**40])
def test_a_colour_that_does_not_fit_is_named(wrong):
    colors = [[wrong, 0, 0], [0, 2, 0], [0, 0, 1]]
    with pytest.raises(e3d.InvalidArgumentError, match=f"0..255, but one is {wrong}"):
        e3d.Mesh(CORNERS, FACE, colors=colors)
    with pytest.raises(e3d.InvalidArgumentError, match=f"0..255, but one is {wrong}"):
        e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1)] * 3, colors=colors)


BYTES = np.array([[255.0, 128.0, 0.0]] * 3)
SUSPECT = {
    "vertex": lambda: e3d.Mesh(CORNERS, FACE, colors=BYTES),
    "vertex with alpha": lambda: e3d.Mesh(
        CORNERS, FACE, colors=np.append(BYTES, np.ones((3, 1)), 1)
    ),
    "instance": lambda: e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1)] * 3, colors=BYTES),
    "material": lambda: e3d.Material(color=(255.0, 128.0, 0.0)),
    "background": lambda: e3d.Scene(background=np.array((255.0, 128.0, 0.0))),
}


@pytest.mark.parametrize("name", SUSPECT)
def test_floats_that_are_8_bit_values_are_an_error(name):
    with pytest.raises(e3d.InvalidArgumentError, match="float 255.*8-bit values are integers"):
        SUSPECT[name]()


def test_bright_light_is_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        e3d.Material(emissive=e3d.linear(12.5, 3.0, 0.0), color=(1.0, 1.0, 1.0))
        e3d.PointLight(color=e3d.linear(900.0, 900.0, 900.0))
        e3d.PointLight(color=e3d.linear(60.5, 60.0, 0.0))
        e3d.Mesh(CORNERS, FACE, colors=e3d.linear(np.eye(3) * 4))
        e3d.Material(color=(255, 128, 0))


def test_angles_beside_quaternions():
    scene = e3d.Scene()
    node = scene.add(e3d.box(), euler=(0.3, -0.2, 1.1), translation=(1, 2, 3), scale=2)
    expected = e3d.linalg.euler_to_quaternion((0.3, -0.2, 1.1))
    assert np.allclose(node.rotation, expected) and np.allclose(node.euler, (0.3, -0.2, 1.1))
    other = scene.add(e3d.box(), translation=(1, 2, 3), scale=2)
    other.euler = (0.3, -0.2, 1.1)
    assert np.array_equal(node.pose, other.pose)
    with pytest.raises(e3d.InvalidArgumentError, match="rotation or euler, not both"):
        scene.add(euler=(0, 0, 0), rotation=(0, 0, 0, 1))
    with pytest.raises(e3d.InvalidArgumentError, match="pose or translation"):
        scene.add(euler=(0, 0, 0), pose=np.eye(4))
    with pytest.raises(e3d.InvalidArgumentError, match="euler must"):
        scene.add(euler=(0, 0))


@pytest.mark.parametrize("kind", [e3d.PointLight, e3d.DirectionalLight])
@pytest.mark.parametrize("name", ["position", "translation", "pose"])
def test_a_light_is_placed_by_its_node(kind, name):
    with pytest.raises(TypeError, match=rf"'{name}'.*scene.add\(light, translation="):
        kind(**{name: (1, 2, 3)})


@pytest.mark.parametrize("kind", [e3d.PerspectiveCamera, e3d.OrthographicCamera, e3d.Camera])
def test_a_camera_is_placed_by_its_node(kind):
    with pytest.raises(TypeError, match=r"scene.add\(camera, pose=engine3d.look_at\("):
        kind(position=(1, 2, 3))

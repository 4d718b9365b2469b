"""pyrender's names: what they take, hold and refuse, and how they get into other programs."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest
from compat.pyrender_scenes import drawn, matte, pose, seen, square

import engine3d.compat.pyrender as pyrender
from engine3d.errors import InvalidArgumentError


def test_installed_modules_are_found_by_their_names():
    program = """
import engine3d.compat.pyrender
engine3d.compat.pyrender.install()
import pyrender
from pyrender.constants import RenderFlags, GLTF
from pyrender.light import DirectionalLight
import pyrender.node, pyrender.scene, pyrender.material, pyrender.trackball, pyrender.mesh
from pyrender.renderer import GLError
from pyrender.shader_program import ShaderProgram
from pyrender.camera import DEFAULT_Z_NEAR
assert pyrender.OffscreenRenderer is engine3d.compat.pyrender.OffscreenRenderer
assert pyrender.__version__ == "0.1.45"
assert pyrender.material.MetallicRoughnessMaterial
print("drawn", pyrender.OffscreenRenderer(4, 4).viewport_width)
"""
    environment = {"PYOPENGL_PLATFORM": "nowhere", "PATH": ""}  # never read
    found = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env=environment
    )
    assert found.stdout == "drawn 4\n", found.stderr


def test_shaders_are_refused_with_advice():
    for make in (
        lambda: pyrender.shader_program.ShaderProgram("a", "b"),
        lambda: pyrender.shader_program.ShaderProgramCache(shader_dir="shaders"),
        lambda: pyrender.shader_program.ShaderProgramCache().get_program("a", "b"),
    ):
        with pytest.raises(NotImplementedError, match="normal"):
            make()
    renderer = pyrender.renderer.Renderer(8, 8)  # where programs put a cache of their own shaders
    with pytest.raises(NotImplementedError, match="normal"):
        renderer._program_cache = pyrender.shader_program.ShaderProgramCache()


def test_settings_refuse_other_values():
    with pytest.raises(InvalidArgumentError):
        pyrender.settings.samples = 8
    with pytest.raises(InvalidArgumentError):
        pyrender.settings.orthographic_depth = "right"
    with pytest.raises(ValueError, match='depth_place must be "centre" or "pyrender"'):
        pyrender.settings.depth_place = "corner"


def test_nodes_keep_poses_and_parts_in_step():
    node = pyrender.Node(translation=[1.0, 2.0, 3.0], scale=[2.0, 1.0, 1.0])
    assert np.allclose(node.matrix, [[2, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])
    for axis in np.eye(3):
        for angle in (0.3, 3.0, -2.0):
            turn = pyrender.trackball.rotation_about(angle, axis, np.zeros(3))
            node.matrix = turn
            assert np.allclose(pyrender.Node(rotation=node.rotation).matrix, turn)
    node.matrix[0, 0] = 9  # a copy
    assert node.matrix[0, 0] != 9
    with pytest.raises(ValueError):
        node.matrix = 5 * np.eye(4)
    with pytest.raises(ValueError):
        node.rotation = [1, 2, 3, 4]
    with pytest.raises(TypeError):
        node.mesh = pyrender.DirectionalLight()


def test_scenes_have_sets_parents_and_a_main_camera():
    scene = pyrender.Scene()
    mesh = square()
    base = scene.add(mesh, "base", pose=pose(x=1.0))
    tip = scene.add(mesh, parent_name="base", pose=pose(y=2.0))
    assert base.children == [tip] and scene.meshes == {mesh}
    assert np.allclose(scene.get_pose(tip)[:3, 3], [1, 2, 0])
    assert scene.get_nodes(name="base") == {base} and scene.get_nodes(obj=mesh) == {base, tip}
    first = scene.add(pyrender.PerspectiveCamera(yfov=1.0))
    second = scene.add(pyrender.PerspectiveCamera(yfov=1.0))
    assert scene.main_camera_node is first
    scene.main_camera_node = second
    scene.remove_node(second)
    assert scene.main_camera_node is first
    assert np.allclose(scene.bounds, [[0, -1, 0], [2, 3, 0]])
    scene.remove_node(base)
    assert scene.mesh_nodes == set() and not scene.has_node(tip)
    light = pyrender.DirectionalLight()
    nodes = {scene.add(light, pose=pose(x=float(k))) for k in range(3)}
    assert scene.directional_light_nodes == nodes and scene.lights == {light}
    for wrong in (lambda: scene.add(mesh, parent_name="none"), lambda: scene.get_pose(base)):
        with pytest.raises(ValueError):
            wrong()
    with pytest.raises(TypeError):
        scene.add(None)
    scene.clear()
    assert scene.nodes == set() and scene.main_camera_node is None


def test_values_that_are_none_are_refused():
    with pytest.raises(ValueError):
        pyrender.Primitive([], mode=10)
    with pytest.raises(ValueError):
        pyrender.Primitive(np.zeros((2, 3)), normals=np.zeros((3, 3)))
    with pytest.raises(TypeError):
        pyrender.Primitive(np.zeros((2, 3)), material="red")
    with pytest.raises(ValueError):
        pyrender.MetallicRoughnessMaterial(alphaMode="SOLID")
    with pytest.raises(ValueError):
        pyrender.MetallicRoughnessMaterial(metallicFactor=2.0)
    with pytest.raises(TypeError):
        pyrender.MetallicRoughnessMaterial(doubleSided=1)
    with pytest.raises(ValueError):
        pyrender.PerspectiveCamera(yfov=0.0)
    with pytest.raises(ValueError):
        pyrender.SpotLight(outerConeAngle=2.0)
    with pytest.raises(ValueError):
        drawn(seen(pyrender.Mesh([pyrender.Primitive(np.zeros((2, 3)), indices=[0, 1, 2])])))


def test_things_are_copied_and_pickled_without_what_drawing_keeps():
    mesh = square(1.0, matte(baseColorTexture=np.full((2, 2, 3), 0.5)), texcoord_0=np.zeros((4, 2)))
    color, _ = drawn(seen(mesh))
    for other in (copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))):
        assert np.array_equal(drawn(seen(other))[0], color)


def test_a_trackball_turns_rolls_pans_and_zooms():
    ball = pyrender.trackball.Trackball(pose(z=5.0), (100, 100), 2.0)
    ball.down((50, 50))
    ball.drag((80, 50))
    eye = ball.pose[:3, 3]
    assert np.linalg.norm(eye) == pytest.approx(5.0) and eye[0] == pytest.approx(-5 * np.sin(1.0))
    ball.scroll(1)
    assert np.linalg.norm(ball.pose[:3, 3]) == pytest.approx(4.5)
    for state, distance in (
        (ball.STATE_ROLL, 4.5),
        (ball.STATE_ZOOM, None),
        (ball.STATE_PAN, None),
    ):
        ball.set_state(state)
        ball.down((70, 50))
        before = ball.pose
        ball.drag((50, 70))
        assert not np.allclose(before, ball.pose)
        if distance:
            assert np.linalg.norm(ball.pose[:3, 3]) == pytest.approx(distance)


def test_a_viewer_draws_and_answers_keys_without_changing_the_scene():
    from engine3d import events

    called = []
    scene = seen(square(1.0, matte()), ambient=0.0)
    nodes = set(scene.nodes)
    viewer = pyrender.Viewer(
        scene,
        auto_start=False,
        viewport_size=(32, 24),
        use_raymond_lighting=True,
        registered_keys={"k": (called.append, [])},
    )
    assert viewer.draw()[12, 16, 0] > 50 and scene.nodes == nodes
    for key in "lwwwacho":
        viewer._handle(events.KeyDown(key.upper(), key.upper()))
    assert viewer.viewer_flags["use_direct_lighting"] and viewer.viewer_flags["rotate"]
    assert viewer.render_flags["all_solid"] and not viewer.render_flags["cull_faces"]
    viewer._handle(events.KeyDown("K", "K"))
    assert called == [viewer]
    before = viewer.draw()
    viewer._handle(events.MouseButton("left", True, x=10, y=10))
    viewer._handle(events.MouseMotion(5, 0, x=15, y=10))
    viewer._handle(events.MouseButton("left", False, x=15, y=10))
    assert not np.array_equal(before, viewer.draw())
    with pytest.raises(NotImplementedError, match="axes"):
        pyrender.Viewer(scene, auto_start=False, show_world_axis=True)

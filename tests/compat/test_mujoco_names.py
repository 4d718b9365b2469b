"""`Renderer` and the functions around it: what they take, return and raise."""

import os
import subprocess
import sys

import numpy as np
import pytest

os.environ.setdefault("MUJOCO_GL", "disable")
mujoco = pytest.importorskip("mujoco", exc_type=ImportError)

import engine3d.compat.mujoco as compat  # noqa: E402
from engine3d import Engine3DWarning, InvalidArgumentError  # noqa: E402
from engine3d.compat.mujoco import _layouts  # noqa: E402

_XML = """
<mujoco>
  <asset>
    <mesh name="m" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
    <hfield name="h" nrow="4" ncol="5" size="1 1 .3 .1"/>
    <texture name="t" type="2d" builtin="checker" width="8" height="8" rgb1="1 0 0" rgb2="0 1 0"/>
    <material name="mat" texture="t"/>
  </asset>
  <worldbody>
    <camera name="closeup" pos="0 -3 0" xyaxes="1 0 0 0 0 1"/>
    <geom name="white_box" type="box" size="1 1 1" rgba="1 1 1 1" material="mat"/>
    <geom type="mesh" mesh="m" pos="3 0 0"/>
    <geom type="hfield" hfield="h" pos="-4 0 0"/>
    <light pos="0 0 3"/>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def model():
    return mujoco.MjModel.from_xml_string(_XML)


@pytest.fixture
def data(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data


def test_sizes_are_those_asked_for(model, data):
    with compat.Renderer(model, 50, 70) as renderer:
        assert (renderer.height, renderer.width, renderer.model) == (50, 70, model)
        renderer.update_scene(data)
        picture = renderer.render()
    assert picture.shape == (50, 70, 3)
    assert picture.dtype == np.uint8
    assert picture.flags.c_contiguous


@pytest.mark.parametrize("size", [(4000, 70), (50, 4000)])
def test_sizes_larger_than_the_buffer_raise(model, size):
    with pytest.raises(ValueError, match="framebuffer"):
        compat.Renderer(model, *size)


def test_each_picture_is_an_array_of_its_own(model, data):
    with compat.Renderer(model, 32, 32) as renderer:
        renderer.update_scene(data)
        first = renderer.render()
        assert first is not renderer.render()
        np.testing.assert_array_equal(first, renderer.render())


def test_out_is_written_and_returned(model, data):
    with compat.Renderer(model, 32, 40) as renderer:
        renderer.update_scene(data)
        for dtype in (np.uint8, np.float32):
            out = np.full((32, 40, 3), 7, dtype)
            assert renderer.render(out=out) is out
            np.testing.assert_array_equal(out, renderer.render())
        renderer.enable_depth_rendering()
        depth = np.zeros((32, 40), np.float32)
        assert renderer.render(out=depth) is depth
        assert depth.min() > 0
        renderer.enable_segmentation_rendering()
        for dtype in (np.int32, np.float64):
            objects = np.full((32, 40, 2), 7, dtype)
            assert renderer.render(out=objects) is objects
            np.testing.assert_array_equal(objects, renderer.render())
        with pytest.raises(ValueError, match="out.shape"):
            renderer.render(out=np.zeros((32, 40, 3), np.uint8))
        with pytest.raises(InvalidArgumentError, match="out must be an array"):
            renderer.render(out=[0])
        renderer.enable_depth_rendering()
        for shape in [(40, 32), (32, 40, 3)]:
            with pytest.raises(ValueError, match="out.shape"):
                renderer.render(out=np.zeros(shape, np.float32))


@pytest.mark.parametrize("value", [0, -1, 24.5, 24.0, "24", None, True, np.nan, np.float32(24)])
def test_sizes_are_whole_numbers(model, value):
    for name in ("height", "width"):
        with pytest.raises(InvalidArgumentError, match=f"{name} must be a whole number in 1"):
            compat.Renderer(model, **{name: value})


@pytest.mark.parametrize("value", [None, "x", 5])
def test_models_and_cameras_are_mujocos(model, data, value):
    with pytest.raises(InvalidArgumentError, match="model must be a mujoco.MjModel"):
        compat.Renderer(value)
    if value is not None:
        with pytest.raises(InvalidArgumentError, match="model must be a mujoco.MjModel"):
            compat.MjrContext(value)
    with compat.Renderer(model, 16, 16) as renderer:
        for camera in (None, 0.5, np.nan, [0]):
            with pytest.raises(InvalidArgumentError, match="camera must be a number"):
                renderer.update_scene(data, camera)
        renderer.update_scene(data, np.int64(0))


def test_a_scene_without_room_for_geoms_is_empty(model, data, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes a log
    with compat.Renderer(model, 16, 16, max_geom=0) as renderer:
        renderer.update_scene(data)
        assert not renderer.render().any()
    for wrong in (-1, 2**31, 0.5, "a"):
        with pytest.raises(InvalidArgumentError, match="max_geom"):
            compat.Renderer(model, 16, 16, max_geom=wrong)


def test_a_scene_must_be_filled_before_it_is_drawn(model):
    with compat.Renderer(model, 16, 16) as renderer:
        with pytest.raises(InvalidArgumentError, match="update_scene"):
            renderer.render()


def test_another_size_of_the_buffer_loses_what_it_showed(model, data):
    scene, context = mujoco.MjvScene(model, 100), compat.MjrContext(model)
    option, camera = mujoco.MjvOption(), mujoco.MjvCamera()
    mujoco.mjv_updateScene(model, data, option, None, camera, 7, scene)
    compat.mjr_render(mujoco.MjrRect(0, 0, 40, 32), scene, context)
    compat.mjr_resizeOffscreen(8, 8, context)
    depth, rgb = np.ones((8, 8), np.float32), np.ones((8, 8, 3), np.uint8)
    compat.mjr_readPixels(rgb, depth, mujoco.MjrRect(0, 0, 8, 8), context)
    assert not rgb.any() and (depth == 1).all()
    for size in (-1, np.nan, 1 << 40, "8"):
        with pytest.raises(InvalidArgumentError, match="must be a whole number"):
            compat.mjr_resizeOffscreen(size, 8, context)


def test_pixels_have_the_viewports_size(model):
    context, rectangle = compat.MjrContext(model), mujoco.MjrRect(0, 0, 5, 5)
    with pytest.raises(InvalidArgumentError, match="rgb has 5 elements: the viewport has 75"):
        compat.mjr_drawPixels(np.zeros(5, np.uint8), None, rectangle, context)
    with pytest.raises(InvalidArgumentError, match="rgb must be an array"):
        compat.mjr_readPixels([0], None, rectangle, context)
    for number in ("0", 0.5, None):
        with pytest.raises(InvalidArgumentError, match="there is no mesh"):
            compat.mjr_uploadMesh(model, context, number)


def test_modes_exclude_one_another(model, data):
    with compat.Renderer(model, 16, 16) as renderer:
        renderer.update_scene(data)
        renderer.enable_depth_rendering()
        assert renderer.render().shape == (16, 16)
        renderer.enable_segmentation_rendering()
        assert renderer.render().shape == (16, 16, 2)
        renderer.enable_depth_rendering()
        assert renderer.render().dtype == np.float32
        renderer.disable_depth_rendering()
        assert renderer.render().shape == (16, 16, 3)


def test_flags_of_the_scene_stay(model, data):
    with compat.Renderer(model, 16, 16) as renderer:
        renderer.update_scene(data)
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        before = renderer.scene.flags.copy()
        renderer.enable_depth_rendering()
        renderer.render()
        renderer.update_scene(data)
        np.testing.assert_array_equal(renderer.scene.flags, before)


def test_cameras_by_name_number_and_object(model, data):
    with compat.Renderer(model, 24, 24) as renderer:
        pictures = []
        free = mujoco.MjvCamera()
        mujoco.mjv_defaultFreeCamera(model, free)
        for camera in ("closeup", 0, -1, free):
            renderer.update_scene(data, camera)
            pictures.append(renderer.render())
        np.testing.assert_array_equal(pictures[0], pictures[1])
        np.testing.assert_array_equal(pictures[2], pictures[3])
        assert (pictures[0] != pictures[2]).any()
        for wrong in ("missing", 1, -2):
            with pytest.raises(ValueError, match="camera"):
                renderer.update_scene(data, wrong)


def test_close_is_final_and_may_be_repeated(model, data):
    renderer = compat.Renderer(model, 16, 16)
    renderer.update_scene(data)
    picture = renderer.render()
    renderer.close()
    renderer.close()
    assert picture.shape == (16, 16, 3)
    with pytest.raises(RuntimeError, match="after close"):
        renderer.render()


def test_geoms_are_read_in_place_as_attributes_say(model, data):
    with compat.Renderer(model, 16, 16) as renderer:
        renderer.update_scene(data, "closeup")
        scene = renderer.scene
        for view, items, count in (
            (_layouts.view_geoms(scene), scene.geoms, scene.ngeom),
            (_layouts.view_lights(scene), scene.lights, scene.nlight),
        ):
            assert count > 1
            for name in view.dtype.names:
                for k in range(count):
                    if name != "label":
                        wanted = np.asarray(getattr(items[k], name)).ravel()
                        np.testing.assert_array_equal(view[name][k].ravel(), wanted, name)


def test_changed_meshes_textures_and_fields_show_when_uploaded(model, data):
    context = compat.MjrContext(model, 150)
    scene, camera = mujoco.MjvScene(model, 100), mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, camera)
    view = mujoco.MjrRect(0, 0, 64, 48)

    def draw():
        mujoco.mjv_updateScene(
            model, data, mujoco.MjvOption(), None, camera, mujoco.mjtCatBit.mjCAT_ALL.value, scene
        )
        compat.mjr_render(view, scene, context)
        rgb = np.zeros((48, 64, 3), np.uint8)
        compat.mjr_readPixels(rgb, None, view, context)
        return rgb

    for change, upload in (
        (lambda: model.tex_data.__imul__(0), lambda: compat.mjr_uploadTexture(model, context, 0)),
        (lambda: model.mesh_vert.__imul__(2), lambda: compat.mjr_uploadMesh(model, context, 0)),
        (lambda: model.hfield_data.__iadd__(1), lambda: compat.mjr_uploadHField(model, context, 0)),
    ):
        before = draw()
        change()
        np.testing.assert_array_equal(draw(), before)
        upload()
        assert (draw() != before).any()
    with pytest.raises(InvalidArgumentError, match="no mesh 7"):
        compat.mjr_uploadMesh(model, context, 7)


def test_buffers_are_read_from_below(model, data):
    with compat.Renderer(model, 48, 64) as renderer:
        renderer.update_scene(data)
        wanted, scene = renderer.render(), renderer.scene
        context = compat.MjrContext(model)
        view = mujoco.MjrRect(0, 0, 64, 48)
        compat.mjr_render(viewport=view, scn=scene, con=context)
        rgb, depth = np.zeros(48 * 64 * 3, np.uint8), np.zeros(48 * 64, np.float32)
        compat.mjr_readPixels(rgb=rgb, depth=depth, viewport=view, con=context)
        np.testing.assert_array_equal(rgb.reshape(48, 64, 3)[::-1], wanted)
        renderer.enable_depth_rendering()
        metres = renderer.render()
        near, far = (f * model.stat.extent for f in (model.vis.map.znear, model.vis.map.zfar))
        z = depth.reshape(48, 64)[::-1].astype(float)
        found = near / (1 - z * (1 - near / far))
        seen = metres < far / 2
        assert seen.any()
        assert np.abs(found / metres - 1)[seen].max() < 1e-3
        with pytest.raises(InvalidArgumentError, match="offscreen buffer"):
            compat.mjr_render(mujoco.MjrRect(0, 0, 9999, 10), scene, context)


def test_functions_say_what_they_take(model, data):
    renderer, context = compat.Renderer(model, 8, 8), compat.MjrContext(model)
    view, scene = mujoco.MjrRect(0, 0, 8, 8), renderer.scene
    words = np.array(["a"] * 192)
    for call, match in (
        (lambda: compat.mjr_render(None, scene, context), "viewport must be a mujoco.MjrRect"),
        (lambda: compat.mjr_render(view, None, context), "scn must be a mujoco.MjvScene"),
        (lambda: compat.mjr_render(view, scene, None), "con must be an MjrContext"),
        (lambda: compat.mjr_readPixels(None, None, None, context), "viewport must be"),
        (lambda: compat.mjr_readPixels(None, None, view, None), "con must be"),
        (lambda: compat.mjr_readPixels(words, None, view, context), "rgb must hold numbers"),
        (lambda: compat.mjr_drawPixels([1], None, view, context), "rgb must be an array"),
        (lambda: compat.mjr_drawPixels(words, None, view, context), "rgb must hold numbers"),
        (lambda: compat.mjr_setBuffer(None, context), "framebuffer must be"),
        (lambda: compat.mjr_setBuffer(1, None), "con must be"),
        (lambda: compat.mjr_resizeOffscreen(1, 1, None), "con must be"),
        (lambda: compat.mjr_maxViewport(None), "con must be"),
        (lambda: compat.mjr_uploadMesh(None, context, 0), "model must be"),
        (lambda: compat.mjr_uploadMesh(model, None, 0), "con must be"),
        (lambda: compat.MjrContext(model, None), "fontscale must be"),
        (lambda: compat.Renderer(model, 8, 8, font_scale=None), "font_scale must be"),
        (lambda: compat.Renderer(model, 8, 8, font_scale="big"), "font_scale must be"),
        (lambda: renderer.update_scene(None), "data must be a mujoco.MjData"),
        (lambda: renderer.update_scene(data, scene_option=3), "scene_option must be"),
        (lambda: renderer.render(out=np.zeros((8, 8, 3), object)), "out must hold numbers"),
    ):
        with pytest.raises(InvalidArgumentError, match=match):
            call()


def test_font_scales_are_mujocos_or_numbers(model):
    scale = mujoco.mjtFontScale.mjFONTSCALE_100
    compat.Renderer(model, 8, 8, font_scale=scale).close()
    assert compat.MjrContext(model, scale).fontScale == scale.value


def test_what_is_not_drawn_is_a_warning(model):
    context = compat.MjrContext(model)
    with pytest.warns(Engine3DWarning, match="mjr_overlay is not drawn"):
        compat.mjr_overlay(0, 0, mujoco.MjrRect(0, 0, 9, 9), "a", "b", context)


def _run(code, **environment):
    environment = {**{k: v for k, v in os.environ.items() if k != "MUJOCO_GL"}, **environment}
    result = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_importing_it_imports_neither_mujoco_nor_opengl():
    code = """
import sys
import engine3d.compat.mujoco
print('mujoco' in sys.modules, 'OpenGL' in sys.modules)
"""
    assert _run(code).split() == ["False", "False"]


@pytest.mark.parametrize("platform", [None, "egl", "disable", "engine3d"])
def test_install_serves_programs_that_know_mujoco_alone(platform):
    code = f"""
import sys
import engine3d.compat.mujoco as compat
compat.install()
import mujoco
model = mujoco.MjModel.from_xml_string({_XML!r})
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 32, 32) as renderer:
    renderer.update_scene(data)
    assert renderer.render().any()
from mujoco.egl import GLContext
context = GLContext(64, 64)
context.make_current()
con = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_150.value)
mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, con)
assert mujoco.Renderer is compat.Renderer and mujoco.mjr_render is compat.mjr_render
print("OpenGL" in sys.modules, "glfw" in sys.modules)
context.free()
import types  # robosuite makes its contexts by modules of its own
sys.modules["robosuite"] = sys.modules["robosuite.renderers"] = types.ModuleType("robosuite")
sys.modules["robosuite.renderers.context"] = types.ModuleType("context")
from robosuite.renderers.context.egl_context import EGLGLContext
context = EGLGLContext(max_width=64, max_height=64, device_id=0)
context.make_current()
context.free()
"""
    environment = {} if platform is None else {"MUJOCO_GL": platform}
    assert _run(code, **environment).split() == ["False", "False"]


def test_install_after_mujoco_was_imported():
    code = """
import mujoco
import engine3d.compat.mujoco as compat
compat.install()
assert mujoco.Renderer is compat.Renderer
from mujoco.renderer import Renderer
assert Renderer is compat.Renderer
"""
    _run(code, MUJOCO_GL="disable")


def test_gymnasium_draws_colours_and_depths():
    pytest.importorskip("gymnasium", exc_type=ImportError)
    code = """
import engine3d.compat.mujoco
engine3d.compat.mujoco.install()
import gymnasium
for mode in ("rgb_array", "depth_array", "rgbd_tuple"):
    env = gymnasium.make("Ant-v5", render_mode=mode, width=84, height=60)
    env.reset(seed=1)
    env.step(env.action_space.sample())
    out = env.render()
    rgb, depth = out if mode == "rgbd_tuple" else (out, out)
    if mode != "depth_array":
        assert rgb.shape == (60, 84, 3) and rgb.std() > 10
    if mode != "rgb_array":
        assert depth.shape == (60, 84) and 0 < depth.min() < depth.max() <= 1
    env.close()
print("drawn")
"""
    assert _run(code).strip() == "drawn"


def test_dm_control_draws():
    pytest.importorskip("dm_control", exc_type=ImportError)
    code = """
import engine3d.compat.mujoco
engine3d.compat.mujoco.install()
try:
    from dm_control import mujoco
    xml = "<mujoco><worldbody><geom size='.2'/></worldbody></mujoco>"
    physics = mujoco.Physics.from_xml_string(xml)
except Exception as error:  # versions that do not know this mujoco
    print("skip", error)
else:
    assert physics.render(60, 80).shape == (60, 80, 3)
    assert physics.render(60, 80).any()
    assert physics.render(60, 80, depth=True).min() > 0
    print("drawn")
"""
    out = _run(code)
    if out.startswith("skip"):
        pytest.skip(out)
    assert out.strip() == "drawn"

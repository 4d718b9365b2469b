"""A context's buffer and fields: depths that are read late, rectangles, what fields change."""

import os

import numpy as np
import pytest

os.environ.setdefault("MUJOCO_GL", "disable")
mujoco = pytest.importorskip("mujoco", exc_type=ImportError)

import engine3d.compat.mujoco as compat  # noqa: E402
from engine3d import Engine3DWarning, InvalidArgumentError  # noqa: E402

_TILE = 40
_WORLD = """
<mujoco>
  <statistic extent="1"/>
  <visual>
    <map znear=".05" zfar="20" {map}/><quality {quality}/><global {width}/><rgba {rgba}/>
  </visual>
  <asset>
    <texture type="skybox" builtin="gradient" rgb1=".3 .5 .7" rgb2="0 0 0" width="32" height="192"/>
    <mesh name="m" vertex="0 0 0  .6 0 0  0 .6 0  0 0 .6"/>
  </asset>
  <worldbody>
    <camera name="c" pos="0 -2 1" xyaxes="1 0 0 0 .4 .9"/>
    <light pos="0 0 3"/>
    <light pos="1 0 3" dir="-.3 0 -1" directional="true"/>
    <geom type="plane" size="1 1 .1" rgba=".5 .5 .5 1"/>
    <geom type="mesh" mesh="m" pos="-.6 .2 .2"/>
    <body name="ball" pos=".3 0 .3">
      <joint name="j" type="slide" axis="1 0 0"/><geom size=".2" rgba=".9 .5 .2 {alpha}"/>
    </body>
  </worldbody>
  <deformable>
    <skin vertex="-.2 -.2 .5  .2 -.2 .5  .2 .2 .5  -.2 .2 .5" face="0 1 2 0 2 3">
      <bone body="ball" bindpos="0 0 0" bindquat="1 0 0 0" vertid="0 1 2 3" vertweight="1 1 1 1"/>
    </skin>
  </deformable>
</mujoco>
"""


def _model(alpha=1, **visual):
    names = dict.fromkeys(("map", "quality", "width", "rgba"), "") | visual
    return mujoco.MjModel.from_xml_string(_WORLD.format(alpha=alpha, **names))


class _Program:
    """A program of a scene and a context."""

    def __init__(self, model):
        self.model, self.data = model, mujoco.MjData(model)
        self.scene, self.context = mujoco.MjvScene(model, 100), compat.MjrContext(model)
        self.camera = mujoco.MjvCamera()
        self.camera.type, self.camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, 0
        self.move(0)

    def move(self, place):
        self.data.qpos[0] = place
        mujoco.mj_forward(self.model, self.data)
        option = mujoco.MjvOption()
        mujoco.mjv_updateScene(self.model, self.data, option, None, self.camera, 7, self.scene)

    def draw(self, left=0, bottom=0, width=_TILE, height=_TILE):
        compat.mjr_render(mujoco.MjrRect(left, bottom, width, height), self.scene, self.context)

    def read(self, left=0, bottom=0, width=_TILE, height=_TILE):
        rgb = np.zeros((height, width, 3), np.uint8)
        depth = np.zeros((height, width), np.float32)
        rectangle = mujoco.MjrRect(left, bottom, width, height)
        compat.mjr_readPixels(rgb, depth, rectangle, self.context)
        return rgb, depth

    def drawn(self):
        self.draw()
        return self.read()

    def set(self, name, value=1):
        self.scene.flags[getattr(mujoco.mjtRndFlag, f"mjRND_{name}")] = value


# ---- depths that are read late ----


def test_depths_of_many_rectangles_are_kept():
    program, wanted = _Program(_model()), []
    for number in range(12):
        program.move(number / 20)
        wanted.append(program.drawn()[1])
    program.context.resize(1, 1)
    program.context.resize(4 * _TILE, 3 * _TILE)
    for number in range(12):
        program.move(number / 20)
        program.draw(number % 4 * _TILE, number // 4 * _TILE)
    depth = program.read(0, 0, 4 * _TILE, 3 * _TILE)[1]
    for number in range(12):
        left, bottom = number % 4 * _TILE, number // 4 * _TILE
        tile = depth[bottom : bottom + _TILE, left : left + _TILE]
        np.testing.assert_array_equal(tile, wanted[number])


def test_depths_are_those_of_the_skins_when_they_were_drawn():
    program = _Program(_model())
    program.draw()
    wanted = program.read()[1].copy()
    program.draw()
    program.move(0.5)
    program.draw(_TILE)
    np.testing.assert_array_equal(program.read()[1], wanted)
    assert (program.read(_TILE)[1] != wanted).any()


def test_depths_are_those_of_the_meshes_when_they_were_drawn():
    program = _Program(_model())
    wanted = program.drawn()[1].copy()
    program.model.mesh_vert[:] *= 0.5
    compat.mjr_uploadMesh(program.model, program.context, 0)
    np.testing.assert_array_equal(program.read()[1], wanted)
    assert (program.drawn()[1] != wanted).any()


def test_a_picture_over_others_hides_their_depths():
    program = _Program(_model())
    wanted = program.drawn()[1].copy()
    program.move(0.4)
    program.draw(5, 5, 10, 10)
    inner = program.read(5, 5, 10, 10)[1].copy()
    wanted[5:15, 5:15] = inner
    np.testing.assert_array_equal(program.read()[1], wanted)


def test_the_same_size_loses_nothing():
    program = _Program(_model())
    rgb, depth = program.drawn()
    context = program.context
    compat.mjr_resizeOffscreen(context.offWidth, context.offHeight, context)
    for found, wanted in zip(program.read(), (rgb, depth), strict=True):
        np.testing.assert_array_equal(found, wanted)


# ---- what colours leave behind ----


def _distance(model, depth):
    near, far = model.vis.map.znear, model.vis.map.zfar
    return near / (1 - depth.astype(float) * (1 - near / far))


def test_colours_leave_the_depth_of_the_sky():
    model = _model()
    program = _Program(model)
    top = _distance(model, program.drawn()[1])[-1]
    assert (top < 0.71 * model.vis.map.zfar).all() and (top > 0.3 * model.vis.map.zfar).all()
    program.set("SKYBOX", 0)
    assert (program.drawn()[1][-1] == 1).all()


def test_transparent_geoms_leave_no_depth():
    solid, clear, none = (_Program(_model(alpha)).drawn()[1] for alpha in (1, 0.5, 0))
    assert (solid != none).any()
    np.testing.assert_array_equal(clear, none)


def test_segments_leave_the_depths_of_all_geoms():
    program = _Program(_model(alpha=0.5))
    program.set("SEGMENT")
    depth = program.drawn()[1]
    with compat.Renderer(program.model, _TILE, _TILE) as renderer:
        renderer.enable_depth_rendering()
        renderer.update_scene(program.data, "c")
        metres = renderer.render()[::-1]
    seen = metres < 10
    assert seen.any()
    assert np.abs(_distance(program.model, depth) / metres - 1)[seen].max() < 1e-3
    assert (depth[~seen] == 1).all()


@pytest.mark.parametrize("is_segmented", [0, 1])
def test_both_eyes_have_segments_and_depths_of_their_own(is_segmented):
    program = _Program(_model())
    program.set("SEGMENT", is_segmented)
    program.scene.camera[0].pos[0] -= 0.1
    program.scene.camera[1].pos[0] += 0.1
    program.scene.stereo = mujoco.mjtStereo.mjSTEREO_SIDEBYSIDE
    program.draw(0, 0, 2 * _TILE + 1)
    both = program.read(0, 0, 2 * _TILE + 1)
    assert not both[0][:, 2 * _TILE :].any() and (both[1][:, 2 * _TILE :] == 1).all()
    program.scene.stereo = 0
    places = [float(camera.pos[0]) for camera in program.scene.camera]
    for number, place in enumerate(places):
        for camera in program.scene.camera:
            camera.pos[0] = place
        for found, wanted in zip(both, program.drawn(), strict=True):
            own = found[:, number * _TILE : (number + 1) * _TILE]
            np.testing.assert_array_equal(own, wanted)


def test_segments_have_frames():
    program = _Program(_model())
    program.set("SEGMENT")
    inner = program.drawn()[0]
    program.scene.framewidth, program.scene.framergb[:] = 3, (1, 0, 0)
    framed = program.drawn()[0]
    np.testing.assert_array_equal(framed[3:-3, 3:-3], inner[3:-3, 3:-3])
    for edge in (framed[:3], framed[-3:], framed[:, :3], framed[:, -3:]):
        assert (edge == (255, 0, 0)).all()


# ---- fields ----


@pytest.mark.parametrize(
    ("field", "value", "visual", "flag"),
    [
        ("shadowSize", 512, {"quality": "shadowsize='512'"}, "SHADOW"),
        ("shadowClip", 0.25, {"map": "shadowclip='.25'"}, "SHADOW"),
        ("shadowScale", 0.25, {"map": "shadowscale='.25'"}, "SHADOW"),
        ("offSamples", 0, {"quality": "offsamples='0'"}, "SHADOW"),
        ("lineWidth", 3, {"width": "linewidth='3'"}, "WIREFRAME"),
        ("fogStart", 0.5, {"map": "fogstart='.5'"}, "FOG"),
        ("fogEnd", 3, {"map": "fogend='3'"}, "FOG"),
        ("fogRGBA", (0.5, 0.25, 0, 1), {"rgba": "fog='.5 .25 0 1'"}, "FOG"),
    ],
)
def test_fields_of_a_context_are_read_for_each_picture(field, value, visual, flag):
    program, other = _Program(_model()), _Program(_model(**visual))
    for each in (program, other):
        each.set(flag)
    before, wanted = program.drawn()[0], other.drawn()[0]
    assert (before != wanted).any()
    old = getattr(program.context, field)
    setattr(program.context, field, value)
    np.testing.assert_array_equal(program.drawn()[0], wanted)
    setattr(program.context, field, old)
    np.testing.assert_array_equal(program.drawn()[0], before)


def test_without_a_map_lights_have_no_shadows():
    program = _Program(_model())
    program.context.shadowSize = 0
    found = program.drawn()[0]
    program.context.shadowSize = 4096
    assert (program.drawn()[0] != found).any()
    program.set("SHADOW", 0)
    np.testing.assert_array_equal(program.drawn()[0], found)


def test_pixels_are_read_in_their_format():
    program = _Program(_model())
    rgb = program.drawn()[0]
    program.context.readPixelFormat = 0x80E0  # GL_BGR
    np.testing.assert_array_equal(program.read()[0], rgb[..., ::-1])
    program.context.readPixelFormat = 0x1908  # GL_RGBA
    with pytest.raises(InvalidArgumentError, match="readPixelFormat must be GL_RGB"):
        program.read()


def test_fields_that_cannot_be_drawn_are_told():
    program = _Program(_model())
    for field, value in (
        *(("shadowSize", -1), ("shadowSize", 0.5), ("offSamples", None), ("lineWidth", np.nan)),
        *(("fogStart", "near"), ("fogRGBA", (1, 2))),
    ):
        old = getattr(program.context, field)
        setattr(program.context, field, value)
        with pytest.raises(InvalidArgumentError, match=field):
            program.draw()
        setattr(program.context, field, old)
    program.context.shadowSize = 20000
    with pytest.warns(Engine3DWarning, match="shadowSize 20000 is drawn as 16000"):
        program.draw()
    program.context.shadowSize, program.context.currentBuffer = 64, 0
    with pytest.warns(Engine3DWarning, match="no window"):
        program.draw()


def test_there_are_no_fields_that_nothing_reads():
    context = compat.MjrContext(_model())
    for name in ("shadowFBO", "linewidth"):
        with pytest.raises(AttributeError, match=name):
            setattr(context, name, 0)


def test_uploads_read_the_model_that_they_are_given():
    program, other = _Program(_model()), _model()
    other.mesh_vert[:] *= 0.5
    before = program.drawn()[0].copy()
    compat.mjr_uploadMesh(other, program.context, 0)
    assert (program.drawn()[0] != before).any()
    stranger = mujoco.MjModel.from_xml_string("<mujoco/>")
    with pytest.raises(InvalidArgumentError, match="no mesh 0"):
        compat.mjr_uploadMesh(stranger, program.context, 0)
    text = _WORLD.format(alpha=1, map="", quality="", width="", rgba="")
    text = text.replace("<mesh ", "<mesh name='n' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/><mesh ")
    with pytest.raises(InvalidArgumentError, match="nmesh 1, not 2"):
        compat.mjr_uploadMesh(mujoco.MjModel.from_xml_string(text), program.context, 0)

"""Flexes and skins in MuJoCo's manner: the materials of their faces, and how textures repeat."""

import os

import numpy as np
import pytest

os.environ.setdefault("MUJOCO_GL", "disable")
mujoco = pytest.importorskip("mujoco", exc_type=ImportError)

from engine3d.compat.mujoco import Renderer  # noqa: E402

_SIZE = 64
_FLEX = """
<mujoco>
  <statistic extent="1"/>
  <asset>
    <texture name="t" type="2d" builtin="checker" width="32" height="32" rgb1="1 1 1" rgb2="0 0 1"/>
    <material name="red" rgba="1 0 0 1" specular="0"/>
    <material name="green" rgba="0 1 0 1" specular="0"/>
    <material name="tiled" texture="t" texrepeat="{repeat} {repeat}" texuniform="{uniform}"/>
  </asset>
  <worldbody>
    <camera name="c" pos="0 0 1.2" xyaxes="1 0 0 0 1 0"/>
    <flexcomp name="f" type="grid" count="4 4 1" spacing=".2 .2 .2" radius=".02" dim="2" mass="1"
      material="{material}"><pin id="0"/></flexcomp>
  </worldbody>
</mujoco>
"""
_SKIN = """
<mujoco>
  <statistic extent="1"/>
  <asset>
    <texture name="t" type="2d" builtin="checker" width="32" height="32" rgb1="1 1 1" rgb2="0 0 1"/>
    <material name="tiled" texture="t" texrepeat="{repeat} {repeat}" texuniform="{uniform}"/>
  </asset>
  <worldbody>
    <camera name="c" pos="0 0 1.2" xyaxes="1 0 0 0 1 0"/>
    <body name="bone"><joint type="slide"/><geom size=".01" rgba="0 0 0 0"/></body>
  </worldbody>
  <deformable>
    <skin material="tiled" vertex="-.3 -.3 0  .3 -.3 0  .3 .3 0  -.3 .3 0"
      texcoord="0 0 1 0 1 1 0 1" face="0 1 2 0 2 3">
      <bone body="bone" bindpos="0 0 0" bindquat="1 0 0 0" vertid="0 1 2 3" vertweight="1 1 1 1"/>
    </skin>
  </deformable>
</mujoco>
"""


@pytest.fixture(autouse=True)
def _log(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes a log


def _model(text, material="red", repeat=3, uniform="false"):
    text = text.format(material=material, repeat=repeat, uniform=uniform)
    return mujoco.MjModel.from_xml_string(text)


def _drawn(model, faces=True, frame=False):
    data, option = mujoco.MjData(model), mujoco.MjvOption()
    mujoco.mj_forward(model, data)
    for name, value in (("VERT", frame), ("EDGE", frame), ("FACE", False), ("SKIN", faces)):
        option.flags[getattr(mujoco.mjtVisFlag, f"mjVIS_FLEX{name}")] = value
    with Renderer(model, _SIZE, _SIZE) as renderer:
        renderer.update_scene(data, "c", option)
        return renderer.render()


@pytest.fixture
def sliced():
    """Return a flex whose left faces are red, and whose right faces are green."""
    model = _model(_FLEX)
    if len(model.flex_matid) != model.nflexelem:
        pytest.skip("this version's flexes have one material each")
    faces = model.flex_elem.reshape(-1, 3)
    middle = model.flex_vert0.reshape(-1, 3)[faces].mean(1)
    model.flex_matid[:] = middle[:, 0] > 0.5
    return model


def test_each_face_of_a_flex_has_its_own_material(sliced):
    picture = _drawn(sliced)
    for material in ("red", "green"):
        whole = _drawn(_model(_FLEX, material))
        mine = (picture == whole).all(-1) & whole.any(-1)
        assert 0.4 < mine.sum() / whole.any(-1).sum() < 0.6


def test_the_frame_of_a_flex_has_the_first_material(sliced):
    picture = _drawn(sliced, faces=False, frame=True)
    whole = _drawn(_model(_FLEX), faces=False, frame=True)
    assert picture.any()
    np.testing.assert_array_equal(picture, whole)


@pytest.mark.parametrize("text", [_FLEX, _SKIN])
def test_uniform_textures_repeat_on_flexes_and_skins_as_others(text):
    uniform = _drawn(_model(text, "tiled", uniform="true"))
    other = _drawn(_model(text, "tiled"))
    assert len(np.unique(other)) > 5
    np.testing.assert_array_equal(uniform, other)


@pytest.mark.parametrize("text", [_FLEX, _SKIN])
def test_textures_by_coordinates_repeat_since_version_3_12(text, monkeypatch):
    monkeypatch.setattr(mujoco, "mj_versionString", lambda: "3.12.0")
    once, thrice = (_drawn(_model(text, "tiled", n)) for n in (1, 3))
    assert (once != thrice).any()
    monkeypatch.setattr(mujoco, "mj_versionString", lambda: "3.3.7")
    for repeat in (1, 3):
        np.testing.assert_array_equal(_drawn(_model(text, "tiled", repeat)), once)

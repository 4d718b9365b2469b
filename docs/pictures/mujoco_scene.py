"""Draws the picture of docs/mujoco.md; needs the package mujoco.

    python docs/pictures/mujoco_scene.py

In: a scene in MuJoCo's format. Out: mujoco.webp in this folder: colours, depths and objects.
"""

import os
from pathlib import Path

import numpy as np
from PIL import Image

os.environ.setdefault("MUJOCO_GL", "disable")
import mujoco

from engine3d.compat.mujoco import Renderer

WIDTH, HEIGHT = 300, 320
SCENE = """
<mujoco>
  <visual>
    <headlight ambient=".15 .15 .15" diffuse=".35 .35 .35" specular=".1 .1 .1"/>
    <global fovy="42"/>
  </visual>
  <asset>
    <texture type="skybox" builtin="gradient" rgb1=".45 .6 .8" rgb2=".1 .15 .25"
      width="128" height="768"/>
    <texture name="floor" type="2d" builtin="checker" rgb1=".22 .28 .36" rgb2=".3 .37 .46"
      width="256" height="256"/>
    <material name="floor" texture="floor" texrepeat="4 4" reflectance=".25"/>
    <material name="shell" rgba=".85 .45 .2 1" specular=".6" shininess=".7"/>
    <material name="limb" rgba=".9 .75 .5 1"/>
    <material name="glass" rgba=".3 .7 .9 .4"/>
  </asset>
  <worldbody>
    <light pos="1.5 -2 4" dir="-.3 .45 -1" cutoff="60" diffuse=".7 .7 .65"/>
    <geom type="plane" size="4 4 .1" material="floor"/>
    <body pos="0 0 .75">
      <geom type="ellipsoid" size=".42 .3 .26" material="shell"/>
      <geom type="capsule" fromto=".3 .2 0 .8 .5 .2" size=".07" material="limb"/>
      <geom type="capsule" fromto=".8 .5 .2 1 .7 -.7" size=".05" material="limb"/>
      <geom type="capsule" fromto=".3 -.2 0 .8 -.5 .2" size=".07" material="limb"/>
      <geom type="capsule" fromto=".8 -.5 .2 1 -.7 -.7" size=".05" material="limb"/>
      <geom type="capsule" fromto="-.3 .2 0 -.8 .5 .2" size=".07" material="limb"/>
      <geom type="capsule" fromto="-.8 .5 .2 -1 .7 -.7" size=".05" material="limb"/>
      <geom type="capsule" fromto="-.3 -.2 0 -.8 -.5 .2" size=".07" material="limb"/>
      <geom type="capsule" fromto="-.8 -.5 .2 -1 -.7 -.7" size=".05" material="limb"/>
    </body>
    <geom type="box" pos="-.2 -1.3 .2" size=".2 .2 .2" euler="0 0 25" material="glass"/>
    <camera name="view" pos="2 -3.1 1.9" xyaxes=".84 .54 0 -.24 .38 .9"/>
  </worldbody>
</mujoco>
"""


def main() -> None:
    model = mujoco.MjModel.from_xml_string(SCENE)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Renderer(model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(data, "view")
        colors = renderer.render()
        renderer.enable_depth_rendering()
        depth = renderer.render()
        renderer.enable_segmentation_rendering()
        objects = renderer.render()[..., 0]
    near = np.clip(255 * (1.6 / depth) ** 0.8, 0, 255).astype(np.uint8)
    palette = np.random.default_rng(3).integers(60, 255, (model.ngeom + 1, 3)).astype(np.uint8)
    palette[-1] = 24
    row = np.hstack([colors, np.repeat(near[..., None], 3, axis=2), palette[objects]])
    Image.fromarray(row).save(Path(__file__).with_name("mujoco.webp"), lossless=True, method=6)


if __name__ == "__main__":
    main()

"""
A stereo pair
=============

This draws one scene for a left and a right eye, and lays both into one picture for red and cyan
glasses.

Both cameras look the same way, and stand beside each other. For disparities and masks, and for
data sets, there is ``engine3d.sensors.StereoCamera``.
"""

from importlib.resources import files

import numpy as np

import engine3d as e3d

scene = e3d.load(files("engine3d.data") / "models" / "island.obj")
camera, middle = e3d.frame_scene(scene, aspect=4 / 3, direction=(-0.4, -0.4, -1))
to_the_side = e3d.linalg.translation((0.25, 0.0, 0.0))
to_the_left = e3d.linalg.translation((-0.25, 0.0, 0.0))
left = e3d.render(scene, (camera, middle @ to_the_left), size=(400, 300)).color
right = e3d.render(scene, (camera, middle @ to_the_side), size=(400, 300)).color
mixed = right.copy()
mixed[..., 0] = left[..., 0]
anaglyph = e3d.Canvas(mixed)

# %%
# The pair, for eyes that can look at two pictures at once:

pair = e3d.Canvas(np.hstack([left[::2, ::2], right[::2, ::2]]))

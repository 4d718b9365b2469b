"""
Framing from a direction
========================

This looks at a model from three directions, each time from just so far that all of it shows.

``frame_scene`` returns a camera and its pose, which is world-from-camera.
"""

from importlib.resources import files

import numpy as np

import engine3d as e3d

scene = e3d.load(files("engine3d.data") / "models" / "island.obj")
frames = []
for direction in ((0, -0.3, -1), (-1, -0.5, -1), (0, -1, -0.01)):  # the way the camera looks
    camera = e3d.frame_scene(scene, direction=direction, aspect=160 / 200)
    frames.append(e3d.render(scene, camera, size=(160, 200)))
picture = e3d.Canvas(np.hstack([frame.color for frame in frames]))

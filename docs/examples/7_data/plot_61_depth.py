"""
A depth map
===========

This draws how far away things are: as a picture, near is light, and as an array of numbers.

``frame.depth`` is the distance along the camera's axis, and 0 where nothing is.
"""

from importlib.resources import files

import numpy as np
from PIL import Image

import engine3d as e3d

scene = e3d.load(files("engine3d.data") / "models" / "island.obj")
camera = e3d.frame_scene(scene, direction=(-0.5, -0.6, -1), aspect=4 / 3)
frame = e3d.render(scene, camera, size=(400, 300), outputs=("color", "depth"))
seen = frame.depth > 0
print(f"from {frame.depth[seen].min():.2f} to {frame.depth.max():.2f}")

share = np.where(seen, (frame.depth - frame.depth[seen].min()) / np.ptp(frame.depth[seen]), 1.0)
near, far = np.array((250, 230, 120)), np.array((40, 30, 90))
colors = np.where(seen[..., np.newaxis], near + (far - near) * share[..., np.newaxis], 0)
depth = Image.fromarray(colors.astype(np.uint8))

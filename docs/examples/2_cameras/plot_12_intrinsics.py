"""
A camera with the matrix K
==========================

This draws what a calibrated camera sees, given focal lengths and a principal point in pixels.

The centre of the first pixel is at (0.5, 0.5). OpenCV puts it at (0, 0), so add 0.5 to its cx and
cy. OpenCV's camera looks along +Z with +Y down: negate two columns of its pose.
"""

import numpy as np

import engine3d as e3d

K = np.array([[420.0, 0.0, 199.5], [0.0, 420.0, 149.5], [0.0, 0.0, 1.0]])  # as OpenCV has it
camera = e3d.IntrinsicsCamera(K[0, 0], K[1, 1], K[0, 2] + 0.5, K[1, 2] + 0.5)
pose = e3d.look_at((1.5, 1.2, 3.0), (0.0, 0.0, 0.0))
frame = e3d.render(e3d.box(1.0), (camera, pose), size=(400, 300))

# %%
# The same points by OpenCV's formula, and by ``frame.project``:

opencv_from_world = e3d.linalg.inverse(pose * (1.0, -1.0, -1.0, 1.0))
corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
seen = (corners @ opencv_from_world[:3, :3].T + opencv_from_world[:3, 3]) @ K.T
pixels = seen[:, :2] / seen[:, 2:]
assert np.allclose(pixels + 0.5, frame.project(corners)[0])
picture = frame.canvas()
for x, y in pixels:
    picture.rectangle(x - 2, y - 2, 5, 5, "crimson")

"""
Normals
=======

This draws which way each surface faces: in the world, and as seen from the camera.

``frame.world_normal`` and ``frame.normal`` are arrays of shape (height, width, 3).
"""

import numpy as np
from PIL import Image

import engine3d as e3d

scene = e3d.Scene()
scene.add(e3d.torus(1.0, 0.4), rotation=e3d.linalg.euler_to_quaternion((0.9, 0.3, 0.0)))
scene.add(e3d.box(0.8), translation=(0.0, 0.2, 0.2))
frame = e3d.render(scene, size=(240, 200), outputs=("color", "world_normal", "normal"))
tiles = []
for normals in (frame.world_normal, frame.normal):
    colors = np.rint(127.5 + 127.5 * normals)
    colors[(normals == 0.0).all(axis=-1)] = 0
    tiles.append(colors.astype(np.uint8))
picture = Image.fromarray(np.hstack(tiles))

"""A solution of the checked exercise of lesson 7, light."""

import numpy as np

import engine3d as e3d

ball = e3d.icosphere(1.0, 3)
light = np.array((0.6, 0.0, 0.8))
dark = 0
for a, b, c in ball.positions[ball.faces].astype(float):
    normal = np.cross(b - a, c - a)
    normal = normal / np.sqrt(normal @ normal)
    if normal[2] > 0 and normal @ light <= 0:
        dark += 1
print(dark)

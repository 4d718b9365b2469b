"""
Levels of detail
================

This draws balls in the coarsest of four meshes that nobody can tell from the finest. Here each
level has a colour, and one pixel of error is allowed.
"""

import numpy as np

import engine3d as e3d

levels = []
for subdivisions, color in ((4, "tomato"), (3, "orange"), (2, "yellowgreen"), (1, "steelblue")):
    ball = e3d.icosphere(0.5, subdivisions)
    ball.materials = [e3d.Material(color=color)]
    middles = ball.positions[ball.faces].mean(axis=1)  # of the faces: where it is flattest
    error = 0.5 - np.linalg.norm(middles, axis=1).min()
    levels.append((ball, 0.0 if not levels else float(error)))

poses = np.tile(np.eye(4), (40 * 20, 1, 1))
row, column = np.divmod(np.arange(800), 20)
poses[:, 0, 3], poses[:, 2, 3] = 1.3 * (column - 9.5), -2.0 * row
balls = e3d.detail.DetailedInstances(levels, poses, pixels=0.5)
scene = e3d.Scene(background=(225, 230, 236), ambient=(130, 132, 138))
scene.add(balls)
scene.add(e3d.DirectionalLight((-0.5, -1.0, -0.5), intensity=2.2))
camera, pose = e3d.PerspectiveCamera(0.6), e3d.look_at((0, 2.6, 5.0), (0, 0, -8))
balls.update(camera, pose, (480, 280))
frame = e3d.render(scene, (camera, pose), size=(480, 280))
print(np.bincount(balls.level), "balls of each level")

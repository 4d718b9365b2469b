"""
Picking with rays
=================

This asks a scene which face lies behind a pixel, and marks the place with its normal.

``scene.raycast`` needs no picture. Its answer has the same bits everywhere.
"""

import numpy as np

import engine3d as e3d

SIZE = 420, 280
scene = e3d.Scene()
ring = scene.add(e3d.torus(1.0, 0.4), name="ring", translation=(0.0, 0.4, 0.0))
camera, pose = e3d.frame_scene(scene, direction=(-0.4, -0.8, -1.0), aspect=SIZE[0] / SIZE[1])
frame = e3d.render(scene, (camera, pose), size=SIZE)
picture = frame.canvas()

projection = camera.projection(SIZE)
for column, row in ((140, 110), (210, 210), (320, 170), (210, 125), (30, 30)):
    x = (2.0 * column / SIZE[0] - 1.0) / projection[0, 0]
    y = (1.0 - 2.0 * row / SIZE[1]) / projection[1, 1]
    direction = pose[:3, :3] @ np.array((x, y, -1.0))
    hit = scene.raycast(pose[:3, 3], direction)
    picture.text(column + 4, row + 4, "nothing" if hit is None else f"face {hit.face_id}", "black")
    if hit is not None:
        (x0, y0), _ = frame.project(hit.position)
        (x1, y1), _ = frame.project(hit.position + 0.3 * hit.normal)
        picture.line(x0, y0, x1, y1, "crimson", width=2)

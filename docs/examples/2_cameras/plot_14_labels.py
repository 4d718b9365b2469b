"""
Labels in space
===============

This writes the names of things beside them, where they can be seen.

``frame.project`` tells which pixel shows a place of the world, and how far away the place is. If
something nearer is drawn there, the label is left out.
"""

import engine3d as e3d

scene = e3d.Scene()
names = {"red": (-1.2, 0.4, 0.0), "green": (0.0, 0.4, 0.6), "blue": (0.5, 0.4, -1.9)}
for name, place in names.items():
    ball = e3d.uv_sphere(0.4)
    ball.materials = [e3d.Material(color=name)]
    scene.add(ball, name=name, translation=place)
scene.add(e3d.box((0.9, 1.6, 0.2)), translation=(1.5, 0.8, 0.0))

camera = e3d.frame_scene(scene, direction=(-0.3, -0.4, -1), aspect=4 / 3)
frame = e3d.render(scene, camera, size=(400, 300), outputs=("color", "depth"))
picture = frame.canvas()
for name, (x, y, z) in names.items():
    (column, row), depth = frame.project((x, y + 0.4, z))
    nearest = frame.depth[int(row), int(column)]
    if nearest == 0.0 or nearest > depth - 0.1:
        picture.line(column, row, column + 14, row - 14, "black")
        picture.text(column + 16, row - 22, name, "white", background="black")

"""A solution of the checked exercise of lesson 2, points."""

from importlib.resources import files

import engine3d as e3d

width, height, scale = 240, 180, 34
path = files("engine3d.data") / "models" / "teapot.obj"
pixels = set()
for _, y, z in e3d.load_mesh(path).positions.tolist():
    column = int((width / 2 + scale * z) // 1)
    row = int((height / 2 - scale * (y - 1.5)) // 1)
    pixels.add((column, row))
print(len(pixels))

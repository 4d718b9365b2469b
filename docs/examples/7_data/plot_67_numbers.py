"""
Numbers as colours
==================

This shows a number of each vertex as a colour, with a bar that says which is which.

``mesh.values`` keeps numbers by name; PLY and glTF files keep them, too.
"""

import numpy as np

import engine3d as e3d

ball = e3d.icosphere(1.0, 5)
x, y, z = ball.positions.T
ball.values["field [T]"] = np.sin(4 * x) * np.cos(3 * y) + z
frame = e3d.render(ball, size=(420, 300), color_by="field [T]", colormap="coolwarm", bar=True)

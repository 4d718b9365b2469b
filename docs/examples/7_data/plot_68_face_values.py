"""
A number for each face
======================

This colours triangles by how large they are. A number of a face is the same all over it.
"""

from importlib.resources import files

import numpy as np

import engine3d as e3d

mesh = e3d.load_mesh(files("engine3d.data") / "models" / "teapot.obj")
a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
mesh.values["area"] = e3d.Values(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2, on="faces")
frame = e3d.render(
    mesh, size=(420, 300), color_by="area", colormap="plasma", bar=True, axes_grid=True
)

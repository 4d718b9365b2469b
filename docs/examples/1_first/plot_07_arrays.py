"""
A mesh from arrays of NumPy
===========================

This makes a surface from a table of heights: positions, and triangles that join them.
"""

import numpy as np

import engine3d as e3d

N = 80
x, z = np.meshgrid(np.linspace(-4, 4, N), np.linspace(-4, 4, N))
distance = np.hypot(x, z)
height = np.cos(2.5 * distance) * np.exp(-0.35 * distance)

# %%
# Each square of the table becomes two triangles, counter-clockwise as seen from above.

corner = (np.arange(N - 1)[:, np.newaxis] * N + np.arange(N - 1)).ravel()
faces = np.concatenate(
    [
        np.stack([corner, corner + N, corner + N + 1], axis=1),
        np.stack([corner, corner + N + 1, corner + 1], axis=1),
    ]
)
positions = np.stack([x, height, z], axis=-1).reshape(-1, 3)
mesh = e3d.Mesh(positions, faces)
mesh.materials = [e3d.Material(color="steelblue", roughness=0.4, metallic=0.0)]
frame = e3d.render(mesh, size=(480, 300))

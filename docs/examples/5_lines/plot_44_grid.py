"""
Axes, a grid and paths
======================

This draws a path as a line in space, before a grid that shows coordinates.
"""

import numpy as np

import engine3d as e3d

time = np.linspace(0.0, 1.0, 400)
path = np.stack(
    [np.sin(19 * time) * (1 - 0.5 * time), 2 * time, np.cos(19 * time) * (1 - 0.5 * time)], axis=-1
)
steps = np.arange(len(path) - 1)
wire = e3d.Mesh(path, [], lines=np.stack([steps, steps + 1], axis=1))
wire.materials = [e3d.Material(color="crimson")]
frame = e3d.render(
    wire,
    size=(420, 360),
    axes_grid=True,
    line_width=3,
    line_shape="round",
    look=e3d.Look.studio(ground=False, background="light"),
)

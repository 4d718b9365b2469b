"""
A point cloud
=============

This draws an array of points, each with a colour.

Points are as large as suits their number. ``point_size`` chooses pixels, and
``point_shape="round"`` draws discs.
"""

import numpy as np

import engine3d as e3d

random = np.random.default_rng(4)
angle, radius = random.uniform(0.0, 25.0, 30_000), random.normal(0.0, 0.12, (30_000, 3))
spiral = np.stack([np.cos(angle), 0.12 * angle - 1.5, np.sin(angle)], axis=-1)
cloud = e3d.Mesh(points=np.arange(30_000), positions=spiral + radius, faces=[])
cloud.colors = np.stack([angle / 25.0, np.full(30_000, 0.6), 1.0 - angle / 25.0], axis=-1)
frame = e3d.render(cloud, size=(420, 360), point_shape="round")

# %%
# An array of shape (N, 3) is drawn in the same way:

bare = e3d.render(spiral + radius, size=(300, 220), look=e3d.Look.studio(background="dark"))

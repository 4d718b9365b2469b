"""
A LiDAR's points
================

This measures an island by the 64 beams of a spinning LiDAR, and shows its points, coloured by
height.

``Lidar.of`` knows common sensors. The points are in the sensor's space, x forward and z up, and in
the world; each knows which node it hit.
"""

from importlib.resources import files

import numpy as np
from PIL import Image

import engine3d as e3d
from engine3d.sensors import Lidar

scene = e3d.load(files("engine3d.data") / "models" / "island.obj")
low, high = scene.bounds
reach = float(np.max(high - low))
ground, above = float(low[1]), float(low[1]) + 0.3 * reach
scene.add(e3d.plane(6.0 * reach), translation=(0.0, ground, 0.0))
sensor = e3d.look_at((-0.2 * reach, above, 1.1 * reach), (0.0, above, 0.0))
scan = Lidar.of("hdl-64e").scan(scene, sensor)

cloud = e3d.Mesh(scan.world_points, points=np.arange(len(scan)))
away = (-1.2 * reach, 1.2 * reach, 2.2 * reach)
camera = e3d.PerspectiveCamera(0.6, zfar=100.0 * reach), e3d.look_at(away, (0.0, above, 0.0))
colors = {"color_by": "y", "clim": (ground, above), "look": "plain", "point_size": 1.5}
picture = e3d.render(cloud, camera, size=(400, 300), **colors).color

# %%
# The distances as the sensor sees them: a column for each step of its turn, a row for each beam.

ranges = scan.image("range")
near = np.where(ranges > 0, 1.0 - ranges / ranges.max(), 0.0)
distances = Image.fromarray(np.repeat((255 * near[:, ::3]).astype(np.uint8), 2, axis=0))

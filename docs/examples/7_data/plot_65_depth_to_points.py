"""
From depth to a point cloud
===========================

This turns a depth map back into points, as a depth camera does, and draws them from another side.

``frame.world_position`` would hold the same points.
"""

from importlib.resources import files

import numpy as np

import engine3d as e3d

scene = e3d.load(files("engine3d.data") / "models" / "teapot.obj")
middle = scene.bounds.mean(axis=0)
pose = e3d.look_at(middle + (3.0, 4.0, 8.0), middle)
camera = e3d.IntrinsicsCamera(300.0, 300.0, 120.0, 90.0)
frame = e3d.render(scene, (camera, pose), size=(240, 180), outputs=("color", "depth"))

y, x = np.nonzero(frame.depth)
depth = frame.depth[y, x].astype(float)
in_camera = np.stack(
    [(x + 0.5 - 120.0) / 300.0 * depth, (90.0 - y - 0.5) / 300.0 * depth, -depth], axis=-1
)
points = in_camera @ pose[:3, :3].T + pose[:3, 3]
cloud = e3d.Mesh(points, [], points=np.arange(len(points)), colors=frame.color[y, x, :3])
other = e3d.PerspectiveCamera(0.45), e3d.look_at(middle + (8.0, 4.0, 2.0), middle)
seen = e3d.render(cloud, other, size=(360, 240), look="plain", mode="unlit", point_size=2)

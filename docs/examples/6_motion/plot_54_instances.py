"""
Ten thousand instances
======================

This draws one mesh at ten thousand poses, each in a colour of its own.
"""

import numpy as np

import engine3d as e3d

N = 100
row, column = np.divmod(np.arange(N * N), N)
x, z = 1.2 * (column - N / 2), -1.2 * row
height = 2.0 * np.sin(0.09 * x) * np.cos(0.11 * z)
poses = np.zeros((N * N, 4, 4))
poses[:] = np.eye(4)
poses[:, :3, 3] = np.stack([x, height, z], axis=-1)
share = (height - height.min()) / np.ptp(height)
colors = np.stack([share, 0.35 + 0.4 * share, 1.0 - share], axis=-1)

scene = e3d.Scene(background=(222, 230, 238), ambient=(130, 134, 142))
scene.add(e3d.InstancedMesh(e3d.box(0.9), poses, colors=colors))
scene.add(e3d.DirectionalLight((-0.6, -1.0, -0.3), intensity=2.4))
camera = e3d.PerspectiveCamera(0.6, zfar=300.0), e3d.look_at((14, 16, 18), (0, 0, -30))
frame = e3d.render(scene, camera, size=(480, 280))
print(f"{frame.stats['triangles']:,} triangles")

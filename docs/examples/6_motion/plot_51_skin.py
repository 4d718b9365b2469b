"""
A skin that bends
=================

This bends a tube by a chain of joints. Each vertex follows the two joints nearest to it.
"""

import numpy as np

import engine3d as e3d

JOINTS, RINGS, AROUND = 6, 61, 32
height, turn = np.linspace(0.0, 5.0, RINGS), 2.0 * np.pi * np.arange(AROUND + 1) / AROUND
y, angle = (grid.ravel() for grid in np.meshgrid(height, turn, indexing="ij"))
positions = np.stack([0.3 * np.cos(angle), y, 0.3 * np.sin(angle)], axis=-1)
corner = (np.arange(RINGS - 1)[:, np.newaxis] * (AROUND + 1) + np.arange(AROUND)).ravel()
quads = np.stack([corner, corner + AROUND + 1, corner + AROUND + 2, corner + 1], axis=-1)
tube = e3d.Mesh.from_polygons(positions, quads)
lower = np.minimum(tube.positions[:, 1].astype(int), JOINTS - 2)
share = tube.positions[:, 1] - lower
joints, weights = np.stack([lower, lower + 1], 1), np.stack([1 - share, share], 1)
tube = e3d.Mesh(tube.positions, tube.faces, joints=joints, weights=weights)
tube.materials = [e3d.Material(color="mediumseagreen", metallic=0.0, roughness=0.4)]

scene = e3d.Scene()
chain = [scene.add(name="joint 0")]
for number in range(1, JOINTS):
    chain.append(scene.add(name=f"joint {number}", parent=chain[-1], translation=(0, 1, 0)))
scene.add(tube).skin = e3d.motion.Skin(chain)

camera = e3d.PerspectiveCamera(0.6), e3d.look_at((-1.0, 3.0, 11.0), (0.6, 2.5, 0.0))
poses = []
for bend in (0.0, 0.2, 0.4):
    for joint in chain[1:]:
        joint.euler = (0.0, 0.0, -bend)
    poses.append(e3d.render(scene, camera, size=(160, 200)).color)
picture = e3d.Canvas(np.hstack(poses))

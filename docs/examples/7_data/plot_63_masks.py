"""
Segmentation masks
==================

This colours each object's pixels. An identity is exact: it is never blended at edges.

``frame.object_id`` holds ``node.id``, ``frame.instance_id`` the number of an instance, and
``frame.material_id`` that of a material.
"""

import numpy as np
from PIL import Image

import engine3d as e3d

scene = e3d.Scene()
shapes = {"ring": e3d.torus(0.5, 0.2), "box": e3d.box(0.7), "can": e3d.cylinder(0.35, 0.9)}
nodes = [
    scene.add(mesh, name=name, translation=(1.1 * place, 0.45, 0.4 * (place % 2)))
    for place, (name, mesh) in enumerate(shapes.items())
]
frame = e3d.render(scene, size=(320, 200), outputs=("color", "object_id"))
colors = np.zeros((max(node.id for node in nodes) + 1, 3), np.uint8)
for node, color in zip(nodes, ((230, 80, 60), (80, 190, 90), (70, 120, 230)), strict=True):
    colors[node.id] = color
    print(node.name, np.count_nonzero(frame.object_id == node.id), "pixels")
inside = frame.object_id >= 0
picture = np.where(inside[..., np.newaxis], colors[frame.object_id], 24).astype(np.uint8)
masks = Image.fromarray(picture)

"""
Bounding boxes
==============

This finds the box of pixels around each object, from the identities, and draws it.

A box holds what can be seen. What hides behind something else has a smaller box, or none.
"""

import numpy as np

import engine3d as e3d

scene = e3d.Scene()
things = {"ring": e3d.torus(0.5, 0.2), "box": e3d.box(0.7), "ball": e3d.uv_sphere(0.4)}
for place, (name, mesh) in enumerate(things.items()):
    scene.add(mesh, name=name, translation=(0.9 * place, 0.45, -0.8 * (place % 2)))
frame = e3d.render(scene, size=(420, 260), outputs=("color", "object_id"))
picture = frame.canvas()
for node in scene.nodes:
    rows, columns = np.nonzero(frame.object_id == node.id)
    if len(rows):
        left, top = int(columns.min()), int(rows.min())
        width, height = int(np.ptp(columns)) + 1, int(np.ptp(rows)) + 1
        picture.rectangle(left, top, width, height, "crimson", fill=False)
        picture.text(left + 3, top + 3, node.name, "white", background="crimson")

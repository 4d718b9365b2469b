"""
An orthographic drawing
=======================

This draws a mesh without perspective, as lines on paper.

``OrthographicCamera(ymag)`` shows ``2 * ymag`` units from the bottom of the picture to its top,
so lengths can be measured in pixels.
"""

import numpy as np

import engine3d as e3d

bolt = e3d.Mesh.concatenate(
    [
        e3d.cylinder(0.5, 2.0, 24),
        e3d.cylinder(1.0, 0.5, 6).transformed(e3d.linalg.translation((0.0, 1.25, 0.0))),
    ]
)
scene = e3d.Scene(background="white")
scene.add(bolt)
camera = e3d.OrthographicCamera(1.7)
drawings = []
for eye in ((0, 0, 5), (5, 0, 0), (3, 2.5, 4)):
    pose = e3d.look_at(eye, (0.0, 0.25, 0.0))
    view = (camera, pose)
    drawn = e3d.render(scene, view, size=(160, 200), wireframe="only", line_color="black").color
    drawings.append(drawn)
drawing = e3d.Canvas(np.hstack(drawings))
drawing.text(8, 184, f"1 unit = {200 / (2 * 1.7):.0f} pixels", "dimgray")

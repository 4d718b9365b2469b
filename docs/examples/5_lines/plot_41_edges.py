"""
Edges of a part
===============

This draws the edges of a part's polygons over its faces, as dark lines.

``line_color``, ``line_width`` and ``line_shape`` say how they look.
"""

import engine3d as e3d

parts = [e3d.box((2.4, 0.4, 1.6))]
for x in (-0.7, 0.7):
    stub = e3d.cylinder(0.35, 0.9, 24)
    parts.append(stub.transformed(e3d.linalg.translation((x, 0.65, 0.0))))
part = e3d.Mesh.concatenate(parts)
aluminium = e3d.Material(color=(0.72, 0.75, 0.78), metallic=0.0, roughness=0.5)
camera = e3d.frame_scene(part, direction=(-0.6, -0.7, -1.0), aspect=8 / 5)
frame = e3d.render(part, camera, size=(480, 300), edges=True, material=aluminium)

"""
Transparent panes
=================

This draws panes that cross each other. Whatever order they are added in, each pixel blends them
from back to front.

``alpha_mode="blend"`` makes alpha count; the fourth number of a colour is its alpha.
"""

import engine3d as e3d

scene = e3d.Scene(background=(240, 240, 236), ambient=(160, 160, 160))
colors = ((220, 50, 40, 140), (40, 160, 70, 140), (40, 90, 220, 140))
for number, color in enumerate(colors):
    pane = e3d.box((2.0, 1.4, 0.04))
    pane.materials = [e3d.Material(color=color, metallic=0.0, roughness=0.2, alpha_mode="blend")]
    turn = e3d.linalg.euler_to_quaternion((0.0, 1.05 * number, 0.0))
    scene.add(pane, translation=(0.0, 0.75, 0.0), rotation=turn)
scene.add(e3d.plane(5.0))
scene.add(e3d.DirectionalLight((-0.4, -1.0, -0.6), intensity=2.0))
camera = e3d.PerspectiveCamera(0.5), e3d.look_at((0.8, 2.2, 4.6), (0.0, 0.6, 0.0))
frame = e3d.render(scene, camera, size=(420, 300))

"""
Ambient occlusion
=================

This draws steps without and with ambient occlusion, which keeps light out of corners and hollows.
"""

import numpy as np

import engine3d as e3d

scene = e3d.Scene(background=(225, 228, 232), ambient=(205, 205, 200))
for number in range(6):
    step = e3d.box((3.0, 0.3, 0.5))
    scene.add(step, translation=(0.0, 0.15 + 0.3 * number, -0.5 * number))
scene.add(e3d.box((0.2, 3.0, 4.0)), translation=(-1.6, 1.2, -1.0))
scene.add(e3d.plane(9.0))
scene.add(e3d.DirectionalLight((-0.6, -1.0, -0.5), intensity=0.6))
camera = e3d.PerspectiveCamera(0.6), e3d.look_at((2.6, 3.6, 6.0), (-0.2, 0.7, -0.8))
halves = [
    e3d.render(scene, camera, size=(240, 240), ambient_occlusion=occluded).color
    for occluded in (False, True)
]
picture = e3d.Canvas(np.hstack(halves))

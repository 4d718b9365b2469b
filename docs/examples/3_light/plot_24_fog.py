"""
Fog
===

This puts fog between the camera and a row of pillars. What is far away takes the colour of the
fog.

``Fog(color, near, far)`` begins at a distance and hides everything from another one on.
``ExponentialFog(color, density)`` begins at the camera.
"""

import engine3d as e3d

MIST = (186, 196, 206)
scene = e3d.Scene(background=MIST, ambient=(150, 155, 165))
scene.fog = e3d.ExponentialFog(MIST, 0.09)
ground = e3d.plane(80.0)
ground.materials = [e3d.Material(color="olivedrab")]
scene.add(ground)
pillar = e3d.cylinder(0.5, 3.0, 32)
pillar.materials = [e3d.Material(color="sienna")]
for z in range(-40, 3, 3):
    for x in (-2.0, 2.0):
        scene.add(pillar, translation=(x, 1.5, z))
scene.add(e3d.DirectionalLight((-0.5, -1.0, -0.4), "cornsilk", 2.4))
camera = e3d.PerspectiveCamera(0.8), e3d.look_at((0.9, 1.7, 6.0), (0.0, 1.3, -6.0))
frame = e3d.render(scene, camera, size=(480, 280))

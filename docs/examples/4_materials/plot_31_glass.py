"""
Coloured glass
==============

This draws balls that let light through. ``transmission`` makes a material clear, and
``attenuation_color`` tints what comes through it, the more the thicker it is.
"""

import engine3d as e3d

scene = e3d.Scene(background=(232, 232, 230), ambient=(0, 0, 0))
scene.environment = e3d.Environment.studio()
for number, color in enumerate(("tomato", "gold", "mediumseagreen", "royalblue")):
    ball = e3d.uv_sphere(0.5, (64, 32))
    ball.materials = [
        e3d.Material(
            metallic=0.0,
            roughness=0.02,
            transmission=1.0,
            thickness=1.0,
            attenuation_color=color,
            attenuation_distance=0.7,
        )
    ]
    scene.add(ball, translation=(0.85 * number - 1.3, 0.5, 0.3 * (number % 2)))
    bar = e3d.box((0.2, 1.6, 0.2))
    bar.materials = [e3d.Material(color=(60, 66, 80), metallic=0.0, roughness=0.6)]
    scene.add(bar, translation=(0.85 * number - 1.7, 0.8, -1.0))
scene.add(e3d.plane((7.0, 5.0)))
camera = e3d.PerspectiveCamera(0.45), e3d.look_at((0.7, 1.9, 5.0), (0.0, 0.5, 0.0))
frame = e3d.render(scene, camera, size=(480, 280), tone_mapping="neutral", ambient_occlusion=True)

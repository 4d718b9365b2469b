"""
Glow and tone mapping
=====================

This draws lamps that are brighter than white: cut off at white, mapped to what a screen can show,
and with a glow around them.
"""

import numpy as np

import engine3d as e3d

scene = e3d.Scene(background=(8, 9, 14), ambient=(20, 22, 30))
floor = e3d.plane((9.0, 5.0))
floor.materials = [e3d.Material(color=(0.5, 0.5, 0.55), metallic=0.0, roughness=0.5)]
scene.add(floor, translation=(0.0, -0.6, 0.0))
for x, color in ((-1.4, "tomato"), (0.0, "gold"), (1.4, "deepskyblue")):
    bulb = e3d.uv_sphere(0.35, (48, 24))
    bulb.materials = [
        e3d.Material(color="black", roughness=1.0, emissive=color, emissive_strength=6.0)
    ]
    scene.add(bulb, translation=(x, 0.0, 0.0))
    scene.add(e3d.PointLight(color, 2.5), translation=(x, 0.0, 0.0))
camera = e3d.PerspectiveCamera(0.6), e3d.look_at((0.0, 1.2, 4.6), (0.0, -0.1, 0.0))
ways = ({}, {"tone_mapping": "agx"}, {"tone_mapping": "agx", "bloom": 0.7})
strips = [e3d.render(scene, camera, size=(400, 130), **way).color for way in ways]
picture = e3d.Canvas(np.vstack(strips))
for row, name in enumerate(("neither", "tone_mapping", "tone_mapping, bloom")):
    picture.text(8, 8 + 130 * row, name, "white")

"""
The sun and the sky
===================

This lights a model by a low sun and the sky around it.

The sun is a light of its own here, so that it casts shadows; ``sun_disc=False`` keeps the sky
from lighting the scene with it a second time.
"""

from importlib.resources import files

import engine3d as e3d

scene = e3d.load(files("engine3d.data") / "models" / "island.obj")
sun = (-0.75, 0.22, -0.5)  # towards it
scene.environment = e3d.Environment.sky(sun, turbidity=3, sun_disc=False)
scene.background = scene.environment
light = e3d.DirectionalLight.sun(sun, turbidity=3)
light.shadow = "exact"
scene.add(light)
scene.exposure = 1.3  # stops
camera = e3d.frame_scene(scene, direction=(-0.5, -0.12, -1), aspect=480 / 300, margin=0.9)
frame = e3d.render(scene, camera, size=(480, 300), tone_mapping="agx", ambient_occlusion=True)

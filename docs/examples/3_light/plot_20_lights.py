"""
Lamps of three kinds
====================

This lights a room with a point light, a spot light and faint light from the sky.

Intensities of points and spots are in candela, and of directional lights in lux, as in glTF: π
shows a white wall white at a distance of 1.
"""

import math

import engine3d as e3d

scene = e3d.Scene(background=(12, 14, 20), ambient=(0, 0, 0))
scene.add(e3d.HemisphereLight((90, 110, 150), (40, 34, 30)))
scene.add(e3d.plane(8.0))
scene.add(e3d.box((8.0, 3.0, 0.2)), translation=(0.0, 1.5, -1.6))
for x in (-1.5, 0.0, 1.5):
    scene.add(e3d.cylinder(0.25, 0.8, 48), translation=(x, 0.4, 0.0))
lamp = e3d.PointLight("orange", 1.2 * math.pi, shadow="exact")
scene.add(lamp, translation=(-1.4, 1.3, 0.6))
spot = e3d.SpotLight("white", 6.0 * math.pi, outer_cone_angle=0.35, shadow="exact")
scene.add(spot, pose=e3d.look_at((2.4, 2.6, 2.2), (1.3, 0.2, -0.2)))
camera = e3d.PerspectiveCamera(0.6), e3d.look_at((0.6, 1.9, 4.9), (0.0, 0.65, 0.0))
frame = e3d.render(scene, camera, size=(480, 300))

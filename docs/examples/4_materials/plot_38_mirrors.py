"""
Mirrors
=======

This hangs a mirror on a wall above a polished floor. ``mirror`` makes flat faces reflect the scene,
sharply and exactly, mirrors in mirrors included. The floor is a physical material, which reflects
more the flatter one looks along it.
"""

import math

import engine3d as e3d
from engine3d import linalg


def thing(mesh, **material):
    mesh.materials = [e3d.Material(**material)]
    return mesh


scene = e3d.Scene(background=(120, 150, 190), ambient=e3d.linear(0.35, 0.35, 0.4))
floor = thing(e3d.plane((5, 5)), color=(70, 60, 55), metallic=0.0, roughness=0.2, mirror=1.0)
scene.add(floor, translation=(0, 0, 0.5))
scene.add(thing(e3d.box((5, 3, 0.1)), color=(205, 190, 170)), translation=(0, 1.5, -1.56))
frame = thing(e3d.box((2.5, 1.7, 0.05)), color=(110, 70, 40), metallic=0.0, roughness=0.5)
scene.add(frame, translation=(0.3, 1.0, -1.48))
glass = thing(e3d.plane((2.3, 1.5)), color=(235, 240, 240), mirror=0.92)
upright = linalg.translation((0.3, 1.0, -1.45)) @ linalg.rotation_x(math.pi / 2)
scene.add(glass, pose=upright)
scene.add(thing(e3d.uv_sphere(0.35), color=(200, 50, 40)), translation=(-0.7, 0.35, -0.2))
gold = thing(e3d.icosphere(0.3, 4), color=(255, 200, 90), metallic=1.0, roughness=0.35)
scene.add(gold, translation=(0.2, 0.3, 0.3))
scene.add(
    thing(e3d.box(0.5), color=(60, 110, 190)), translation=(1.0, 0.25, -0.3), euler=(0, 0.5, 0)
)
sun = e3d.DirectionalLight((-0.5, -1.0, -0.7), intensity=2.4)
sun.shadow = "exact"
scene.add(sun)
camera = e3d.PerspectiveCamera(0.7), e3d.look_at((-0.9, 1.3, 4.6), (0.15, 0.75, 0.0))
picture = e3d.render(scene, camera, size=(640, 400), ambient_occlusion=True)

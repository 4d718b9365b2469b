"""
A window, a lamp and a tube
===========================

Lights that have a surface: a rectangle, a disc and a tube, in a room with four metal balls.

Highlights have the shape of their light, and shadows are sharp where things touch. What glows is a
mesh of its own beside each light.
"""

import math

import engine3d as e3d
from engine3d.lights import DiscLight, RectangleLight, TubeLight

scene = e3d.Scene(background=(0, 0, 0), ambient=(0.12, 0.12, 0.12))
wall = e3d.Material(color=(0.86, 0.85, 0.83), metallic=0.0, roughness=0.7)
floor = e3d.Material(color=(0.6, 0.58, 0.56), metallic=0.0, roughness=0.25)
for size, place, material in (
    ((8, 0.1, 8), (0, -0.05, 0), floor),
    ((8, 4, 0.1), (0, 2, -3), wall),
    ((0.1, 4, 8), (-4, 2, 0), wall),
    ((0.1, 4, 8), (4, 2, 0), wall),
):
    mesh = e3d.box(size)
    mesh.materials = [material]
    scene.add(mesh, translation=place)
for number, roughness in enumerate((0.1, 0.25, 0.45, 0.7)):
    ball = e3d.uv_sphere(0.5, (96, 48))
    ball.materials = [e3d.Material(color=(0.95, 0.85, 0.7), metallic=1.0, roughness=roughness)]
    scene.add(ball, translation=(-2.1 + 1.4 * number, 0.5, 0.4))


def glow(mesh, color, **place):
    mesh.materials = [e3d.Material(color=(0, 0, 0), emissive=color)]
    scene.add(mesh, cast_shadows=False, **place)


soft = {"shadow": "map", "shadow_map_size": 2048}
window = RectangleLight((1, 0.93, 0.8), 5.0, width=2.2, height=2.4, **soft)
turned = {"euler": (0, -math.pi / 2, 0)}
scene.add(window, translation=(-3.9, 1.7, -0.6), **turned)
glow(e3d.box((2.2, 2.4, 0.02)), (1, 0.93, 0.8), translation=(-3.93, 1.7, -0.6), **turned)
lamp = DiscLight((0.75, 0.87, 1), 9.0, radius=0.5, **soft)
scene.add(lamp, translation=(1.2, 3.2, 0.4), euler=(-math.pi / 2, 0, 0))
tube = TubeLight((1, 0.45, 0.7), 12.0, length=2.6, radius=0.05, **soft)
scene.add(tube, translation=(1.6, 2.1, -2.7))
stick = e3d.cylinder(0.05, 2.6)
glow(stick, (1, 0.45, 0.7), translation=(1.6, 2.1, -2.7), euler=(0, 0, math.pi / 2))
camera = e3d.PerspectiveCamera(0.75), e3d.look_at((0.2, 1.9, 6.2), (0.0, 1.2, 0.0))
frame = e3d.render(scene, camera, size=(640, 400), tone_mapping="neutral")

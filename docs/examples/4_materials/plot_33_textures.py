"""
Textures
========

This lays a picture on a box and on a ball: by their own coordinates, and repeated.

``load_texture("wood.jpg")`` reads one; ``Texture(array)`` takes pixels of NumPy.
"""

import numpy as np

import engine3d as e3d

v, u = np.mgrid[0:256, 0:256] / 256
rings = np.hypot(u - 0.5, 3.0 * (v - 0.5) + 0.1 * np.sin(9 * u))
grain = 0.75 + 0.25 * np.sin(70 * rings)
wood = e3d.Texture((grain[..., np.newaxis] * (205, 150, 95)).astype(np.uint8))
tiles = e3d.PlacedTexture(wood, scale=(4.0, 2.0), rotation=0.5)

scene = e3d.Scene()
box = e3d.box(1.0)
box.materials = [e3d.Material(texture=wood, metallic=0.0, roughness=0.5)]
scene.add(box, translation=(-0.8, 0.5, 0.0), rotation=e3d.linalg.euler_to_quaternion((0, 0.5, 0)))
ball = e3d.uv_sphere(0.6, (64, 32))
ball.materials = [e3d.Material(texture=tiles, metallic=0.0, roughness=0.3)]
scene.add(ball, translation=(0.8, 0.6, 0.0))
frame = e3d.render(scene, size=(480, 280))

"""
A normal map
============

This gives a flat wall the relief of bricks: a texture says which way the surface faces at each
place.

Red is the slope to the right and green the slope up, 128 is none. The bytes are numbers, so the
texture is linear.
"""

import numpy as np

import engine3d as e3d

rows, columns = np.indices((256, 256))
shifted = columns + 32 * (rows // 32 % 2)
edge = np.minimum(
    np.minimum(rows % 32, 31 - rows % 32), np.minimum(shifted % 64, 63 - shifted % 64)
)
height = np.clip(edge / 5.0, 0.0, 1.0)
down, right = np.gradient(height)
normals = np.stack([-4.0 * right, 4.0 * down, np.ones_like(height)], axis=-1)
normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
relief = e3d.Texture((127.5 + 127.5 * normals).astype(np.uint8), color_space="linear")

wall = e3d.primitives.quad((-2, 0, 0), (2, 0, 0), (2, 2.4, 0), (-2, 2.4, 0)).with_tangents()
wall.materials = [
    e3d.Material(color="firebrick", metallic=0.0, roughness=0.6, normal_texture=relief)
]
scene = e3d.Scene(background=(30, 32, 38), ambient=(90, 92, 98))
scene.add(wall)
scene.add(e3d.PointLight("cornsilk", 9.0), translation=(-1.2, 2.0, 0.9))
frame = e3d.render(scene, size=(480, 300))

"""
Texture filters
===============

This draws a floor that recedes through each filter. Without one, far squares flicker; mip levels
blur them; ``anisotropy=16`` keeps them sharp as far as the pixels allow.
"""

import numpy as np

import engine3d as e3d

board = (np.indices((64, 64)) // 32).sum(axis=0) % 2
pixels = np.where(board[..., np.newaxis], (236, 232, 222), (64, 84, 120)).astype(np.uint8)
textures = {
    "nearest": e3d.Texture(pixels, filter="nearest"),
    "trilinear": e3d.Texture(pixels),
    "anisotropy=16": e3d.Texture(pixels, anisotropy=16),
}
camera = e3d.PerspectiveCamera(0.5), e3d.look_at((0.0, 1.6, 20.0), (3.0, 0.0, 4.0))
strips = []
for texture in textures.values():
    floor = e3d.plane((160.0, 80.0))
    floor.uvs = floor.uvs * (64, 32)
    floor.materials = [e3d.Material(texture=texture)]
    scene = e3d.Scene(background=(190, 205, 222))
    scene.add(floor)
    strips.append(e3d.render(scene, camera, size=(450, 120), mode="unlit", samples=1).color)
picture = e3d.Canvas(np.vstack(strips))
for row, name in enumerate(textures):
    picture.text(8, 8 + 120 * row, name, "black")

"""
A shape that changes
====================

This blends a ball into a star by the weight of a morph target: for each vertex, how far it moves.
"""

import numpy as np

import engine3d as e3d

ball = e3d.icosphere(0.7, 5)
direction = ball.positions / np.linalg.norm(ball.positions, axis=1, keepdims=True)
bumps = np.prod(np.cos(4.0 * direction), axis=1)[:, np.newaxis]
ball.morph_targets = [e3d.motion.MorphTarget(0.9 * bumps * direction, name="star")]
ball.materials = [e3d.Material(color="orchid", metallic=0.0, roughness=0.3)]
scene = e3d.Scene()
node = scene.add(ball)
camera = e3d.PerspectiveCamera(0.6), e3d.look_at((2.1, 2.1, 5.0), (0.0, 0.0, 0.0))
tiles = []
for weight in (0.0, 0.4, 0.8):
    node.morph_weights = [weight]
    tiles.append(e3d.render(scene, camera, size=(160, 160)).color)
picture = e3d.Canvas(np.hstack(tiles))

"""
Wireframe
=========

This draws the edges of a mesh: over its faces, instead of them, and with those behind.
"""

import numpy as np

import engine3d as e3d

scene = e3d.Scene(background="white", ambient=(120, 124, 130))
scene.add(e3d.icosphere(1.0, 2))
scene.add(e3d.DirectionalLight((-0.5, -0.8, -0.6), "lightsteelblue", 2.2))
ways = (
    {"wireframe": "overlay"},
    {"wireframe": "only"},
    {"wireframe": "only", "hidden_lines": True},
)
tiles = [
    e3d.render(scene, size=(160, 160), line_color=(20, 40, 80), line_shape="round", **way).color
    for way in ways
]
picture = e3d.Canvas(np.hstack(tiles))

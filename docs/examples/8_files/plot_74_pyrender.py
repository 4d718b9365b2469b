"""
A program of pyrender
=====================

This runs lines that were written for pyrender. Only the import differs.

The page :doc:`/pyrender` tells what works and what differs.
"""

import numpy as np
from PIL import Image

import engine3d as e3d
import engine3d.compat.pyrender as pyrender

ring = e3d.torus(0.6, 0.25)
material = pyrender.MetallicRoughnessMaterial(
    baseColorFactor=(0.9, 0.5, 0.2, 1.0), metallicFactor=0.2, roughnessFactor=0.5
)
primitive = pyrender.Primitive(
    positions=ring.positions, normals=ring.normals, indices=ring.faces, material=material
)
scene = pyrender.Scene(bg_color=[0.9, 0.92, 0.95, 1.0], ambient_light=[0.3, 0.3, 0.3])
tilt = e3d.linalg.rotation_x(0.9)
scene.add(pyrender.Mesh([primitive]), pose=tilt)
scene.add(pyrender.PerspectiveCamera(yfov=0.7), pose=e3d.linalg.translation((0.0, 0.0, 3.0)))
scene.add(pyrender.DirectionalLight(color=np.ones(3), intensity=4.0), pose=np.eye(4))
renderer = pyrender.OffscreenRenderer(400, 300)
color, depth = renderer.render(scene)
renderer.delete()
picture = Image.fromarray(color)

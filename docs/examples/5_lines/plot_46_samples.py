"""
Edges with more samples
=======================

This enlarges the edges of a box four times, with 1, 4 and 16 samples. With one sample per pixel,
edges are steps. Multisampling tests several samples per pixel for what covers them, and shades
each surface once per pixel.
"""

import math

import numpy as np

import engine3d as e3d

scene = e3d.Scene(background=(250, 250, 250), ambient=(124, 124, 124))
scene.add(e3d.box(1.0), rotation=e3d.linalg.euler_to_quaternion((0.5, 0.6, 0.2)))
scene.add(e3d.DirectionalLight((-0.5, -0.8, -0.6), intensity=0.6 * math.pi))


def enlarged(samples):
    """The scene at a low resolution, each pixel as a square of four by four."""
    antialiasing = "msaa" if samples > 1 else "ssaa"
    frame = e3d.render(scene, size=(60, 60), samples=samples, antialiasing=antialiasing)
    return frame.color.repeat(4, axis=0).repeat(4, axis=1)


comparison = e3d.Canvas(np.hstack([enlarged(samples) for samples in (1, 4, 16)]))

"""
A turntable
===========

This writes an animation of a model that turns, as a GIF.

``orbit`` gives the poses of cameras around a target. The suffix of the file chooses the format:
GIF, WebP, APNG, MP4 or numbered pictures.
"""

from importlib.resources import files

import numpy as np

import engine3d as e3d

island = e3d.load(files("engine3d.data") / "models" / "island.obj")
camera = e3d.PerspectiveCamera(0.5)
target, size = island.bounds.mean(axis=0), np.ptp(island.bounds, axis=0)
turns = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
poses = e3d.orbit(target, 2.5 * size.max(), turns, 0.3)

look = e3d.Look.studio(background=(236, 234, 228))
frames = [e3d.render(island, (camera, pose), size=(240, 200), look=look) for pose in poses]
e3d.save_animation(frames, "turntable.gif", fps=6)

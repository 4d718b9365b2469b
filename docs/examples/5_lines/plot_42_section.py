"""
A section
=========

This cuts a hollow part open along a plane. The cut is hatched, and drawn from the front and
aslant.

``"x=50%"`` places the plane halfway; ``"-x=50%"`` takes away the other half.
"""

import numpy as np

import engine3d as e3d

STEPS = 64
profile = np.array([(0.5, -1.0), (1.2, -1.0), (1.2, -0.4), (0.8, -0.4), (0.8, 1.0), (0.5, 1.0)])
turn = 2.0 * np.pi * np.arange(STEPS) / STEPS
ring = np.stack([np.cos(turn), np.zeros(STEPS), np.sin(turn)], axis=-1)
positions = profile[:, np.newaxis, :1] * ring + profile[:, np.newaxis, 1:] * (0.0, 1.0, 0.0)
row = STEPS * np.arange(len(profile))[:, np.newaxis]
here, beside = row + np.arange(STEPS), row + np.roll(np.arange(STEPS), -1)
quads = np.stack([here, np.roll(here, -1, 0), np.roll(beside, -1, 0), beside], axis=-1)
sleeve = e3d.Mesh.from_polygons(positions.reshape(-1, 3), quads.reshape(-1, 4))
sheet = e3d.sheets.contact_sheet(sleeve, views="top", sections="x=50%", size=(640, 400), unit="mm")
picture = sheet.picture

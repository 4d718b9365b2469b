"""
Colours of vertices
===================

This gives every vertex of a mesh a colour of its own; triangles blend between them.

Floats from 0 to 1 and whole numbers from 0 to 255 are display values, as in matplotlib.
"""

import engine3d as e3d

knot = e3d.torus(1.0, 0.4, (96, 48))
low, high = knot.bounds
knot.colors = (knot.positions - low) / (high - low)  # red along x, green along y, blue along z
frame = e3d.render(knot, size=(420, 280))

"""Meshes of simple shapes, centred on the origin, Y up, counter-clockwise seen from outside.

Each has unit normals, texture coordinates (origin bottom-left) and an edge mask that hides the
diagonals of its quads in wireframe. All default to about a unit cube's size.
"""

from .flat import box, hexahedron, plane, quad
from .icosphere import icosphere
from .round import cylinder, torus, uv_sphere

__all__ = ["box", "cylinder", "hexahedron", "icosphere", "plane", "quad", "torus", "uv_sphere"]

"""What of a mesh a format cannot hold, in the words of a warning."""

from __future__ import annotations

import numpy as np

from ..colors import linear_color
from ..mesh import Mesh

_NAMES = {
    "uvs": "texture coordinates",
    "colors": "vertex colours",
    "lines": "lines",
    "points": "points",
}


def lost_parts(mesh: Mesh, *parts: str) -> list[str]:
    """Return words for those parts that the mesh has."""
    lost = []
    for part in parts:
        if part == "materials":
            lost += ["materials"] if any(map(_says_something, mesh.materials)) else []
        else:
            array = getattr(mesh, part)
            lost += [_NAMES[part]] if array is not None and len(array) else []
    return lost


def _says_something(material) -> bool:
    is_white = np.array_equal(linear_color(material.color), (1, 1, 1))
    return not is_white or material.texture is not None

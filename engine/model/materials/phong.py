"""Highlights of Blinn and Phong as those of physically based materials."""

from __future__ import annotations

import math

from .colors import linear_color
from .material import Material


def roughness_of(material: Material) -> float | None:
    """Return the roughness whose GGX highlight is about as wide as a Blinn highlight.

    None for a material without one.
    """
    if not linear_color(material.specular).any():
        return None
    return math.sqrt(math.sqrt(2.0 / (material.shininess + 2.0)))

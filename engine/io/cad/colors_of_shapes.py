"""Colours as Open CASCADE holds them: linear light, and alpha.

In: a ``Quantity_ColorRGBA``. Out: its components, and a material.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from ...model.materials.linear_colors import LinearColor
from ...model.materials.material import Material

#: Red, green, blue as linear light, and alpha.
Components: TypeAlias = tuple[float, float, float, float]


def components_of(color: Any) -> Components:
    """Return the components of a ``Quantity_ColorRGBA``."""
    light = color.GetRGB()
    return light.Red(), light.Green(), light.Blue(), color.Alpha()


def color_material(color: Components | None) -> Material:
    """Return a material of a colour; None gives one that states nothing."""
    if color is None:
        return Material()
    return Material(
        color=LinearColor(color), alpha_mode="opaque" if color[3] >= 1.0 else "blend", name="color"
    )

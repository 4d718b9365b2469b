"""The fields of lights: colour, strength, size, shadow. Their nodes' rotations turn them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import get_args

from .....choices import Falloff, LightShadow
from .....model.scene.lights import DirectionalLight, Light
from ...new_things.adding import AREA_SIZES
from ..translated_imgui import imgui
from ..workspace import Workspace
from .fields import Fields, name_of

_COLORS = {"sky_color": "Sky", "ground_color": "Ground", "color": "Colour"}
_ANGLES = {"inner_cone_angle": "Inner cone, °", "outer_cone_angle": "Outer cone, °"}
_CHOICES = {"shadow": ("Shadow", LightShadow), "falloff": ("Falloff", Falloff)}
_DEGREES = math.degrees(1.0)
_LEAST = 1e-3
_WIDEST = 90.0  # degrees


def draw_lights(workspace: Workspace, fields: Fields, lights: Sequence[Light]) -> None:
    """Lay out what all of some lights have."""
    if not fields.folder("Light"):
        return
    for name, label in _COLORS.items():
        if _have(lights, name):
            fields.color(lights, name, label)
    if _have(lights, "intensity"):  # by a hundredth of it
        fields.number(lights, "intensity", "Intensity", 0.01 * max(lights[-1].intensity, 1.0), 0.0)
    for name in AREA_SIZES:
        if _have(lights, name):
            speed = 0.01 * max(getattr(lights[-1], name), 0.1)
            fields.number(lights, name, name.capitalize(), speed, _LEAST)
    for name, label in _ANGLES.items():
        if _have(lights, name):
            fields.number(lights, name, label, 0.25, 0.0, _WIDEST, _DEGREES)
    for name in _CHOICES:
        if _have(lights, name):
            _draw_choice(fields, lights, name)
    _draw_softness(fields, lights)
    if _have(lights, "range"):
        _draw_range(workspace, fields, lights)
    if _have(lights, "direction"):
        _draw_direction(fields, lights)


def _have(lights: Sequence[Light], name: str) -> bool:
    return all(hasattr(light, name) for light in lights)


def _draw_choice(fields: Fields, lights: Sequence[Light], name: str) -> None:
    label, kind = _CHOICES[name]
    now = name_of(getattr(light, name) for light in lights)
    options = get_args(kind)
    if name == "falloff" and not all(math.isfinite(light.range) for light in lights):
        options = tuple(option for option in options if option != "window")  # needs a range
    chosen = fields.choice(label, now, [(option, option) for option in options], name)
    if chosen is not None and chosen != now:
        fields.set(lights, {name: chosen})


def _draw_softness(fields: Fields, lights: Sequence[Light]) -> None:
    """Lay out how large lights are for the shadows they cast; area lights have sizes instead."""
    if not _have(lights, "shadow_softness") or any(_have([light], "area") for light in lights):
        return
    if all(light.shadow == "none" for light in lights):
        return
    if all(isinstance(light, DirectionalLight) for light in lights):
        fields.number(lights, "shadow_softness", "Sun's size, °", 0.05, 0.0, _WIDEST, _DEGREES)
    elif not any(isinstance(light, DirectionalLight) for light in lights):
        fields.number(lights, "shadow_softness", "Lamp's radius", 0.005, 0.0)


def _draw_range(workspace: Workspace, fields: Fields, lights: Sequence[Light]) -> None:
    """Lay out the range of lights; an infinite one gets the scene's size."""
    finite = [math.isfinite(light.range) for light in lights]
    if all(finite):
        fields.number(lights, "range", "Range", 0.1, _LEAST)
    # A window falloff ends at the range, so it needs one.
    needs = any(getattr(light, "falloff", None) == "window" for light in lights)
    imgui.begin_disabled(needs)
    changed, endless = fields.checkbox("Infinite range", [not each for each in finite])
    imgui.end_disabled()
    if changed:
        reach = math.inf if endless else max(2.0 * workspace.bounds.radius, _LEAST)
        fields.set(lights, {"range": reach})


def _draw_direction(fields: Fields, lights: Sequence[Light]) -> None:
    with fields.fold("Details") as is_open:
        if is_open:
            fields.note("The rotation turns this direction:")
            fields.vector(lights, "direction", "Direction", 0.01)

"""The property fields of a scene's fog.

In: a scene. Out: a new fog for it, since fog is immutable; drags are identified by field numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ....base.language import translated_choice
from ....model.materials.display_colors import display_color
from ....model.scene.fog import ExponentialFog, Fog
from ....model.scene.scene import Scene
from ....stage.chosen_surroundings import fog_color
from .translated_imgui import imgui

_KINDS = {type(None): "none", Fog: "linear", ExponentialFog: "exponential"}
_LEAST = 1e-4  # between near and far
_LABELS = {"near": "Fog near", "far": "Fog far", "density": "Fog density"}


def draw_fog(
    scene: Scene,
    radius: float,
    assign: Callable[[Fog | ExponentialFog | None], None],
    follow_drag: Callable[[], None],
) -> None:
    """Lay out the kind of fog and its parameters.

    Parameters
    ----------
    scene : Scene
    radius : float
        Of what the scene shows: a new fog hides what lies so many times as far away.
    assign : callable
        Called with the fog that is to be the scene's.
    follow_drag : callable
        Called after each field that can be dragged.
    """
    now = scene.fog
    if imgui.begin_combo("Fog", translated_choice("fog", _KINDS[type(now)])):
        for kind, name in _KINDS.items():
            chosen = imgui.selectable(translated_choice("fog", name), isinstance(now, kind))[0]
            if chosen and not isinstance(now, kind):
                assign(_new_fog(kind, scene, radius))
        imgui.end_combo()
    if now is None:
        return
    changed, color = imgui.color_edit3("Fog colour", list(display_color(now.color, "srgb")))
    follow_drag()
    if changed:
        assign(replace(now, color=tuple(round(255 * part) for part in color)))
    for name, value in _numbers_of(now).items():
        speed = max(abs(value) * 0.01, 1e-5)
        changed, number = imgui.drag_float(_LABELS[name], value, speed, 0.0, 1e9, "%.4g")
        follow_drag()
        if changed:
            assign(_with(now, name, max(number, 0.0)))


def _numbers_of(fog: Fog | ExponentialFog) -> dict[str, float]:
    if isinstance(fog, Fog):
        return {"near": fog.near, "far": fog.far}
    return {"density": fog.density}


def _with(fog: Fog | ExponentialFog, name: str, value: float) -> Fog | ExponentialFog:
    """Return a fog with one number changed; near and far push each other."""
    if name == "near":
        return replace(fog, near=value, far=max(fog.far, value + max(_LEAST, value * _LEAST)))
    if name == "far":
        far = max(value, _LEAST)
        return replace(fog, far=far, near=min(fog.near, far - max(_LEAST, far * _LEAST)))
    return replace(fog, density=value)


def _new_fog(kind: type, scene: Scene, radius: float) -> Fog | ExponentialFog | None:
    """Return the initial fog of a scene: dense behind it, seen from nearby."""
    color = fog_color(scene.background) or (200, 205, 212)
    reach = max(radius, _LEAST)
    if kind is Fog:
        return Fog(color, reach, 6.0 * reach)
    return ExponentialFog(color, 0.25 / reach) if kind is ExponentialFog else None

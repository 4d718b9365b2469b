"""The property fields of a scene's fog.

In: a scene. Out: a new fog for it, since fog is immutable.
"""

from __future__ import annotations

from dataclasses import replace

from .....model.scene.fog import ExponentialFog, Fog
from .....model.scene.scene import Scene
from .....stage.chosen_surroundings import fog_color
from .fields import Fields

KINDS = {type(None): "none", Fog: "linear", ExponentialFog: "exponential"}
_LEAST = 1e-4  # between near and far
_LABELS = {"near": "Near", "far": "Far", "density": "Density"}


def draw_fog(fields: Fields, scene: Scene, radius: float) -> None:
    """Lay out the kind of fog and its parameters.

    Parameters
    ----------
    fields : Fields
    scene : Scene
    radius : float
        Of what the scene shows: a new fog hides what lies so many times as far away.
    """
    now = scene.fog
    options = [(name, kind) for kind, name in KINDS.items()]
    chosen = fields.choice("Kind", KINDS[type(now)], options, "fog")
    if chosen is not None and not isinstance(now, chosen):
        fields.set([scene], {"fog": _new_fog(chosen, scene, radius)})
    if now is None:
        return
    color = fields.new_color("Colour", now.color)
    if color is not None:
        fields.drag([(scene, {"fog": replace(now, color=color)})])
    for name, value in _numbers_of(now).items():
        speed = max(abs(value) * 0.01, 1e-5)
        changed = fields.numbers(_LABELS[name], [[value]], speed, low=0.0)
        if changed is not None:
            fields.drag([(scene, {"fog": _with(now, name, changed[0])})])


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

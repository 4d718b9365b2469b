"""The objects of nodes besides meshes in scene files: kinds of lights and cameras.

In: a light or camera, or a kind with values. Out: the values that differ from the defaults, or the
object. The values are the parameters of the class, so that the format follows the classes.
"""

from __future__ import annotations

import functools
import inspect
import math
from typing import Any

import numpy as np

from ...model.scene.ambient_lights import HemisphereLight, LightProbe
from ...model.scene.cameras import Camera, IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from ...model.scene.lights import DIRECT_LIGHTS

KINDS: dict[str, type] = {
    **{f"{name} light": light for name, light in DIRECT_LIGHTS.items()},
    "hemisphere light": HemisphereLight,
    "light probe": LightProbe,
    "perspective camera": PerspectiveCamera,
    "orthographic camera": OrthographicCamera,
    "intrinsics camera": IntrinsicsCamera,
    "camera": Camera,
}
# Parameters stored under another name.
_HELD: dict[tuple[type, str], str] = {(Camera, "projection"): "matrix"}


def kind_of(obj: Any) -> str | None:
    """Return the kind of a light or camera; None if files cannot express it."""
    return next((kind for kind, cls in KINDS.items() if type(obj) is cls), None)


@functools.cache
def parameters(cls: type) -> dict[str, Any]:
    """Return the parameters of a class and their defaults (`inspect.Parameter.empty`: none)."""
    found = inspect.signature(cls).parameters
    return {name: parameter.default for name, parameter in found.items()}


def values_of(obj: Any) -> dict[str, Any]:
    """Return an object's parameters that differ from their defaults, as JSON."""
    found = {}
    kind: type = type(obj)
    for name, default in parameters(kind).items():
        value = plain(getattr(obj, _HELD.get((kind, name), name)))
        if value != plain(default):
            found[name] = value
    return found


def plain(value: Any) -> Any:
    """Convert a value to JSON types: arrays to lists, infinity to None."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        return value.item()
    return None if isinstance(value, float) and math.isinf(value) else value

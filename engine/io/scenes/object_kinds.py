"""The objects of nodes besides meshes, as scene files name them: kinds of lights and cameras.

In: a light or camera, or a kind with values. Out: the values that differ from those by default, or
the object. The values are the parameters of the class, so that files follow what a class gets.
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
# Where a parameter is kept under another name.
_HELD: dict[tuple[type, str], str] = {(Camera, "projection"): "matrix"}


def kind_of(obj: Any) -> str | None:
    """Return the kind of a light or a camera; None where files have no word for it."""
    return next((kind for kind, cls in KINDS.items() if type(obj) is cls), None)


@functools.cache
def parameters(cls: type) -> dict[str, Any]:
    """Return the parameters of a class and their defaults (`inspect.Parameter.empty`: none)."""
    found = inspect.signature(cls).parameters
    return {name: parameter.default for name, parameter in found.items()}


def values_of(obj: Any) -> dict[str, Any]:
    """Return what an object is made of, as JSON knows it, but for what is so by default."""
    found = {}
    kind: type = type(obj)
    for name, default in parameters(kind).items():
        value = plain(getattr(obj, _HELD.get((kind, name), name)))
        if value != plain(default):
            found[name] = value
    return found


def plain(value: Any) -> Any:
    """Return a value in types that JSON knows: arrays as lists, infinity as None."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        return value.item()
    return None if isinstance(value, float) and math.isinf(value) else value

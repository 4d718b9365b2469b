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

from ...model.materials.colors import is_8bit, linear_color, split_alpha
from ...model.materials.linear_colors import LinearColor
from ...model.scene.ambient_lights import HemisphereLight, LightProbe
from ...model.scene.cameras import Camera, IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from ...model.scene.lenses.brown_conrady_camera import BrownConradyCamera
from ...model.scene.lenses.double_sphere_camera import DoubleSphereCamera
from ...model.scene.lenses.fisheye_camera import FisheyeCamera
from ...model.scene.lenses.panorama_cameras import CylindricalCamera, EquirectangularCamera
from ...model.scene.lights import DIRECT_LIGHTS

KINDS: dict[str, type] = {
    **{f"{name} light": light for name, light in DIRECT_LIGHTS.items()},
    "hemisphere light": HemisphereLight,
    "light probe": LightProbe,
    "perspective camera": PerspectiveCamera,
    "orthographic camera": OrthographicCamera,
    "intrinsics camera": IntrinsicsCamera,
    "fisheye camera": FisheyeCamera,
    "brown-conrady camera": BrownConradyCamera,
    "double-sphere camera": DoubleSphereCamera,
    "equirectangular camera": EquirectangularCamera,
    "cylindrical camera": CylindricalCamera,
    "camera": Camera,
}
_COLORS = {"ambient", "background", "bottom", "color", "emissive", "specular", "top"}
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
        value = written(name, getattr(obj, _HELD.get((kind, name), name)))
        if value != written(name, default):
            found[name] = value
    return found


def written(name: str, value: Any) -> Any:
    """Return an attribute's value as JSON; the floats of colours are linear light."""
    is_color = name in _COLORS or name.endswith("_color")
    return _color(value) if is_color and isinstance(value, tuple) else plain(value)


def plain(value: Any) -> Any:
    """Convert a value to JSON types: arrays to lists, infinity to None."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        return value.item()
    return None if isinstance(value, float) and math.isinf(value) else value


def _color(value: Any) -> list[Any]:
    """Return a colour as files have it: 8-bit values, or floats of linear light."""
    is_same = isinstance(value, LinearColor) or all(part in (0, 1) for part in value)
    if is_same and np.uint8 not in map(type, value):
        return list(value)
    if is_8bit(value) and max(value) > 1:
        return [int(part) for part in value]
    rgb, alpha = split_alpha(value)
    return [*linear_color(rgb).tolist(), *([alpha] if len(value) == 4 else [])]

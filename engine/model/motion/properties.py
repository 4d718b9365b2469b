"""Properties that clips can animate besides poses: of materials, cameras, lights and some of nodes.

In: an object and a property's name; numbers. Out: the property's current numbers; the property set
to the nearest numbers it allows.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple, NoReturn, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.validation import choose
from ...choices import Interpolation
from ...errors import InvalidArgumentError
from ..materials.colors import eight_bit_or_linear, linear_color, linear_rows
from ..materials.linear_colors import LinearColor, is_linear, marked
from ..materials.material import PARAMETERS, TEXTURE_SLOTS, Material
from ..materials.textures import PlacedTexture, Texture
from ..scene.cameras import OrthographicCamera, PerspectiveCamera
from ..scene.lights import DIRECT_LIGHTS
from ..scene.nodes import Node
from .keys import INTERPOLATIONS, Keyed, check_times, frozen_or_copied

_LEAST = 1e-9  # for numbers that must be greater than 0
_WIDEST = math.pi - 1e-6


class Range(NamedTuple):
    """The values that a property allows.

    Attributes
    ----------
    low, high : float
    width : int
        How many numbers a value has.
    is_kept : bool
        Whether values are clamped to the range of the keys, which splines may exceed: another
        property limits this one.
    is_color : bool
    apart : float, optional
        A number below the range that is allowed, too.
    """

    low: float = -math.inf
    high: float = math.inf
    width: int = 1
    is_kept: bool = False
    is_color: bool = False
    apart: float | None = None

    def nearest(self, numbers: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the nearest numbers that are allowed."""
        inside = np.minimum(np.maximum(numbers, self.low), self.high)
        if self.apart is None:
            return inside
        return np.where(numbers < (self.apart + self.low) / 2, self.apart, inside)


_POSITIVE, _COLOR = Range(0.0), Range(0.0, width=3, is_color=True)
_DEPTH = Range(_LEAST, is_kept=True)
_CONE = Range(0.0, math.pi / 2, is_kept=True)
_LIGHT = {  # the properties of all light kinds
    "color": _COLOR,
    "intensity": _POSITIVE,
    "range": Range(_LEAST),
    "inner_cone_angle": _CONE,
    "outer_cone_angle": _CONE,
}
_PLACES = {"offset": Range(width=2), "rotation": Range(), "scale": Range(width=2)}
_PROPERTIES: dict[type, dict[str, Range]] = {
    Material: {
        **{
            name: Range(
                row.kind.low,
                row.kind.high,
                row.kind.width,
                is_color=row.kind.is_color,
                apart=row.kind.apart,
            )
            for name, row in PARAMETERS.items()
            if row.kind.width
        },
        **{f"{slot}.{name}": held for slot in TEXTURE_SLOTS for name, held in _PLACES.items()},
    },
    PerspectiveCamera: {"yfov": Range(1e-6, _WIDEST), "znear": _DEPTH, "zfar": _DEPTH},
    OrthographicCamera: {
        "ymag": Range(_LEAST),
        "znear": Range(is_kept=True),
        "zfar": Range(is_kept=True),
    },
    **{
        light: {name: held for name, held in _LIGHT.items() if hasattr(light, name)}
        for light in DIRECT_LIGHTS.values()
    },
}
_WEIGHT = "weights."


class Property(NamedTuple):
    """A property of an object; several channels may name it.

    Attributes
    ----------
    target : Node, Material, camera or light
    path : str
    """

    target: Any
    path: str

    def held(self) -> Any:
        """Return the property's value."""
        name = self.path.partition(".")[0]
        return getattr(self.target, "morph_weights" if name == "weights" else name)

    def numbers(self) -> NDArray[np.float64]:
        """Return the value as numbers, colours in linear light."""
        target, path = self.target, self.path
        if path.startswith(_WEIGHT):
            weights, number = self.held(), int(path[len(_WEIGHT) :])
            return np.array([0.0 if weights is None else weights[number]])
        if path == "color" and isinstance(target, Material):
            return np.array([*linear_color(target.rgb), target.alpha], np.float64)
        slot, _, place = path.partition(".")
        value = getattr(_placed(getattr(target, slot)), place) if place else self.held()
        if isinstance(value, tuple) and not place:
            return linear_color(value).astype(np.float64)
        if value is None:
            return np.ones(1)  # metallic or roughness, if only the other one is set
        return np.array(value, np.float64).reshape(-1)

    def put(self, numbers: NDArray[np.float64]) -> None:
        """Set the property."""
        target, path, limits = self.target, self.path, range_of(self.target, self.path)
        numbers = limits.nearest(numbers)
        if path == "color" and limits.width == 4:
            numbers[3] = min(numbers[3], 1.0)
        values = tuple(numbers.tolist())
        if path == "visible":
            self.restore(values[0] >= 0.5)
        elif path.startswith(_WEIGHT):
            self._put_weight(values[0])
        elif "." in path:
            slot, _, name = path.partition(".")
            moved: dict[str, Any] = {name: values if limits.width > 1 else values[0]}
            self._set(slot, replace(_placed(getattr(target, slot)), **moved))
        else:
            self._set(path, LinearColor(values) if limits.is_color else values[0])

    def restore(self, held: Any) -> None:
        """Restore the property's earlier value."""
        name = self.path.partition(".")[0]
        self._set("morph_weights" if name == "weights" else name, held)

    def _set(self, name: str, value: Any) -> None:
        before = getattr(self.target, name)
        if type(before) is type(value) and np.array_equal(before, value):
            return  # renderers rebuild only what changes
        setattr(self.target, name, value)

    def _put_weight(self, value: float) -> None:
        held, number = self.held(), int(self.path[len(_WEIGHT) :])
        count = len(getattr(self.target.object, "morph_targets", ()))
        if number < count:
            weights = np.zeros(count) if held is None else np.array(held)
            weights[number] = value
            self.target.morph_weights = weights


def range_of(target: Any, path: str) -> Range:
    """Return the range of an object's property.

    Raises
    ------
    InvalidArgumentError
        Clips cannot animate this object or property.
    """
    if isinstance(target, Node):
        number = path[len(_WEIGHT) :] if isinstance(path, str) and path.startswith(_WEIGHT) else ""
        count = len(getattr(target.object, "morph_targets", ()))
        if number.isdecimal() and len(number) < 9 and int(number) < count:
            return Range()
        choose(path, ("visible",), "path")
        return Range(0.0, 1.0)
    kind = next((kind for kind in _PROPERTIES if isinstance(target, kind)), None)
    if kind is None:
        name = type(target).__name__
        raise InvalidArgumentError(f"target must be a Node, Material, camera or light, not {name}")
    choose(path, tuple(_PROPERTIES[kind]), "path")
    slot, _, place = path.partition(".")
    if place and not isinstance(getattr(target, slot), (Texture, PlacedTexture)):
        raise InvalidArgumentError(f"the material has no {slot}")
    return _PROPERTIES[kind][path]


def _placed(held: Texture | PlacedTexture) -> PlacedTexture:
    return held if isinstance(held, PlacedTexture) else PlacedTexture(held)


class PropertyChannel(Keyed):
    """Keys of a property of a material, camera, light or node; immutable.

    Parameters
    ----------
    target : Material, PerspectiveCamera, OrthographicCamera, Node or a light
    path : str
        The attribute. Materials and lights: any number or colour, such as ``"roughness"`` (a
        material's ``"color"`` has four numbers), and a texture's transform, such as
        ``"normal_texture.offset"``, ``".rotation"`` or ``".scale"``. Cameras: ``"yfov"`` or
        ``"ymag"``, ``"znear"``, ``"zfar"``. Nodes: ``"visible"`` (true from 0.5 on), and single
        morph weights, ``"weights.0"``. Colours change in linear light.
    times : (K,) float
        As in `Channel`.
    values : (K, N) float, or (K, 3, N) for splines
        N is how many numbers a value has. Values of a spline outside the property's range are
        clamped. Colours are as those of `Mesh`, names too; those of splines are ``linear(values)``.
    interpolation : {"linear", "step", "cubicspline"}

    Raises
    ------
    InvalidArgumentError
        There is no such property, or as in `Channel`.
    """

    def __init__(
        self,
        target: Any,
        path: str,
        times: ArrayLike,
        values: ArrayLike,
        interpolation: Interpolation = "linear",
    ) -> None:
        limits = range_of(target, path)
        self._property = Property(target, path)
        self._interpolation = choose(interpolation, INTERPOLATIONS, "interpolation")
        self._times = check_times(times)
        middle = (3,) if interpolation == "cubicspline" else ()
        shape = (len(self._times), *middle, limits.width)
        self._values = (_colors if limits.is_color else _checked)(values, shape, path)
        keys = self._values[:, 1] if middle else self._values
        self._hull = (keys.min(axis=0), keys.max(axis=0)) if limits.is_kept else None

    @property
    def target(self) -> Any:
        return self._property.target

    @property
    def path(self) -> str:
        return self._property.path

    @property
    def reach(self) -> tuple[float, float]:
        """The smallest and largest number of all keys."""
        keys = self._values[:, 1] if self._interpolation == "cubicspline" else self._values
        return float(keys.min()), float(keys.max())

    def _within(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Clamp a value to the range of the keys, if the property requires it."""
        if self._hull is None:
            return values
        return np.minimum(np.maximum(values, self._hull[0]), self._hull[1])

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a PropertyChannel belongs to what it changes: it cannot be copied")

    def __repr__(self) -> str:
        return f"PropertyChannel({self.target!r}, {self.path!r}, {len(self._times)} keys)"


def _checked(value: ArrayLike, shape: tuple[int, ...], path: str) -> NDArray[np.float64]:
    values = frozen_or_copied(value, "values")
    if values.shape != shape:
        raise InvalidArgumentError(f"values of {path} must be {shape}, not {values.shape}")
    if not np.isfinite(values).all():
        raise InvalidArgumentError("values must be finite")
    return values


def _colors(value: ArrayLike, shape: tuple[int, ...], path: str) -> NDArray[np.float64]:
    """Return checked colours in linear light, marked as such."""
    if not is_linear(value):
        if len(shape) > 2:
            raise InvalidArgumentError(f"splines of {path} are in linear light: linear(values)")
        colors = eight_bit_or_linear(value, "values")
        value = linear_rows(colors)[..., : max(shape[-1], 3)] if colors.ndim == 2 else colors
    return marked(_checked(value, shape, path))

"""Lights: plain data that a scene's nodes place in the world.

A light has a colour (floats are linear light, 8-bit integers sRGB) times an intensity. Directional
lights shine along their node's rotated ``direction``, point lights from their node's origin, spot
lights from there along its -Z. docs/exactness.md, sections 9 and 12, has the formulas;
docs/conventions.md says in which units intensities are.
"""

from __future__ import annotations

import math
from typing import TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._support.numbers import real, shown
from .._support.validation import (
    CheckedAttribute,
    ColorAttribute,
    NumberAttribute,
    VectorAttribute,
    not_negative,
    one_of,
    vector3,
)
from ..choices import ColorLike, Falloff, LightUnit
from ..errors import InvalidArgumentError
from ..linalg import cos
from ..materials.colors import check_color
from ._placed_by_node import PlacedByNode
from .ambient_lights import AMBIENT_LIGHTS, HemisphereLight, LightProbe

FALLOFFS: tuple[Falloff, ...] = get_args(Falloff)
UNITS: tuple[LightUnit, ...] = get_args(LightUnit)

UnitAttribute: TypeAlias = CheckedAttribute[LightUnit, LightUnit]


def _direction(value: ArrayLike, what: str) -> NDArray[np.float64]:
    direction = vector3(value, what)
    if not direction.any():
        raise InvalidArgumentError(f"{what} must not be the zero vector")
    return direction


def _range(value: float, what: str) -> float:
    number = real(value)
    if not number > 0:
        raise InvalidArgumentError(f"{what} must be greater than 0, not {shown(value)}")
    return number


def _angle(value: float, what: str) -> float:
    number = real(value)
    if not 0 <= number <= math.pi / 2:
        raise InvalidArgumentError(f"{what} must be a number from 0 to pi/2, not {shown(value)}")
    return number


class DirectionalLight(PlacedByNode):
    """A light infinitely far away, such as the sun.

    Parameters
    ----------
    direction : (3,) float
        The way the light travels, in the space of its node; of any length but zero.
    color : sequence of 3 numbers
    intensity : float
        Multiplies the colour; a white surface that faces the light gets ``color * intensity``. Of
        physical materials it is in lux: such a surface shows it over pi.
    unit : {"photometric", "white"}
        With ``"white"``, physical materials take the intensity as the others do.

    Attributes
    ----------
    version : int
        Grows with every assignment.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    direction: VectorAttribute = CheckedAttribute(_direction)
    color: ColorAttribute = CheckedAttribute(check_color)
    intensity: NumberAttribute = CheckedAttribute(not_negative)
    unit: UnitAttribute = CheckedAttribute(one_of(UNITS))

    def __init__(
        self,
        direction: ArrayLike = (0, 0, -1),
        color: ColorLike = (1, 1, 1),
        intensity: float = 1.0,
        unit: LightUnit = "photometric",
    ) -> None:
        self.direction = direction
        self.color = color
        self.intensity = intensity
        self.unit = unit

    def __repr__(self) -> str:
        direction = tuple(self.direction.tolist())
        return f"DirectionalLight({direction}, color={self.color}, intensity={self.intensity:g})"


class PointLight(PlacedByNode):
    """A light that shines from one point in all directions.

    Parameters
    ----------
    color : sequence of 3 numbers
    intensity : float
        As for `DirectionalLight`; at distance 1 but with ``"window"``. Of physical materials it is
        in candela.
    range : float
        World units; the light adds exactly nothing from this distance on. May be infinite but with
        ``"window"``.
    falloff : {"inverse_square", "window", "gltf"}
        Attenuation at distance d: ``1 / d**2``, or ``(1 - d**2 / range**2)**2``, or, as
        KHR_lights_punctual has it, ``(1 - (d / range)**4) / d**2``.
    unit : {"photometric", "white"}
        As for `DirectionalLight`.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    color: ColorAttribute = CheckedAttribute(check_color)
    intensity: NumberAttribute = CheckedAttribute(not_negative)
    unit: UnitAttribute = CheckedAttribute(one_of(UNITS))
    range: NumberAttribute = CheckedAttribute(_range)
    falloff: CheckedAttribute[Falloff, Falloff] = CheckedAttribute(one_of(FALLOFFS))

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = 1.0,
        range: float = math.inf,
        falloff: Falloff = "inverse_square",
        unit: LightUnit = "photometric",
    ) -> None:
        self.color = color
        self.intensity = intensity
        self.range = range
        self.falloff = falloff
        self.unit = unit
        self.check()

    def check(self) -> None:
        """Raise unless ``range`` and ``falloff`` go together."""
        if self.falloff == "window" and math.isinf(self.range):
            raise InvalidArgumentError("falloff 'window' needs a finite range")

    def __repr__(self) -> str:
        return (
            f"PointLight(color={self.color}, intensity={self.intensity:g}, range={self.range:g}, "
            f"falloff={self.falloff!r})"
        )


class SpotLight(PlacedByNode):
    """A light that shines from one point into a cone, along the -Z of its node.

    As KHR_lights_punctual has it: all of it inside of the inner cone, nothing outside of the outer
    one, and in between the square of how far the cosine of the angle has come. Attenuation at
    distance d is ``(1 - (d / range)**4) / d**2``.

    Parameters
    ----------
    color : sequence of 3 numbers
    intensity : float
        As for `PointLight`, along the axis.
    range : float
        World units; the light adds exactly nothing from this distance on. May be infinite.
    inner_cone_angle, outer_cone_angle : float
        Radians from the axis: 0 <= inner < outer <= pi/2.
    unit : {"photometric", "white"}
        As for `DirectionalLight`.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    color: ColorAttribute = CheckedAttribute(check_color)
    intensity: NumberAttribute = CheckedAttribute(not_negative)
    unit: UnitAttribute = CheckedAttribute(one_of(UNITS))
    range: NumberAttribute = CheckedAttribute(_range)
    inner_cone_angle: NumberAttribute = CheckedAttribute(_angle)
    outer_cone_angle: NumberAttribute = CheckedAttribute(_angle)

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = 1.0,
        range: float = math.inf,
        inner_cone_angle: float = 0.0,
        outer_cone_angle: float = math.pi / 4,
        unit: LightUnit = "photometric",
    ) -> None:
        self.color = color
        self.intensity = intensity
        self.range = range
        self.inner_cone_angle = inner_cone_angle
        self.outer_cone_angle = outer_cone_angle
        self.unit = unit
        self.check()

    def check(self) -> None:
        """Raise unless the inner cone is narrower than the outer one."""
        if not self.inner_cone_angle < self.outer_cone_angle:
            raise InvalidArgumentError(
                f"inner_cone_angle must be less than outer_cone_angle, {self.outer_cone_angle:g}, "
                f"not {self.inner_cone_angle:g}"
            )

    def cone(self) -> tuple[float, float]:
        """Return the cosine of the outer angle, and 1 over what the inner one's is more."""
        inner, outer = cos(self.inner_cone_angle), cos(self.outer_cone_angle)
        return outer, 1.0 / max(0.001, inner - outer)

    def __repr__(self) -> str:
        return (
            f"SpotLight(color={self.color}, intensity={self.intensity:g}, range={self.range:g}, "
            f"inner_cone_angle={self.inner_cone_angle:g}, "
            f"outer_cone_angle={self.outer_cone_angle:g})"
        )


LIGHTS = (DirectionalLight, PointLight, SpotLight, *AMBIENT_LIGHTS)
Light: TypeAlias = DirectionalLight | PointLight | SpotLight | HemisphereLight | LightProbe

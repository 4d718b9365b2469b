"""The shadow parameters of all lights, named as in three.js."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeAlias, get_args

from ...base.numbers import shown
from ...base.validation import (
    CheckedAttribute,
    Closed,
    NumberAttribute,
    finite,
    not_negative,
    one_of,
    whole_number,
)
from ...choices import LightShadow, ShadowTaps
from ...errors import InvalidArgumentError

SHADOWS: tuple[LightShadow, ...] = get_args(LightShadow)
TAPS: tuple[ShadowTaps, ...] = get_args(ShadowTaps)
LEAST_MAP, MOST_MAP = 32, 8192
MOST_RADIUS = 64.0  # texels, of the lookups of soft shadows

ShadowAttribute: TypeAlias = CheckedAttribute[LightShadow, LightShadow]
TapsAttribute: TypeAlias = CheckedAttribute[ShadowTaps, ShadowTaps]
CountAttribute: TypeAlias = CheckedAttribute[int, int]


def count_of(least: int, most: int) -> Callable[[int, str], int]:
    """Return a check for whole numbers in a range."""
    return lambda value, what: whole_number(value, what, least, most)


def _radius(value: float, what: str) -> float:
    number = not_negative(value, what)
    if number > 16:
        raise InvalidArgumentError(f"{what} must be at most 16 texels, not {shown(value)}")
    return number


class CastsShadows(Closed):
    """Base of lights: their shadow parameters."""

    version: int
    shadow: ShadowAttribute = CheckedAttribute(one_of(SHADOWS))
    shadow_map_size: CountAttribute = CheckedAttribute(count_of(LEAST_MAP, MOST_MAP))
    shadow_bias: NumberAttribute = CheckedAttribute(finite)
    shadow_normal_bias: NumberAttribute = CheckedAttribute(finite)
    shadow_radius: NumberAttribute = CheckedAttribute(_radius)
    shadow_taps: TapsAttribute = CheckedAttribute(one_of(TAPS))
    shadow_softness: NumberAttribute = CheckedAttribute(not_negative)

    def _keep(self, arguments: dict[str, Any]) -> None:
        """Store the arguments of a constructor as attributes of the same names."""
        for name, value in arguments.items():
            if name != "self":
                setattr(self, name, value)

    def _check_shadow(self) -> None:
        """Raise unless the comparisons around a sample fit into the map."""
        if 4 * shadow_margin(self) > self.shadow_map_size:
            raise InvalidArgumentError(
                f"shadow_radius {self.shadow_radius:g} is too wide for a shadow_map_size of "
                f"{self.shadow_map_size}"
            )


def shadow_reach(light: CastsShadows) -> float:
    """Return how many texels away from a sample the comparisons of hard shadows reach."""
    return light.shadow_radius * (light.shadow_taps - 1) / 2 + 1


def widest_radius(light: CastsShadows) -> float:
    """Return the greatest radius of a lookup of soft shadows, in texels (R230)."""
    return max(min(light.shadow_map_size / 16, MOST_RADIUS), shadow_reach(light))


def shadow_margin(light: CastsShadows) -> int:
    """Return how many texels at each side of a light's map are reserved for comparisons.

    They make room for the reach of comparisons and, for directional lights, for the offset of
    samples along their normals (R91).
    """
    reach = shadow_reach(light)
    if light.shadow_softness > 0.0:
        return math.ceil(1.16 * widest_radius(light) + 1.8 * reach)
    return math.ceil(2.8 * reach)

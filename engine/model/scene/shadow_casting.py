"""The shadow parameters of all lights, in three.js's words."""

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

ShadowAttribute: TypeAlias = CheckedAttribute[LightShadow, LightShadow]
TapsAttribute: TypeAlias = CheckedAttribute[ShadowTaps, ShadowTaps]
CountAttribute: TypeAlias = CheckedAttribute[int, int]


def count_of(least: int, most: int) -> Callable[[int, str], int]:
    """Return a check that a value is a whole number of a range."""
    return lambda value, what: whole_number(value, what, least, most)


def _shadow(value: LightShadow, what: str) -> LightShadow:
    # 0 and 1 are equal to False and True, and kept as these.
    checked = one_of(SHADOWS)(value, what)
    return bool(checked) if checked in (False, True) else checked


def _radius(value: float, what: str) -> float:
    number = not_negative(value, what)
    if number > 16:
        raise InvalidArgumentError(f"{what} must be at most 16 texels, not {shown(value)}")
    return number


class CastsShadows(Closed):
    """Base of lights: what shadows they cast, if any."""

    version: int
    shadow: ShadowAttribute = CheckedAttribute(_shadow)
    shadow_map_size: CountAttribute = CheckedAttribute(count_of(LEAST_MAP, MOST_MAP))
    shadow_bias: NumberAttribute = CheckedAttribute(finite)
    shadow_normal_bias: NumberAttribute = CheckedAttribute(finite)
    shadow_radius: NumberAttribute = CheckedAttribute(_radius)
    shadow_taps: TapsAttribute = CheckedAttribute(one_of(TAPS))

    def _keep(self, arguments: dict[str, Any]) -> None:
        """Keep the arguments of a constructor: each is the attribute of its name."""
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


def shadow_margin(light: CastsShadows) -> int:
    """Return how many texels at the sides of a light's map are there for comparisons alone.

    Beside half of these, samples of directional lights move along their normals: R91.
    """
    reach = light.shadow_radius * (light.shadow_taps - 1) / 2 + 1
    return math.ceil(2.8 * reach)

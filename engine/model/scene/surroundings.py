"""The surroundings of a scene: background, environment, ambient light, fog, exposure.

In: values, at any time. Out: the same, checked.
"""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import TypeAlias

from ...base.angles import finite_angle
from ...base.numbers import real, shown
from ...base.validation import Closed, finite, not_negative
from ...choices import Color, ColorLike
from ...errors import InvalidArgumentError
from ..environments.environment import Environment
from ..materials.colors import check_color
from .fog import ExponentialFog, Fog
from .gradients import Gradient

#: Everything besides nodes that pictures depend on; frames, files and the editor use this list.
SCENE_VALUES = (
    "background",
    "ambient",
    "light_clamp",
    "exposure",
    "environment",
    "environment_intensity",
    "environment_rotation",
    "background_blur",
    "fog",
)
MAX_EXPOSURE = 64
#: Returns them all, as each picture asks: from where the properties keep them, without their calls.
values_of = operator.attrgetter(*(f"_{name}" for name in SCENE_VALUES))


#: The kinds of backgrounds.
Background: TypeAlias = Color | Gradient | Environment | None


class Surroundings(Closed):
    """The surroundings of a `Scene`; its docstring describes them."""

    def __init__(
        self,
        background: ColorLike | Gradient | Environment | None,
        ambient: ColorLike,
        light_clamp: Sequence[float] | None,
        exposure: float,
    ) -> None:
        self.background = background
        self.ambient = ambient
        self.light_clamp = light_clamp
        self.exposure = exposure
        self.environment = None
        self.environment_intensity = 1.0
        self.environment_rotation = 0.0
        self.background_blur = 0.0
        self.fog = None

    @property
    def background(self) -> Color | Gradient | Environment | None:
        return self._background

    @background.setter
    def background(self, value: ColorLike | Gradient | Environment | None) -> None:
        if value is not None and not isinstance(value, (Environment, Gradient)):
            value = check_color(value, "background")
        self._background = value

    @property
    def environment(self) -> Environment | None:
        return self._environment

    @environment.setter
    def environment(self, value: Environment | None) -> None:
        if value is not None and not isinstance(value, Environment):
            raise InvalidArgumentError(
                "environment must be an Environment, such as Environment.studio(), or None, "
                f"not {value!r}"
            )
        self._environment = value

    @property
    def environment_intensity(self) -> float:
        return self._environment_intensity

    @environment_intensity.setter
    def environment_intensity(self, value: float) -> None:
        self._environment_intensity = not_negative(value, "environment_intensity")

    @property
    def environment_rotation(self) -> float:
        return self._environment_rotation

    @environment_rotation.setter
    def environment_rotation(self, value: float) -> None:
        self._environment_rotation = finite_angle(value, "environment_rotation")

    @property
    def background_blur(self) -> float:
        return self._background_blur

    @background_blur.setter
    def background_blur(self, value: float) -> None:
        blur = finite(value, "background_blur")
        if not 0 <= blur <= 1:
            raise InvalidArgumentError(f"background_blur must be in 0..1, not {value!r}")
        self._background_blur = blur

    @property
    def fog(self) -> Fog | ExponentialFog | None:
        return self._fog

    @fog.setter
    def fog(self, value: Fog | ExponentialFog | None) -> None:
        if value is not None and not isinstance(value, (Fog, ExponentialFog)):
            raise InvalidArgumentError(
                f"fog must be a Fog, an ExponentialFog or None, not {value!r}"
            )
        self._fog = value

    @property
    def ambient(self) -> Color:
        return self._ambient

    @ambient.setter
    def ambient(self, value: ColorLike) -> None:
        self._ambient = check_color(value, "ambient")

    @property
    def light_clamp(self) -> tuple[float, float] | None:
        return self._light_clamp

    @light_clamp.setter
    def light_clamp(self, value: Sequence[float] | None) -> None:
        if value is None:
            self._light_clamp = None
            return
        low, high = _pair(value, "light_clamp")
        if not 0 <= low <= high:
            raise InvalidArgumentError(f"light_clamp must be 0 <= low <= high, not {value!r}")
        self._light_clamp = (low, high)

    @property
    def exposure(self) -> float:
        return self._exposure

    @exposure.setter
    def exposure(self, value: float) -> None:
        number = real(value)
        if not abs(number) <= MAX_EXPOSURE:
            raise InvalidArgumentError(
                f"exposure must be from {-MAX_EXPOSURE} to {MAX_EXPOSURE} stops, not {shown(value)}"
            )
        self._exposure = number


def _pair(value: Sequence[float], what: str) -> tuple[float, float]:
    try:
        low, high = value
        return float(low), float(high)
    except (TypeError, ValueError, OverflowError):
        raise InvalidArgumentError(f"{what} must be two numbers, not {shown(value)}") from None

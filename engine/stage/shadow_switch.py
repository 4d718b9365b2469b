"""Shadows of all lights of a scene, switched as the user asked for.

In: groups of lights that shine together. Out: their main lights cast shadows, or none does; at the
end all are as they were.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..choices import LightShadow
from ..scene.lights import Light, PointLight

_MOST_LAMPS = 4  # each draws six maps
_MAIN = 0.5  # of the brightest: what is dimmer only lightens the shadows of others


class ShadowSwitch:
    """Lets lights cast shadows, or not, until `leave`.

    Parameters
    ----------
    groups : iterable of list of Light
        Of a group with more than four point lights, these cast none.
    shadow : {False, True, "exact"}
        What ``shadow`` of the lights that cast some is to be.
    """

    def __init__(self, groups: Iterable[list[Light]], shadow: LightShadow) -> None:
        self._before: list[tuple[Light, LightShadow]] = []
        for lights in groups:
            self._before += [(light, light.shadow) for light in lights]
            main = _main_lights(lights)
            for light in lights:
                light.shadow = shadow if light in main else False

    def leave(self) -> None:
        """Let the lights cast what they did before."""
        for light, shadow in self._before:
            light.shadow = shadow


def _main_lights(lights: list[Light]) -> list[Light]:
    lamps = [light for light in lights if isinstance(light, PointLight)]
    far = [light for light in lights if light not in lamps]
    bright = max((light.intensity for light in far), default=0.0)
    main = [light for light in far if light.intensity >= _MAIN * bright]
    return main + (lamps if len(lamps) <= _MOST_LAMPS else [])

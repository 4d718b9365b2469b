"""Shadows of the lights of a model, switched as the user asked for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..choices import LightShadow
from ..model.scene.lights import DirectLight, Light, PointLight

_MOST_LAMPS = 4  # each draws six maps
_MAIN = 0.5  # of the brightest: what is dimmer only lightens the shadows of others


def switch_shadows(groups: Iterable[list[Light]], shadow: LightShadow) -> None:
    """Let lights cast shadows, or not.

    Parameters
    ----------
    groups : iterable of list of Light
        Those that shine together. Of a group with more than four point lights, these cast none.
    shadow : {False, True, "exact"}
        What ``shadow`` of the main lights is to be; the others cast none. Light from all
        around has no shadow.
    """
    for group in groups:
        lights = [light for light in group if isinstance(light, DirectLight)]
        main = _main_lights(lights)
        for light in lights:
            light.shadow = shadow if light in main else False


def _main_lights(lights: Sequence[DirectLight]) -> list[DirectLight]:
    lamps: list[DirectLight] = [light for light in lights if isinstance(light, PointLight)]
    far = [light for light in lights if light not in lamps]
    bright = max((light.intensity for light in far), default=0.0)
    main = [light for light in far if light.intensity >= _MAIN * bright]
    return main + (lamps if len(lamps) <= _MOST_LAMPS else [])

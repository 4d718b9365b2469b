"""Switches the shadows of a model's lights as the user chose."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..choices import LightShadow
from ..model.scene.lights import DirectLight, Light, PointLight

_MOST_LAMPS = 4  # each draws six maps
_MAIN = 0.5  # of the brightest: dimmer lights only brighten other lights' shadows


def switch_shadows(groups: Iterable[list[Light]], shadow: LightShadow) -> None:
    """Switch the shadows of lights on or off.

    Parameters
    ----------
    groups : iterable of list of Light
        Groups of lights that shine together. In a group with more than four point lights, these
        cast none.
    shadow : {"none", "map", "exact"}
        The value of ``shadow`` for the main lights; the others cast none. Ambient lights have no
        shadow.
    """
    for group in groups:
        lights = [light for light in group if isinstance(light, DirectLight)]
        main = _main_lights(lights)
        for light in lights:
            light.shadow = shadow if light in main else "none"


def _main_lights(lights: Sequence[DirectLight]) -> list[DirectLight]:
    lamps: list[DirectLight] = [light for light in lights if isinstance(light, PointLight)]
    far = [light for light in lights if light not in lamps]
    bright = max((light.intensity for light in far), default=0.0)
    main = [light for light in far if light.intensity >= _MAIN * bright]
    return main + (lamps if len(lamps) <= _MOST_LAMPS else [])

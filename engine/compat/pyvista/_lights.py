"""The lights of a renderer of VTK, in view space.

In: a ``vtkRenderer``, whose camera stands where it will. Out: `Lamp`s; lights of engine3d for those
that it has alike, which are all but spot lights and lights that fade.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...choices import LightShadow
from ...model.materials.linear_colors import linear
from ...model.scene.lights import DirectionalLight, PointLight
from ...model.scene.scene import Scene
from ._renderer_view import View, transformed

_FAR = 1e18  # the range of lights that do not fade


class Lamp(NamedTuple):
    """A light.

    Attributes
    ----------
    direction : (3,) float64
        The direction in which it shines, of unit length.
    position : (3,) float64 or None
        None for a light infinitely far away.
    color : (3,) float64
        Times its intensity.
    fading : (float, float, float)
        The brightness at distance d is divided by ``a + b d + c d**2``.
    cone : float
        Degrees from the axis to the edge of the light; 90 and more shine everywhere.
    exponent : float
        The power of the cosine from the axis by which a cone fades.
    casts : bool
        Whether surfaces that are not clear throw shadows in it.
    """

    direction: NDArray[np.float64]
    position: NDArray[np.float64] | None
    color: NDArray[np.float64]
    fading: tuple[float, float, float]
    cone: float
    exponent: float
    casts: bool = False

    @property
    def is_plain(self) -> bool:
        """Whether a light of engine3d shines alike."""
        return self.position is None or (self.fading == (1.0, 0.0, 0.0) and self.cone >= 90.0)


def lamps_of(renderer: Any, view: View) -> list[Lamp]:
    """Return the lights of a renderer that are on."""
    renderer.UpdateLightsGeometryToFollowCamera()
    lights = renderer.GetLights()
    lights.InitTraversal()
    passes = getattr(renderer, "_render_passes", None)  # PyVista's
    has_shadows = getattr(passes, "_shadow_map_pass", None) is not None
    found = []
    for _ in range(lights.GetNumberOfItems()):
        light = lights.GetNextItem()
        if light.GetSwitch():
            found.append(_lamp(light, view, has_shadows))
    return found


def _lamp(light: Any, view: View, has_shadows: bool) -> Lamp:
    ends = np.array([light.GetTransformedPosition(), light.GetTransformedFocalPoint()])
    position, target = transformed(view.view, ends)
    along = target - position
    length = math.sqrt((along * along).sum())
    has_place = bool(light.GetPositional())
    cone = light.GetConeAngle() if has_place else 180.0
    return Lamp(
        direction=along / length if length else np.array([0.0, 0.0, -1.0]),
        position=position if has_place else None,
        color=np.array(light.GetDiffuseColor()) * light.GetIntensity(),
        fading=tuple(light.GetAttenuationValues()) if has_place else (1.0, 0.0, 0.0),
        cone=cone,
        exponent=light.GetExponent(),
        # As vtkShadowMapBakerPass chooses them.
        casts=has_shadows and not light.LightTypeIsHeadlight() and not (has_place and cone >= 90.0),
    )


def add_lights(scene: Scene, lamps: list[Lamp]) -> None:
    """Put lights into a scene; those that engine3d has not alike shine as points."""
    for lamp in lamps:
        color = linear(np.clip(lamp.color, 0.0, None))
        shadow: LightShadow = "exact" if lamp.casts else "none"
        if lamp.position is None:
            scene.add(DirectionalLight(lamp.direction, color, math.pi, shadow=shadow))
        else:
            point = PointLight(color, math.pi, _FAR, "window", shadow=shadow)
            scene.add(point, translation=lamp.position)

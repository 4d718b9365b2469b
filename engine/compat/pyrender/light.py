"""Lights, and the cameras of their shadow maps."""

from __future__ import annotations

import abc
import math

import numpy as np

from ._held import Named, held, number_unless, optional
from .camera import Camera, OrthographicCamera, PerspectiveCamera
from .constants import SHADOW_TEX_SZ
from .texture import Texture
from .utils import format_color_vector

_FLOAT = 5126  # of OpenGL
_WIDER = math.pi / 16.0  # a spotlight's shadow map is wider than its cone by this angle


class Light(Named, abc.ABC):
    """A light.

    Parameters
    ----------
    color : float or sequence of 3 numbers, optional
        Linear; whole numbers are of 0 to 255. By default white.
    intensity : float, optional
        By default 1.
    name : str, optional
    """

    def __init__(self, color=None, intensity=None, name=None):
        self.name = name
        self.color = np.ones(3) if color is None else color
        self.intensity = 1.0 if intensity is None else intensity
        self.shadow_texture: Texture | None = None

    color = held("color", lambda value: format_color_vector(value, 3), "Colour, (3,) float32.")
    intensity = held(
        "intensity", float, "Lux of directional lights, candela of others; 1 shows white as 1/pi."
    )

    def _generate_shadow_texture(self, size=None) -> None:
        side = SHADOW_TEX_SZ if size is None else size
        self.shadow_texture = Texture(
            width=side, height=side, source_channels="D", data_format=_FLOAT
        )

    @abc.abstractmethod
    def _get_shadow_camera(self, scene_scale: float) -> Camera:
        """Return the camera of the shadow map, for a scene with a given diagonal."""


class DirectionalLight(Light):
    """Light from far away, along the -Z of its node; see `Light`."""

    def _get_shadow_camera(self, scene_scale: float) -> Camera:
        near, far = 0.01 * scene_scale, 10 * scene_scale
        return OrthographicCamera(scene_scale, scene_scale, znear=near, zfar=far)


class _Lamp(Light):
    """Base of lights with a position, and a range that is ignored."""

    _reach = optional(number_unless(lambda reach: reach <= 0, "Range must be > 0"))
    range = held("range", _reach, "Kept, but not used: light has no end, as in pyrender.")


class PointLight(_Lamp):
    """Light from a point in all directions.

    Parameters
    ----------
    color, intensity, name
        As for `Light`; at a distance of d, an intensity shines as intensity/d².
    range : float, optional
    """

    def __init__(self, color=None, intensity=None, range=None, name=None):
        super().__init__(color=color, intensity=intensity, name=name)
        self.range = range

    def _generate_shadow_texture(self, size=None) -> None:
        raise NotImplementedError("Shadows not implemented for point lights")

    def _get_shadow_camera(self, scene_scale: float) -> Camera:
        raise NotImplementedError("Shadows not implemented for point lights")


class SpotLight(_Lamp):
    """Light from a point into a cone around the -Z of its node.

    Parameters
    ----------
    color, intensity, range, name
        As for `PointLight`.
    innerConeAngle, outerConeAngle : float
        Radians from the axis, where light begins to fade and where it ends.
    """

    def __init__(
        self,
        color=None,
        intensity=None,
        range=None,
        innerConeAngle=0.0,
        outerConeAngle=math.pi / 4.0,
        name=None,
    ):
        super().__init__(color=color, intensity=intensity, name=name)
        self.outerConeAngle = outerConeAngle
        self.innerConeAngle = innerConeAngle
        self.range = range

    @property
    def innerConeAngle(self) -> float:
        """Radians from the axis where light begins to fade."""
        return self._inner

    @innerConeAngle.setter
    def innerConeAngle(self, value) -> None:
        if value < 0.0 or value > self.outerConeAngle:
            raise ValueError("Invalid value for inner cone angle")
        self._inner = float(value)

    @property
    def outerConeAngle(self) -> float:
        """Radians from the axis where light ends, at most a right angle."""
        return self._outer

    @outerConeAngle.setter
    def outerConeAngle(self, value) -> None:
        if value < 0.0 or value > math.pi / 2.0 + 1e-9:
            raise ValueError("Invalid value for outer cone angle")
        self._outer = float(value)

    def _get_shadow_camera(self, scene_scale: float) -> Camera:
        yfov = min(2.0 * self.outerConeAngle + _WIDER, math.pi)
        near, far = 0.01 * scene_scale, 10 * scene_scale
        return PerspectiveCamera(yfov, znear=near, zfar=far, aspectRatio=1.0)


__all__ = ["DirectionalLight", "Light", "PointLight", "SpotLight"]

"""Direct lights: plain data, placed in the world by the scene's nodes.

A light's colour (a display value, unless it is marked as `linear` light) is multiplied by its
intensity. Directional lights shine along their node's rotated ``direction``, point lights from
their node's origin, spot lights from there along its -Z, area lights from a surface around it.
docs/exactness, sections 9, 12 and 28, has the formulas; docs/conventions.md has the units of
intensities.
"""

from __future__ import annotations

import math
from typing import TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.angles import limited_angle
from ...base.linalg import cos
from ...base.numbers import real, shown
from ...base.validation import (
    CheckedAttribute,
    ColorAttribute,
    NumberAttribute,
    VectorAttribute,
    frozen_floats,
    not_negative,
    one_of,
    positive,
)
from ...choices import ColorLike, Falloff, LightShadow, ShadowTaps
from ...errors import InvalidArgumentError
from ..materials.colors import check_color
from ..materials.linear_colors import linear
from .ambient_lights import AMBIENT_LIGHTS, HemisphereLight, LightProbe
from .shadow_casting import CastsShadows, CountAttribute, count_of

FALLOFFS: tuple[Falloff, ...] = get_args(Falloff)
#: The intensity with which white matt surfaces that face a light show white; if the light has a
#: position, at distance 1.
WHITE_INTENSITY = math.pi


def _direction(value: ArrayLike, what: str) -> NDArray[np.float64]:
    direction = frozen_floats(value, what, (3,))
    if not direction.any():
        raise InvalidArgumentError(f"{what} must not be the zero vector")
    return direction


def _range(value: float, what: str) -> float:
    number = real(value)
    if not number > 0:
        raise InvalidArgumentError(f"{what} must be greater than 0, not {shown(value)}")
    return number


def _angle(value: float, what: str) -> float:
    return limited_angle(value, what, math.pi / 2, "from 0 to pi/2 radians")


class DirectLight(CastsShadows):
    """Base of lights that shine from one direction or position."""

    color: ColorAttribute = CheckedAttribute(check_color)
    intensity: NumberAttribute = CheckedAttribute(not_negative)

    @property
    def kind(self) -> str:
        """The kind's name in the core and in files: a key of `DIRECT_LIGHTS`."""
        return next(name for name, kind in DIRECT_LIGHTS.items() if isinstance(self, kind))

    def check(self) -> None:
        """Raise unless ``shadow_radius`` fits ``shadow_map_size``."""
        self._check_shadow()


class DirectionalLight(DirectLight):
    """A light infinitely far away, such as the sun.

    Parameters
    ----------
    direction : (3,) float
        The direction in which the light travels, in node space; any nonzero length.
    color : str or sequence of 3 numbers
    intensity : float
        In lux. A white matt surface that faces the light shows ``color * intensity / pi``, whatever
        its material is: ``color`` by default.
    shadow : {"none", "map", "exact"}
        Whether objects shadow the surfaces behind them. ``"map"`` uses shadow maps, as in three.js.
        ``"exact"`` traces a ray from each sample to the light: edges are hard, and there is no map,
        bias or other parameter to choose; up to 32 lights. Each node can disable casting and
        receiving shadows.
    shadow_map_size : int
        The most texels a side, 32 to 8192, of each map. Small pictures get smaller maps, whose
        texels are as wide as pixels where the maps serve the farthest.
    shadow_bias : float
        Depth bias, added before the comparison, in units of the map's depth range.
    shadow_normal_bias : float
        World units by which samples move along their normals before the lookup. Both biases add to
        an automatic bias for the texel size, so that 0 looks right.
    shadow_radius : float
        Distance between the comparisons around a sample, in texels, 0 to 16.
    shadow_taps : {1, 3, 5}
        Comparisons per side: 1, 3 x 3 or 5 x 5, each interpolated between four texels.
    shadow_softness : float
        The sun's size: its diameter in the sky in radians, 0 to pi/2; that of the real sun is
        0.0093. Shadows are the softer, the farther they fall. ``shadow="exact"`` casts rays to 32
        fixed points of the sun. 0 takes less time: exact shadows are hard, those of maps are soft
        at all edges alike, by ``shadow_radius``.
    shadow_cascades : int
        Maximum number of cascades, 1 to 8: the last map covers the whole scene, each earlier one
        the view to a quarter of the next one's depth. Small scenes use fewer.

    Attributes
    ----------
    version : int
        Grows with every assignment.

    Raises
    ------
    InvalidArgumentError
    """

    direction: VectorAttribute = CheckedAttribute(_direction)
    shadow_softness: NumberAttribute = CheckedAttribute(_angle)
    shadow_cascades: CountAttribute = CheckedAttribute(count_of(1, 8))

    def __init__(
        self,
        direction: ArrayLike = (0, 0, -1),
        color: ColorLike = (1, 1, 1),
        intensity: float = WHITE_INTENSITY,
        *,
        shadow: LightShadow = "none",
        shadow_map_size: int = 1024,
        shadow_bias: float = 0.0,
        shadow_normal_bias: float = 0.0,
        shadow_radius: float = 1.0,
        shadow_taps: ShadowTaps = 3,
        shadow_softness: float = 0.0,
        shadow_cascades: int = 4,
    ) -> None:
        self._keep(locals())
        self.check()

    @classmethod
    def sun(cls, sun_direction: ArrayLike, turbidity: float = 3.0) -> DirectionalLight:
        """Return the sunlight that belongs to `Environment.sky`.

        Parameters
        ----------
        sun_direction : (3,) float
            Towards the sun.
        turbidity : float
            Turbidity of the air, 2 to 10; the lower the sun, the more blue and green it absorbs.

        Raises
        ------
        InvalidArgumentError
        """
        from ..environments.daylight import sunlight
        from ..environments.environment import daylight_arguments

        (x, y, z), haze = daylight_arguments(sun_direction, turbidity)
        light = sunlight((x, y, z), haze)
        most = max(light)
        color = linear([component / most for component in light])
        return cls((-x, -y, -z), color, most)

    def __repr__(self) -> str:
        direction = tuple(self.direction.tolist())
        return f"DirectionalLight({direction}, color={self.color}, intensity={self.intensity:g})"


class PointLight(DirectLight):
    """A light that shines from one point in all directions.

    Parameters
    ----------
    color : str or sequence of 3 numbers
    intensity : float
        In candela: as for `DirectionalLight`, at distance 1 unless the falloff is ``"window"``.
    range : float
        World units; beyond this distance the light is exactly 0. May be infinite except with
        ``"window"``.
    falloff : {"inverse_square", "window", "gltf"}
        Attenuation at distance d: ``1 / d**2``, ``(1 - d**2 / range**2)**2``, or, as in
        KHR_lights_punctual, ``(1 - (d / range)**4) / d**2``.
    shadow, shadow_map_size, shadow_bias, shadow_normal_bias, shadow_radius, shadow_taps
        As for `DirectionalLight`; the light has six maps, the faces of a cube.
    shadow_softness : float
        The lamp's radius in world units; otherwise as for `DirectionalLight`.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.

    Raises
    ------
    InvalidArgumentError
    """

    range: NumberAttribute = CheckedAttribute(_range)
    falloff: CheckedAttribute[Falloff, Falloff] = CheckedAttribute(one_of(FALLOFFS))

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = WHITE_INTENSITY,
        range: float = math.inf,
        falloff: Falloff = "inverse_square",
        *,
        shadow: LightShadow = "none",
        shadow_map_size: int = 1024,
        shadow_bias: float = 0.0,
        shadow_normal_bias: float = 0.0,
        shadow_radius: float = 1.0,
        shadow_taps: ShadowTaps = 3,
        shadow_softness: float = 0.0,
    ) -> None:
        self._keep(locals())
        self.check()

    def check(self) -> None:
        """Raise unless ``range`` fits ``falloff`` and the shadow parameters fit."""
        if self.falloff == "window" and math.isinf(self.range):
            raise InvalidArgumentError("falloff 'window' needs a finite range")
        self._check_shadow()

    def __repr__(self) -> str:
        return (
            f"PointLight(color={self.color}, intensity={self.intensity:g}, range={self.range:g}, "
            f"falloff={self.falloff!r})"
        )


class SpotLight(DirectLight):
    """A light that shines from one point into a cone, along the -Z of its node.

    As in KHR_lights_punctual: full intensity inside the inner cone, none outside the outer cone,
    and in between the square of a linear ramp in the cosine of the angle. Attenuation at distance d
    is ``(1 - (d / range)**4) / d**2``.

    Parameters
    ----------
    color : str or sequence of 3 numbers
    intensity : float
        As for `PointLight`, on the axis.
    range : float
        World units; beyond this distance the light is exactly 0. May be infinite.
    inner_cone_angle, outer_cone_angle : float
        Radians from the axis: 0 <= inner < outer <= pi/2.
    shadow, shadow_map_size, shadow_bias, shadow_normal_bias, shadow_radius, shadow_taps
        As for `DirectionalLight`; the light has one map. More than 84 degrees off the axis, nothing
        is shadowed.
    shadow_softness : float
        As for `PointLight`.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.

    Raises
    ------
    InvalidArgumentError
    """

    range: NumberAttribute = CheckedAttribute(_range)
    inner_cone_angle: NumberAttribute = CheckedAttribute(_angle)
    outer_cone_angle: NumberAttribute = CheckedAttribute(_angle)

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = WHITE_INTENSITY,
        range: float = math.inf,
        inner_cone_angle: float = 0.0,
        outer_cone_angle: float = math.pi / 4,
        *,
        shadow: LightShadow = "none",
        shadow_map_size: int = 1024,
        shadow_bias: float = 0.0,
        shadow_normal_bias: float = 0.0,
        shadow_radius: float = 1.0,
        shadow_taps: ShadowTaps = 3,
        shadow_softness: float = 0.0,
    ) -> None:
        self._keep(locals())
        self.check()

    def check(self) -> None:
        """Raise unless the inner cone is narrower than the outer, and the shadow fits its map."""
        if not self.inner_cone_angle < self.outer_cone_angle:
            raise InvalidArgumentError(
                f"inner_cone_angle must be less than outer_cone_angle, {self.outer_cone_angle:g}, "
                f"not {self.inner_cone_angle:g}"
            )
        self._check_shadow()

    def cone(self) -> tuple[float, float]:
        """Return the cosine of the outer angle, and 1 over its difference to the inner cosine."""
        inner, outer = cos(self.inner_cone_angle), cos(self.outer_cone_angle)
        return outer, 1.0 / max(0.001, inner - outer)

    def __repr__(self) -> str:
        return (
            f"SpotLight(color={self.color}, intensity={self.intensity:g}, range={self.range:g}, "
            f"inner_cone_angle={self.inner_cone_angle:g}, "
            f"outer_cone_angle={self.outer_cone_angle:g})"
        )


class AreaLight(DirectLight):
    """Base of lights that shine from a surface, equally bright from all sides.

    Their sizes are in world units, whatever their nodes' scale.
    """

    range: NumberAttribute = CheckedAttribute(_range)

    @property
    def area(self) -> float:
        """The area that shines, in square world units."""
        raise NotImplementedError

    @property
    def power(self) -> float:
        """The luminous flux in lumens, with metres as world units; assigning sets ``intensity``."""
        return math.pi * self.area * self.intensity

    @power.setter
    def power(self, value: float) -> None:
        self.intensity = not_negative(value, "power") / (math.pi * self.area)

    @property
    def shadow_softness(self) -> float:  # type: ignore[override]
        """The radius, in world units, of the disc that stands for the light in shadow maps."""
        raise NotImplementedError

    def halves(self) -> tuple[float, float, float]:
        """Return half the extent along the node's X and its Y, and the radius around X."""
        raise NotImplementedError


class RectangleLight(AreaLight):
    """A rectangle that shines to one side, along the -Z of its node: a window, a panel, a screen.

    As three.js's RectAreaLight and OpenUSD's RectLight. The light itself is not seen: add a plane
    of a material that emits ``color * intensity``. Surfaces show its reflection, stretched at
    grazing angles, by linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016).

    Parameters
    ----------
    color : str or sequence of 3 numbers
    intensity : float
        In nits (candela per square metre): how bright its surface looks, whatever its size and
        distance. A white matt surface that touches it shows ``color * intensity``. `power` is the
        same in lumens.
    width, height : float
        World units, along the X and the Y of its node, whatever the node's scale.
    range : float
        World units; beyond this distance from the middle the light is exactly 0, and before it
        light fades by ``1 - (d / range)**4``. May be infinite.
    shadow, shadow_map_size, shadow_bias, shadow_normal_bias, shadow_radius, shadow_taps
        As for `DirectionalLight`. The light has one map, seen from its middle, and shadows are as
        soft as a disc of its area makes them. More than 76 degrees off the axis nothing is
        shadowed. ``"exact"`` shadows ask 32 points of that disc, as it faces what they fall on.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.
    shadow_softness : float
        The radius of that disc.

    Raises
    ------
    InvalidArgumentError
    """

    width: NumberAttribute = CheckedAttribute(positive)
    height: NumberAttribute = CheckedAttribute(positive)

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = 1.0,
        width: float = 1.0,
        height: float = 1.0,
        range: float = math.inf,
        *,
        shadow: LightShadow = "none",
        shadow_map_size: int = 1024,
        shadow_bias: float = 0.0,
        shadow_normal_bias: float = 0.0,
        shadow_radius: float = 1.0,
        shadow_taps: ShadowTaps = 3,
    ) -> None:
        self._keep(locals())
        self.check()

    @property
    def area(self) -> float:
        """The area that shines, in square world units."""
        return self.width * self.height

    @property
    def shadow_softness(self) -> float:  # type: ignore[override]
        """The radius, in world units, of the disc that stands for the light in shadow maps."""
        return math.sqrt(self.area / math.pi)

    def halves(self) -> tuple[float, float, float]:
        """Return half the extent along the node's X and its Y, and the radius around X."""
        return self.width / 2, self.height / 2, 0.0

    def __repr__(self) -> str:
        return (
            f"RectangleLight(color={self.color}, intensity={self.intensity:g}, "
            f"width={self.width:g}, height={self.height:g})"
        )


class DiscLight(AreaLight):
    """A disc that shines to one side, along the -Z of its node, as OpenUSD's DiskLight.

    Parameters
    ----------
    color : str or sequence of 3 numbers
    intensity : float
        As for `RectangleLight`.
    radius : float
        World units.
    range, shadow, shadow_map_size, shadow_bias, shadow_normal_bias, shadow_radius, shadow_taps
        As for `RectangleLight`.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.
    shadow_softness : float
        The disc's radius.

    Raises
    ------
    InvalidArgumentError
    """

    radius: NumberAttribute = CheckedAttribute(positive)

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = 1.0,
        radius: float = 0.5,
        range: float = math.inf,
        *,
        shadow: LightShadow = "none",
        shadow_map_size: int = 1024,
        shadow_bias: float = 0.0,
        shadow_normal_bias: float = 0.0,
        shadow_radius: float = 1.0,
        shadow_taps: ShadowTaps = 3,
    ) -> None:
        self._keep(locals())
        self.check()

    @property
    def area(self) -> float:
        """The area that shines, in square world units."""
        return math.pi * self.radius * self.radius

    @property
    def shadow_softness(self) -> float:  # type: ignore[override]
        """The radius, in world units, of the disc that stands for the light in shadow maps."""
        return self.radius

    def halves(self) -> tuple[float, float, float]:
        """Return half the extent along the node's X and its Y, and the radius around X."""
        return self.radius, self.radius, 0.0

    def __repr__(self) -> str:
        return (
            f"DiscLight(color={self.color}, intensity={self.intensity:g}, radius={self.radius:g})"
        )


class TubeLight(AreaLight):
    """A tube that shines all around, along the X of its node, as OpenUSD's CylinderLight.

    Its ends do not shine.

    Parameters
    ----------
    color : str or sequence of 3 numbers
    intensity : float
        As for `RectangleLight`.
    length, radius : float
        World units.
    range, shadow, shadow_map_size, shadow_bias, shadow_normal_bias, shadow_radius, shadow_taps
        As for `RectangleLight`, but the light has six maps, the faces of a cube around its middle.

    Attributes
    ----------
    version : int
        As for `DirectionalLight`.
    shadow_softness : float
        The radius of a disc as large as the tube looks from beside it.

    Raises
    ------
    InvalidArgumentError
    """

    length: NumberAttribute = CheckedAttribute(positive)
    radius: NumberAttribute = CheckedAttribute(positive)

    def __init__(
        self,
        color: ColorLike = (1, 1, 1),
        intensity: float = 1.0,
        length: float = 1.0,
        radius: float = 0.05,
        range: float = math.inf,
        *,
        shadow: LightShadow = "none",
        shadow_map_size: int = 1024,
        shadow_bias: float = 0.0,
        shadow_normal_bias: float = 0.0,
        shadow_radius: float = 1.0,
        shadow_taps: ShadowTaps = 3,
    ) -> None:
        self._keep(locals())
        self.check()

    @property
    def area(self) -> float:
        """The area that shines, in square world units."""
        return 2.0 * math.pi * self.radius * self.length

    @property
    def shadow_softness(self) -> float:  # type: ignore[override]
        """The radius, in world units, of the disc that stands for the light in shadow maps."""
        return math.sqrt(2.0 * self.radius * self.length / math.pi)

    def halves(self) -> tuple[float, float, float]:
        """Return half the extent along the node's X and its Y, and the radius around X."""
        return self.length / 2, 0.0, self.radius

    def __repr__(self) -> str:
        return (
            f"TubeLight(color={self.color}, intensity={self.intensity:g}, "
            f"length={self.length:g}, radius={self.radius:g})"
        )


#: Lights by their kinds in the core and in files.
DIRECT_LIGHTS: dict[str, type[DirectLight]] = {
    "directional": DirectionalLight,
    "point": PointLight,
    "spot": SpotLight,
    "rectangle": RectangleLight,
    "disc": DiscLight,
    "tube": TubeLight,
}
LIGHTS = (*DIRECT_LIGHTS.values(), *AMBIENT_LIGHTS)
Light: TypeAlias = DirectLight | HemisphereLight | LightProbe

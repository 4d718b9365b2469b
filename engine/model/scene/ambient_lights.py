"""Ambient lights: plain data, turned by their nodes; their position has no effect.

A `HemisphereLight` has a colour above and one below; a `LightProbe` holds spherical harmonics of
measured or computed light. docs/exactness, section 21, has the terms they add to `Scene.ambient`.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...base.validation import (
    CheckedAttribute,
    Closed,
    ColorAttribute,
    NumberAttribute,
    VectorAttribute,
    frozen_floats,
    not_negative,
)
from ...choices import ColorLike
from ..materials.colors import check_color


def _coefficients(value: ArrayLike, what: str) -> np.ndarray:
    return frozen_floats(value, what, (9, 3))


class HemisphereLight(Closed):
    """Light with one colour from above and another from below, blended in between.

    Above is the +Y of its node. Its position has no effect, and nothing shadows it; ambient
    occlusion dims it.

    Parameters
    ----------
    sky_color, ground_color : str or sequence of 3 numbers
    intensity : float
        Multiplies both; a white surface that faces the sky shows ``sky_color * intensity``, with
        any material. (three.js divides by pi, so its values are pi times larger.)

    Attributes
    ----------
    version : int
        Grows with every assignment.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    sky_color: ColorAttribute = CheckedAttribute(check_color)
    ground_color: ColorAttribute = CheckedAttribute(check_color)
    intensity: NumberAttribute = CheckedAttribute(not_negative)

    def __init__(
        self,
        sky_color: ColorLike = (1, 1, 1),
        ground_color: ColorLike = (0, 0, 0),
        intensity: float = 1.0,
    ) -> None:
        self.sky_color = sky_color
        self.ground_color = ground_color
        self.intensity = intensity

    def __repr__(self) -> str:
        return (
            f"HemisphereLight({self.sky_color}, {self.ground_color}, intensity={self.intensity:g})"
        )


class LightProbe(Closed):
    """Light from all around as nine spherical harmonics, as in three.js's `LightProbe`.

    Its position has no effect, and nothing shadows it; ambient occlusion dims it. Its node turns
    it.

    Parameters
    ----------
    coefficients : (9, 3) float
        Red, green and blue of radiance in linear light, for the real harmonics of degree 0, 1 and 2
        in the order 1; y, z, x; xy, yz, 3z² - 1, xz, x² - y², each of unit norm over the sphere.
        A uniform radiance L is ``2 * sqrt(pi) * L`` and eight zeros.
    intensity : float
        Multiplies the coefficients.

    Attributes
    ----------
    coefficients : (9, 3) float64
        Read-only.
    version : int
        As for `HemisphereLight`.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    coefficients: VectorAttribute = CheckedAttribute(_coefficients)
    intensity: NumberAttribute = CheckedAttribute(not_negative)

    def __init__(self, coefficients: ArrayLike, intensity: float = 1.0) -> None:
        self.coefficients = coefficients
        self.intensity = intensity

    def __repr__(self) -> str:
        return f"LightProbe({self.coefficients.tolist()}, intensity={self.intensity:g})"


AMBIENT_LIGHTS = (HemisphereLight, LightProbe)
AmbientLight: TypeAlias = HemisphereLight | LightProbe

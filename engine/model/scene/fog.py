"""Fog: blends distant surfaces into a colour.

In: a colour, and distances or a density. Out: an immutable value that a scene holds.
docs/exactness, section 20, has the formulas.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.calls import hints_keywords
from ...base.validation import finite, not_negative
from ...choices import ColorLike
from ...errors import InvalidArgumentError
from ..materials.colors import check_color


@hints_keywords
@dataclass(frozen=True)
class Fog:
    """Linear fog: none up to the near distance, full from the far distance on.

    Distances are along the view axis, like ``frame.depth``. In between, colours blend linearly to
    that of the fog; three.js's ``Fog`` uses a smooth step.

    Parameters
    ----------
    color : str or sequence of 3 numbers
        The colour at full fog, independent of exposure and tone mapping. The background's colour
        hides the end of the scene.
    near, far : float
        World units; near is less than far.

    Raises
    ------
    InvalidArgumentError
    """

    color: ColorLike
    near: float
    far: float

    def __post_init__(self) -> None:
        near, far = finite(self.near, "near"), finite(self.far, "far")
        if not near < far:
            raise InvalidArgumentError(f"near must be less than far, not {near:g} and {far:g}")
        color = check_color(self.color, "color")
        self.__dict__.update(color=color, near=near, far=far)  # past __setattr__, which refuses


@hints_keywords
@dataclass(frozen=True)
class ExponentialFog:
    """Exponential fog, which begins at the camera.

    A fraction ``exp(-(density * depth)**2)`` of a colour remains, as in three.js's ``FogExp2`` and
    OpenGL's ``GL_EXP2``; depth is the distance along the view axis, like ``frame.depth``.

    Parameters
    ----------
    color : str or sequence of 3 numbers
        As in `Fog`.
    density : float
        Per world unit: at a depth of ``1.5 / density`` a tenth of a colour remains.

    Raises
    ------
    InvalidArgumentError
    """

    color: ColorLike
    density: float

    def __post_init__(self) -> None:
        density = not_negative(self.density, "density")
        self.__dict__.update(color=check_color(self.color, "color"), density=density)

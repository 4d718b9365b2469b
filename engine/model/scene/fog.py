"""Fog: what is far away takes on a colour.

In: a colour, and how fast it closes in. Out: a value that a scene holds, and that never changes.
docs/exactness, section 20, has the formulas.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.validation import finite, not_negative
from ...choices import ColorLike
from ...errors import InvalidArgumentError
from ..materials.colors import check_color


@dataclass(frozen=True)
class Fog:
    """Fog that grows evenly: none up to a distance, nothing else from another one on.

    Distances are along the view axis, as ``frame.depth`` has them. Between both, colours go
    straight to that of the fog; three.js's ``Fog`` eases in and out.

    Parameters
    ----------
    color : sequence of 3 numbers
        What shows where nothing else does any longer, whatever exposure and tone mapping are. That
        of the background hides where the scene ends.
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


@dataclass(frozen=True)
class ExponentialFog:
    """Fog that begins at the camera and never ends.

    Of a colour ``exp(-(density * depth)**2)`` is left. That is three.js's ``FogExp2`` and OpenGL's
    ``GL_EXP2``; depth is the distance along the view axis, as ``frame.depth`` has it.

    Parameters
    ----------
    color : sequence of 3 numbers
        As that of `Fog`.
    density : float
        Per world unit: at a depth of ``1.5 / density`` a tenth of a colour is left.

    Raises
    ------
    InvalidArgumentError
    """

    color: ColorLike
    density: float

    def __post_init__(self) -> None:
        density = not_negative(self.density, "density")
        self.__dict__.update(color=check_color(self.color, "color"), density=density)

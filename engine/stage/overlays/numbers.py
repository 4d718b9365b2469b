"""Which numbers of meshes to show as colours, and how: for `render` and the command line.

In: the keywords of `render`, or the command's options. Out: a `Numbers` value; `coloring.py`
applies it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.numbers import real, shown
from ...base.validation import choose, flag
from ...choices import ValuesOn
from ...errors import InvalidArgumentError
from ...model.geometry.values import KINDS, Values
from .colormaps import ColormapLike, colormap

#: Special values of the component.
MAGNITUDE, DIRECT = -1, -2
DEFAULT_MAP = "viridis"


class NumberKeywords(TypedDict, total=False):
    """The keywords of `render` for numbers as colours."""

    color_by: str | ArrayLike | Values | None
    colormap: ColormapLike | None
    clim: tuple[float, float] | None
    component: int | None
    on: ValuesOn | None


class MarkKeywords(NumberKeywords, total=False):
    """The same, and those for what is drawn beside the scene."""

    bar: bool
    axes_grid: bool


@dataclass(frozen=True, eq=False)
class Numbers:
    """Which numbers to show as colours, and how.

    Attributes
    ----------
    color_by : str, array or None
        A name in ``mesh.values``; or ``x``, ``y`` or ``z``, the coordinates, or ``normals``; or
        numbers of the only mesh. By default the first name in alphabetical order, or else the
        height.
    colormap : str, colour map of matplotlib, or (N, 3) array
        As for `colormap`.
    clim : (float, float) or None
        The numbers of the first and last colour; by default the lowest and highest finite number.
    component : int
        For arrays with several numbers a row: the component, from 0 on; `MAGNITUDE`: the length;
        `DIRECT`: the numbers are colours: grey, grey and alpha, RGB or RGBA.
    on : {"vertices", "faces", "points"} or None
        What the numbers belong to; by default the vertices if they have such numbers.
    """

    color_by: str | ArrayLike | Values | None = None
    colormap: ColormapLike = DEFAULT_MAP
    clim: tuple[float, float] | None = None
    component: int = MAGNITUDE
    on: ValuesOn | None = None

    def __post_init__(self) -> None:
        vars(self)["clim"] = _checked_range(self.clim)
        component = real(self.component)
        if component != int(component) or component < DIRECT:
            raise InvalidArgumentError(
                f"component must be a whole number from -2 on, not {shown(self.component)}"
            )
        if self.on is not None:
            choose(self.on, KINDS, "on")
        vars(self)["_colors"] = colormap(self.colormap)

    @property
    def colors(self) -> NDArray[np.uint8]:
        """The table of the colour map, (N, 3) uint8, lowest number first."""
        return vars(self)["_colors"]

    def within(self, low: float, high: float) -> Numbers:
        """Return the same with another range."""
        return replace(self, clim=(low, high))


class Marks(NamedTuple):
    """The numbers that a picture shows: as colours, and beside the scene.

    Attributes
    ----------
    numbers : Numbers or None
    bar : bool
        Whether a bar tells which colour is which number.
    axes_grid : bool
        Whether a grid with coordinates is behind the scene.
    """

    numbers: Numbers | None
    bar: bool
    axes_grid: bool

    @property
    def shows_any(self) -> bool:
        """Whether the picture shows any."""
        return self.numbers is not None or self.axes_grid


NO_MARKS = Marks(None, False, False)
_NAMES = MarkKeywords.__annotations__.keys()


def take_marks(keywords: dict[str, Any]) -> Marks:
    """Take what keywords say about numbers out of them.

    Parameters
    ----------
    keywords : dict
        Those of `MarkKeywords`, and others, which stay. All but ``axes_grid`` show numbers as
        colours, unless they are None or False.
    """
    if _NAMES.isdisjoint(keywords):
        return NO_MARKS
    taken = {name: keywords.pop(name) for name in _NAMES if name in keywords}
    bar = flag(taken.pop("bar", False), "bar")
    axes_grid = flag(taken.pop("axes_grid", False), "axes_grid")
    given = {name: value for name, value in taken.items() if value is not None}
    return Marks(Numbers(**given) if given or bar else None, bar, axes_grid)


def _checked_range(clim: tuple[float, float] | None) -> tuple[float, float] | None:
    if clim is None:
        return None
    try:
        low, high = map(real, clim)
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"clim must be two numbers, not {shown(clim)}") from None
    if not (np.isfinite([low, high]).all() and low < high):
        raise InvalidArgumentError(
            f"clim must be two finite numbers, low < high, not {shown(clim)}"
        )
    return low, high

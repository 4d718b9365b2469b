"""Gradient backgrounds.

In: two colours. Out: an immutable value that a scene holds as its background. docs/exactness, R122,
has the formula.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.calls import hints_keywords
from ...choices import ColorLike
from ..materials.colors import check_color


@hints_keywords
@dataclass(frozen=True)
class Gradient:
    """A background from one colour at the top of the picture to another at its bottom.

    Steps from row to row look even: display values are interpolated, as in CSS. A fixed pattern
    dithers them to 8 bits, so that no bands show. Exposure and tone mapping do not affect it.

    Parameters
    ----------
    top, bottom : str or sequence of 3 numbers

    Raises
    ------
    InvalidArgumentError
    """

    top: ColorLike
    bottom: ColorLike

    def __post_init__(self) -> None:
        top, bottom = check_color(self.top, "top"), check_color(self.bottom, "bottom")
        self.__dict__.update(top=top, bottom=bottom)  # past __setattr__, which refuses

"""A background that goes from one colour to another.

In: two colours. Out: a value that a scene holds as its background, and that never changes.
docs/exactness, R122, has the formula.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...choices import ColorLike
from ..materials.colors import check_color


@dataclass(frozen=True)
class Gradient:
    """A background from one colour at the top of the picture to another at its bottom.

    Steps from row to row look even: display values are interpolated, as in a style sheet. They are
    dithered to 8 bits by a fixed pattern, so that no bands show. The scene's exposure and tone
    mapping leave it alone, as they do a plain colour.

    Parameters
    ----------
    top, bottom : sequence of 3 numbers

    Raises
    ------
    InvalidArgumentError
    """

    top: ColorLike
    bottom: ColorLike

    def __post_init__(self) -> None:
        top, bottom = check_color(self.top, "top"), check_color(self.bottom, "bottom")
        self.__dict__.update(top=top, bottom=bottom)  # past __setattr__, which refuses

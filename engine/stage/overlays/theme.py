"""Dark and light themes: colours of backgrounds and of texts over the picture."""

from __future__ import annotations

from typing import NamedTuple

from ...model.scene.gradients import Gradient

Rgba = tuple[int, int, int, int]


class Theme(NamedTuple):
    """A set of colours, sRGB from 0 to 255.

    Attributes
    ----------
    name : str
    background : tuple of 3 int
        The background in the look ``"plain"``.
    gradient : Gradient
        The background in the look ``"studio"``.
    text, block : tuple of 4 int
        Colours of texts, and of the translucent blocks behind them.
    key, title : tuple of 4 int
        Highlight colours of texts: names of keys, headings.
    """

    name: str
    background: tuple[int, int, int]
    gradient: Gradient
    text: Rgba
    block: Rgba
    key: Rgba
    title: Rgba


DARK = Theme(
    "dark",
    background=(43, 46, 53),
    gradient=Gradient((124, 130, 141), (88, 93, 102)),
    text=(235, 238, 242, 255),
    block=(16, 18, 24, 210),
    key=(255, 206, 115, 255),
    title=(130, 190, 255, 255),
)
LIGHT = Theme(
    "light",
    background=(228, 231, 236),
    gradient=Gradient((236, 239, 244), (204, 210, 219)),
    text=(28, 31, 38, 255),
    block=(250, 251, 253, 225),
    key=(150, 72, 0, 255),
    title=(20, 84, 170, 255),
)
THEMES = (DARK, LIGHT)


def theme_named(name: object) -> Theme | None:
    """Return the theme of a name; None if it is no name of a theme."""
    return next((one for one in THEMES if isinstance(name, str) and one.name == name), None)

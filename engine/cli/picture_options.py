"""The options of the picture: its size, its look, what is drawn over it, and what draws it."""

from __future__ import annotations

from typing import get_args

from ..choices import Backend
from . import antialiasing, values

#: How models are shown; the first is the default.
LOOKS = tuple(antialiasing.PICTURES)
BACKENDS = get_args(Backend)


def add_drawing(group) -> None:
    """Add what draws."""
    group.add_argument(
        "--backend",
        choices=BACKENDS,
        default="auto",
        help="instruction set to draw with; auto is the fastest. All give the same picture",
    )
    group.add_argument(
        "--threads",
        type=values.thread_count,
        default=0,
        metavar="N",
        help="number of threads; 0, the default, is one per available CPU",
    )


def add_picture(parser) -> None:
    """Add the picture's size and what draws it."""
    group = parser.add_argument_group("picture")
    group.add_argument(
        "--resolution",
        type=values.resolution,
        metavar="WxH",
        help="size in pixels; 1280x720 by default",
    )
    group.add_argument(
        "--look",
        choices=LOOKS,
        default=LOOKS[0],
        help="studio: models stand on their shadow before a gradient, in soft light, with ambient "
        "occlusion, neutral tone mapping and 4 samples per pixel; plain: before one colour, with "
        "none of these. Other options have the last word",
    )
    antialiasing.add(group)
    add_drawing(group)
    group.add_argument(
        "--theme",
        choices=("auto", "dark", "light"),
        default="auto",
        help="what models stand before, and texts are written in; auto: whichever a model of the "
        "look studio stands out from, which may differ from model to model",
    )
    group.add_argument(
        "--background-color",
        type=values.color,
        metavar="COLOR",
        help="R,G,B from 0 to 1 or from 0 to 255, #rrggbb, or a name; the same for every COLOR",
    )
    group.add_argument("-g", "--grid", action="store_true", help="show a grid under the model")
    group.add_argument("-x", "--axis", action="store_true", help="show the axes in the corner")
    group.add_argument(
        "-m",
        "--metadata",
        action="store_true",
        help="show what the file holds, as text in the picture",
    )
    group.add_argument(
        "--ui-scale",
        type=values.ui_scale,
        metavar="N",
        help="how many times larger texts are, 1 to 8; by default as the screen and the picture "
        "want it",
    )


def theme(args) -> dict:
    """Return the fields of `Settings` that ``--theme`` names."""
    from ..stage.theme import THEMES

    named = {theme.name: theme for theme in THEMES}.get(args.theme)
    return {} if named is None else {"theme": named, "keeps_theme": True}

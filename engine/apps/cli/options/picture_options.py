"""The options of the picture: size, look, samples, overlays, and backend."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any, get_args

from ....base.plugins.open_choices import OpenChoices
from ....choices import Backend, LookName, Samples
from .. import values
from ..usage import UsageError
from . import window_options

if TYPE_CHECKING:
    from ....stage.look import Look

#: Default antialiasing method and samples of pictures and turntables.
PICTURE = ("msaa", 4)
#: The antialiasing of a window, whose samples depend on the time (apps/viewer/sampling.py).
WINDOW = "msaa"
#: The default samples of an explicitly chosen method.
USUAL = 4
_NONE = "none"
_SUPERSAMPLES = (1, 4, 16)
#: The looks of models; the first is the default.
LOOKS = get_args(LookName)
_GROUNDS = {"shadow": True, "mirror": "mirror", "none": False}
BACKENDS = get_args(Backend)


def add_drawing(group) -> None:
    """Add the options for the backend."""
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


def add_look(group) -> None:
    """Add the option for the look."""
    group.add_argument(
        "--look",
        choices=OpenChoices("looks", LOOKS),
        metavar="NAME",
        default=LOOKS[0],
        help="studio, the default: models stand on their shadow before a gradient, in soft light, "
        "with ambient occlusion and neutral tone mapping; plain: with none of these, lit from the "
        "camera, before black; or a look that a plug-in adds. Other options have the last word",
    )
    group.add_argument(
        "--ground",
        choices=tuple(_GROUNDS),
        help="what the model stands on: its shadow on an invisible ground, as in the look studio, "
        "the same with its reflection as in a polished floor, or nothing",
    )
    group.add_argument(
        "--feature-edges",
        action=argparse.BooleanOptionalAction,
        help="draw sharp edges and borders of faces as thin lines; by default in the look studio, "
        "of machine parts that state no material",
    )


def look(args: argparse.Namespace) -> Look:
    """Return the look that the options name."""
    from ....stage.look import check_look

    changes = {"ground": _GROUNDS.get(args.ground), "feature_edges": args.feature_edges}
    given: dict[str, Any] = {name: value for name, value in changes.items() if value is not None}
    return check_look(args.look).replace(**given)


def add_picture(parser) -> None:
    """Add the options for the picture's size and drawing."""
    group = parser.add_argument_group("picture")
    group.add_argument(
        "--size",
        type=values.size,
        metavar="WxH",
        help="size in pixels; 1280x720 by default",
    )
    add_look(group)
    _add_antialiasing(group)
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
    window_options.add_ui_scale(group)


def _add_antialiasing(group) -> None:
    """Add the options for samples per pixel and the antialiasing method."""
    group.add_argument(
        "--samples",
        type=int,
        choices=get_args(Samples),
        help="samples per pixel: more give smoother edges; 4 by default, in a window fewer in "
        "motion where it would be slow",
    )
    group.add_argument(
        "--antialiasing",
        choices=(_NONE, "ssaa", "msaa"),
        help="what happens at each sample: everything (ssaa), or only what decides which surface "
        "it shows, while each surface is coloured once a pixel (msaa, faster); none is one sample. "
        "msaa where 2 or 8 samples are asked for, and in windows",
    )


def antialiasing(
    asked: str | None, number: int | None, method: str, samples: int
) -> tuple[str, int]:
    """Return the method, as `Renderer` takes it, and the samples.

    Parameters
    ----------
    asked : str or None
        The method that was asked for.
    number : int or None
        Likewise of the samples.
    method, samples
        Where neither is asked for.

    Raises
    ------
    UsageError
        What is asked for does not go together.
    """
    if asked == _NONE:
        if number not in (None, 1):
            raise UsageError(f"--antialiasing none is one sample a pixel, not {number}")
        return "ssaa", 1
    if asked is not None:
        method, samples = asked, USUAL
    samples = samples if number is None else number
    if method == "ssaa" and samples not in _SUPERSAMPLES:
        if asked is not None:
            raise UsageError(f"--antialiasing ssaa takes 1, 4 or 16 samples, not {samples}")
        method = "msaa"
    return method, samples


def theme(args) -> dict:
    """Return the fields of `Settings` set by ``--theme``."""
    from ....stage.overlays.theme import theme_named

    named = theme_named(args.theme)
    return {} if named is None else {"theme": named, "keeps_theme": True}

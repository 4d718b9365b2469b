"""Joins values to their options where argparse would misread them."""

from __future__ import annotations

import re

from .options.appearance_options import WIREFRAMES

#: Options whose value may start with a minus sign, which argparse would read as an option.
SIGNED_OPTIONS = frozenset(
    {
        "--up",
        "--light-position",
        "--light-direction",
        "--camera-position",
        "--camera-focal-point",
        "--camera-view-up",
        "--camera-direction",
        "--camera-azimuth-angle",
        "--camera-elevation-angle",
        "--environment-rotation",
        "--lod-bias",
        "--range",
        "--coloring-range",
        "--camera-index",
        "--animation-index",
        "--animation-time",
        "--section",
    }
)
_SIGNED_VALUE = re.compile(r"-(\.?\d|[XYZxyz]($|=)|inf|nan)")


def join_values(arguments: list[str]) -> list[str]:
    """Return the arguments with values joined to options where argparse would misread them.

    ``--camera-position -1,2,3`` becomes ``--camera-position=-1,2,3``, and ``--wireframe MODEL``,
    whose value is optional, becomes ``--wireframe=only MODEL``.
    """
    joined: list[str] = []
    for argument in arguments:
        option = joined[-1] if joined else ""
        if option in SIGNED_OPTIONS and _SIGNED_VALUE.match(argument):
            joined[-1] += "=" + argument
        elif option == "--wireframe" and argument not in WIREFRAMES:
            joined[-1] += "=" + WIREFRAMES[-1]
            joined.append(argument)
        else:
            joined.append(argument)
    return joined

"""A parser that joins values to their options, and whose errors say what was probably meant.

In: arguments. Out: argparse's result, or a line on standard error and exit status 2.
"""

from __future__ import annotations

import argparse
import os
import re

from ...base.near_words import meant
from ...errors import printable
from .options.appearance_options import WIREFRAMES

#: Options whose value may start with a minus sign, which argparse would take for an option.
SIGNED_OPTIONS = frozenset(
    {
        "--up",
        "--size",
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


class Parser(argparse.ArgumentParser):
    """A parser with one-line errors, which are not buried under a list of all options.

    Attributes
    ----------
    commands : dict
        The parsers of its commands, by name.
    """

    commands: dict[str, argparse.ArgumentParser]

    def error(self, message):
        self.exit(2, f"{self.prog}: error: {printable(message)} (see {self.prog} --help)\n")

    def _check_value(self, action, value):
        if action.choices is None or value in action.choices:
            return
        choices = list(map(str, action.choices))
        if isinstance(action, argparse._SubParsersAction):
            message = f"there is no command {value!r}{meant(value, choices)}"
            if os.path.exists(value):
                message = f"{value!r} is no command; to see that file: engine3d run {value}"
            raise argparse.ArgumentError(None, message)
        known = ", ".join(choices)
        hint = meant(str(value), choices) or getattr(action, "hint", "")
        message = f"{str(value)!r} is not one of {known}{hint}"
        raise argparse.ArgumentError(action, message)


def join_values(arguments: list[str]) -> list[str]:
    """Return the arguments with values joined to options where argparse would take them wrongly.

    ``--camera-position -1,2,3`` becomes ``--camera-position=-1,2,3``, and ``--wireframe MODEL``,
    whose value may be left out, becomes ``--wireframe=only MODEL``.
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


#: Options by the names of other commands and programs, and what they may be called here.
_ELSEWHERE = {
    "--resolution": ("--size",),
    "--width": ("--size",),
    "--height": ("--size",),
    "--fov": ("--camera-yfov",),
    "--camera-view-angle": ("--camera-yfov",),
    "--shadows": ("--shadow",),
    **dict.fromkeys(("--flat", "--facets", "--smooth"), ("--normals",)),
    "--bg": ("--background-color",),
    "--out": ("--output",),
}


def option_meant(word: str, parser: argparse.ArgumentParser) -> str:
    """Return the suggestion of `meant` for an option that a parser lacks."""
    known = option_strings(parser)
    named = [option for option in _ELSEWHERE.get(word, ()) if option in known]
    return f": did you mean {named[0]}?" if named else meant(word, known)


def option_strings(parser: argparse.ArgumentParser) -> list[str]:
    """Return the long options of a parser."""
    options = (option for action in parser._actions for option in action.option_strings)
    return [option for option in options if option.startswith("--")]

"""The options of environments: light from all around, and what is behind everything."""

from __future__ import annotations

import argparse
import math
from typing import get_args

from ..choices import BuiltInEnvironment
from . import values
from .usage import UsageError

BUILT_IN = get_args(BuiltInEnvironment)
NONE = "none"


def add_environment(parser) -> None:
    """Add light from all around."""
    group = parser.add_argument_group("environment")
    group.add_argument(
        "--environment",
        metavar="FILE|NAME",
        help="light from all around: a Radiance (.hdr) or OpenEXR (.exr) file, "
        f"{', '.join(BUILT_IN)}, or {NONE}",
    )
    group.add_argument(
        "--environment-rotation",
        type=values.number,
        metavar="DEGREES",
        help="turn the environment about the axis +Y, counter-clockwise seen from above",
    )
    group.add_argument(
        "--environment-intensity",
        type=values.not_negative,
        metavar="F",
        help="factor for the environment's light; 1 by default",
    )
    background = group.add_argument(
        "--background",
        choices=["environment"],
        help="show the environment behind everything: the studio, if there is no other",
    )
    background.hint = ": a colour goes with --background-color"
    group.add_argument(
        "--background-blur",
        type=values.fraction,
        metavar="F",
        help="blur an environment that shows, 0 to 1; 0 by default",
    )


def surroundings(args: argparse.Namespace):
    """Return the `Surroundings` that the options name."""
    from ..stage.chosen_surroundings import Surroundings

    shows = args.background is not None
    if shows and args.environment == NONE:
        raise UsageError(f"--background environment does not go with --environment {NONE}")
    if shows and args.background_color is not None:
        raise UsageError("--background environment does not go with --background-color")
    if shows and getattr(args, "no_background", False):
        raise UsageError("--background environment does not go with --no-background")
    degrees = args.environment_rotation
    return Surroundings(
        environment=_environment(args.environment),
        without=args.environment == NONE,
        rotation=None if degrees is None else math.radians(degrees),
        intensity=args.environment_intensity,
        shows=shows,
        blur=args.background_blur,
    )


def _environment(name: str | None):
    """The environment of a file, or the built-in one of that name."""
    from ..environments.environment import Environment, named_environment

    if name is None or name == NONE:
        return None
    return named_environment(name) if name in BUILT_IN else Environment.load(name)

"""The options of environments, backgrounds and fog."""

from __future__ import annotations

import argparse
import math
from typing import get_args

from ....choices import BuiltInEnvironment
from .. import values
from ..usage import UsageError

BUILT_IN = get_args(BuiltInEnvironment)
NONE = "none"


def add_environment(parser) -> None:
    """Add the options of environments."""
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
    """Return the `Surroundings` that the options describe."""
    from ....stage.chosen_surroundings import Surroundings

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
    """Return the environment of a file, or the built-in one with that name."""
    from ....model.environments.environment import Environment, named_environment

    if name is None or name == NONE:
        return None
    return named_environment(name) if name in BUILT_IN else Environment.load(name)


def add_backdrop(parser) -> None:
    """Add the options of backgrounds and fog."""
    group = parser.add_argument_group("background and fog")
    group.add_argument(
        "--background-gradient",
        nargs=2,
        type=values.color,
        metavar=("TOP", "BOTTOM"),
        help="a background that goes from one COLOR at the top to another at the bottom",
    )
    group.add_argument(
        "--fog",
        type=values.limits,
        metavar="NEAR,FAR",
        help="fog that begins at one distance from the camera, and hides all from another one on, "
        "in units of the scene",
    )
    group.add_argument(
        "--fog-density",
        type=values.not_negative,
        metavar="D",
        help="fog that begins at the camera: at a distance of 1.5/D a tenth of a colour is left",
    )
    group.add_argument(
        "--fog-color",
        type=values.color,
        metavar="COLOR",
        help="colour of the fog; by default that of the background or of its middle, and white "
        "before an environment",
    )


def background(args: argparse.Namespace):
    """Return the background of the options: a colour, a `Gradient` or None."""
    if getattr(args, "background_gradient", None) is None:  # some commands have no gradients
        return args.background_color
    others = {
        "--background-color": args.background_color,
        "--background environment": args.background,
        "--no-background": getattr(args, "no_background", False) or None,
    }
    for option, given in others.items():
        if given is not None:
            raise UsageError(f"--background-gradient does not go with {option}")
    from ....model.scene.gradients import Gradient

    return Gradient(*args.background_gradient)


def fog(args: argparse.Namespace) -> dict:
    """Return the fields of `Settings` set by the fog options."""
    if "fog" not in args:  # some commands have no fog
        return {}
    from ....model.scene.fog import ExponentialFog, Fog

    if args.fog is not None and args.fog_density is not None:
        raise UsageError("--fog and --fog-density do not go together")
    color = args.fog_color or (255, 255, 255)
    follows = args.fog_color is None
    if args.fog is not None:
        near, far = args.fog
        if not near < far:
            raise UsageError("--fog needs NEAR,FAR with NEAR less than FAR")
        return {"fog": Fog(color, near, far), "fog_follows": follows}
    if args.fog_density is not None:
        return {"fog": ExponentialFog(color, args.fog_density), "fog_follows": follows}
    if not follows:
        raise UsageError("--fog-color goes with --fog or --fog-density")
    return {}

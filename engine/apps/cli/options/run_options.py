"""The options of ``run`` alone, for its window or output."""

from __future__ import annotations

import argparse

from .. import values
from . import language_options


def add(parser) -> None:
    """Add the options of ``run`` alone."""
    group = parser.add_argument_group("window")
    group.add_argument(
        "--animate",
        action=argparse.BooleanOptionalAction,
        help="start with the scene's animation, or for a model a slow turn, playing",
    )
    group.add_argument(
        "--camera",
        choices=("orbit", "fps"),
        default="orbit",
        help="orbit around the model (the default), or walk with WASD and the mouse",
    )
    group.add_argument(
        "--walkable",
        type=values.names,
        metavar="NAME,…",
        help="walk on these materials of the model only",
    )
    group.add_argument(
        "--slope",
        type=values.slope,
        metavar="DEGREES",
        help="the steepest ground of the model that one walks on; 40 by default",
    )
    group.add_argument(
        "-z", "--fps", action="store_true", help="show frames per second and statistics"
    )
    group.add_argument(
        "--controls",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="show the bar of commands, the ball of axes and the time line (on by default); F10 "
        "hides them",
    )
    group.add_argument(
        "--vsync",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="wait for the screen's refresh (on by default)",
    )
    group.add_argument(
        "--watch", action="store_true", help="load the model again when its file changes"
    )
    language_options.add(group)
    group.add_argument(
        "--headless", action="store_true", help="open no window; write an animation to a file"
    )
    group.add_argument(
        "--terminal",
        action="store_true",
        help="show it in the terminal, also over SSH: as kitty graphics, sixels or coloured text",
    )
    group.add_argument(
        "--frames",
        type=values.count,
        metavar="N",
        help="stop after N frames; with --headless, write N frames",
    )
    group.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="what --headless writes: .gif, .webp, .apng, .mp4, or numbered pictures like "
        "frame_%%04d.png or frame_{:04}.png; one picture if N is 1",
    )

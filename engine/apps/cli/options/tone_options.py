"""The options of exposure, tone mapping and bloom."""

from __future__ import annotations

from typing import get_args

from ....choices import ToneMapping
from .. import values


def add_tone(parser) -> None:
    """Add the options of exposure, tone mapping and bloom."""
    group = parser.add_argument_group("tone")
    group.add_argument(
        "--tone-mapping",
        choices=get_args(ToneMapping),
        help="how light of any brightness becomes what a screen can show: cut off above 1 (none, "
        "the default), by Khronos PBR Neutral, or as film does (aces, agx)",
    )
    group.add_argument(
        "--exposure",
        type=values.stops,
        metavar="STOPS",
        help="make what is lit brighter: twice for each stop; below 0 darker",
    )
    group.add_argument(
        "--bloom",
        type=values.bloom,
        metavar="F",
        help="how much of the light above 1 glows around where it comes from, 0 to 100; 0 by "
        "default, and 1 is a lot",
    )

"""The options of light: lights instead of others, shadows, and how light becomes colours."""

from __future__ import annotations

from typing import get_args

from ....choices import LightShadow, ToneMapping
from .. import values


def add_light(parser) -> None:
    """Add the options of lights."""
    group = parser.add_argument_group("light")
    group.add_argument(
        "--light-position",
        type=values.vector,
        metavar="X,Y,Z",
        help="light the model with one point light at this position only",
    )
    group.add_argument(
        "--light-direction",
        type=values.direction,
        metavar="X,Y,Z",
        help="light the model with one light from afar only, which travels this way",
    )
    group.add_argument(
        "--light-intensity",
        type=values.not_negative,
        metavar="I",
        help="intensity of that light: 1 shows white; one at a position gives I/d² at distance d. "
        "Without such a light, a factor for the default lights",
    )
    group.add_argument(
        "--light-clamp",
        type=values.limits,
        metavar="LOW,HIGH",
        help="keep the sum of the lights within these, such as 0.1,1",
    )
    group.add_argument(
        "--shadow",
        choices=get_args(LightShadow),
        help="whether the main lights cast shadows: none, from maps drawn from the lights, or "
        "exact ones with hard edges; by default what a scene file says of its lights",
    )


def add_ambient(parser) -> None:
    """Add ambient occlusion: less light from all around in corners and hollows."""
    group = parser.add_argument_group("ambient light")
    group.add_argument(
        "-q",
        "--ambient-occlusion",
        action="store_true",
        help="let less of the light from all around reach corners and hollows",
    )
    group.add_argument(
        "--ambient-occlusion-radius",
        type=values.positive,
        metavar="F",
        help="how far away things are in the way of that light, in units of the scene; a tenth of "
        "its diagonal by default",
    )


def add_tone(parser) -> None:
    """Add how light becomes colours: exposure, tone mapping, glow."""
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
        help="make what is lit brighter: twice for each stop; below 0 darker; 0 by default",
    )
    group.add_argument(
        "--bloom",
        type=values.bloom,
        metavar="F",
        help="how much of the light above 1 glows around where it comes from, 0 to 100; 0 by "
        "default, and 1 is a lot",
    )

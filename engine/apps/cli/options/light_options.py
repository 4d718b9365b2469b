"""The options of lights and shadows."""

from __future__ import annotations

from .. import values

#: Values of lights' ``shadow``, by their names here.
SHADOWS = {"none": False, "map": True, "exact": "exact"}


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
        help="intensity of that light; one at a position gives I/d² at distance d. Without such a "
        "light, a factor for the default lights",
    )
    group.add_argument(
        "--light-clamp",
        type=values.limits,
        metavar="LOW,HIGH",
        help="keep the sum of the lights within these, such as 0.1,1",
    )
    group.add_argument(
        "--shadows",
        choices=[*SHADOWS],
        help="whether the main lights cast shadows: none, from maps drawn from the lights, or "
        "exact ones with hard edges; by default what a scene file says of its lights",
    )

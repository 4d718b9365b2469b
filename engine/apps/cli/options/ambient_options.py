"""The options of ambient occlusion."""

from __future__ import annotations

from .. import values


def add_ambient(parser) -> None:
    """Add the options of ambient occlusion."""
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

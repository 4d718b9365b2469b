"""The options of ``city``."""

from __future__ import annotations

from .. import values


def add(command) -> None:
    """Add the options for the city and its output."""
    command.add_argument("output", metavar="OUT", help="the file to write")
    command.add_argument(
        "--triangles",
        type=values.city_triangles,
        default=1_000_000,
        metavar="N",
        help="about how many triangles, 20,000 to 50,000,000; a million by default",
    )
    command.add_argument(
        "--seed",
        type=values.integer,
        default=0,
        metavar="N",
        help="each number gives another city; 0 by default",
    )

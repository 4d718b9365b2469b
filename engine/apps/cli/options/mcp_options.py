"""The options of ``engine3d mcp``.

In: an argparse parser. Out: the same parser with options.
"""

from __future__ import annotations

import argparse

from ...agents.usual_limits import MEGABYTES, SECONDS, SIDE, TRIANGLES
from .. import values


def add(parser: argparse.ArgumentParser) -> None:
    """Add the options for what the server allows."""
    parser.add_argument(
        "--root",
        metavar="FOLDER",
        default=".",
        help="the folder of all files that are read and written; by default the current one",
    )
    parser.add_argument(
        "--allow-scripts",
        action="store_true",
        help="let agents run Python in this process, which may then do whatever you may",
    )
    parser.add_argument(
        "--timeout",
        metavar="SECONDS",
        type=values.positive,
        default=SECONDS,
        help="how long a call may take; %(default)g by default",
    )
    for name, default, what in (
        ("megabytes", MEGABYTES, "the size of a file that is read"),
        ("triangles", TRIANGLES, "the triangles of the scene"),
        ("side", SIDE, "the pixels of a picture's sides"),
    ):
        parser.add_argument(
            f"--max-{name}",
            metavar="N",
            type=values.count,
            default=default,
            help=f"the limit for {what}; {default:,} by default",
        )

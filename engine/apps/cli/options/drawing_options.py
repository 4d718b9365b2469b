"""The options of line drawings, which ``render`` and ``sheet`` write as SVG and PDF.

In: an argparse parser. Out: the same parser with options; a check that they go with the output.
"""

from __future__ import annotations

import argparse
import os
from typing import Any

from ...drawings.units import PAGES, SUFFIXES
from .. import values
from ..outputs import STANDARD_OUTPUT
from ..usage import UsageError

#: What only line drawings have.
_ONLY = ("hidden", "scale", "no_intersections", "line_scale")
_OF_PAGES = ("page", "title", "vector")


def add_lines(parser, *, is_page: bool) -> None:
    """Add the options of line drawings; of pages of several views, too."""
    group = parser.add_argument_group("line drawings (-o FILE.svg or FILE.pdf)")
    group.add_argument("--hidden", action="store_true", help="draw hidden lines, too, dashed")
    group.add_argument(
        "--scale",
        type=values.drawing_scale,
        metavar="A:B",
        help="scale of the drawing, such as 1:2; by default the largest usual one that fits"
        if is_page
        else "scale of the drawing, such as 1:2, with --camera-orthographic; by default the "
        "drawing has the picture's size, 96 pixels in an inch",
    )
    group.add_argument(
        "--no-intersections",
        action="store_true",
        help="draw no lines where parts run through each other",
    )
    group.add_argument(
        "--line-scale",
        type=values.positive,
        metavar="F",
        help="factor on the widths of lines: edges have 0.5 mm, hidden lines 0.25 mm",
    )
    if is_page:
        group.add_argument("--title", metavar="TEXT", help="of the page; else the file's name")
        group.add_argument("--page", choices=PAGES, help="size of the page; A3 by default")
        group.add_argument(
            "--crease-angle",
            type=values.crease_angle,
            metavar="DEGREES",
            help="faces that meet at more than this angle have an edge between them; 35 by default",
        )
        group.add_argument(
            "--vector",
            action="store_true",
            help="draw lines also to standard output (-o -), as SVG",
        )


def is_drawing(args: argparse.Namespace) -> bool:
    """Return whether a line drawing is asked for; raise if there are options for one in vain."""
    output = args.output or ""
    suffix = os.path.splitext(output)[1].lower()
    if suffix in SUFFIXES or (output == STANDARD_OUTPUT and getattr(args, "vector", False)):
        return True
    given = [name for name in (*_ONLY, *_OF_PAGES) if getattr(args, name, None)]
    if given:
        option = given[0].replace("_", "-")
        raise UsageError(f"--{option} goes with line drawings: -o FILE.svg or FILE.pdf")
    return False


def drawing_keywords(args: argparse.Namespace) -> dict[str, Any]:
    """Return what the options say about lines, as keywords of `line_drawing`."""
    given = {
        "scale": args.scale,
        "crease_angle": args.crease_angle,
        "intersections": not args.no_intersections,
        "threads": args.threads,
    }
    return {name: value for name, value in given.items() if value is not None}


def looks(args: argparse.Namespace) -> dict[str, Any]:
    """Return how lines look, as keywords of `LineDrawing.save`."""
    return {"hidden": args.hidden, "line_width": args.line_scale or 1.0}

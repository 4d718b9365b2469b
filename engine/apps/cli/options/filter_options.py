"""The options of texture filtering, and of shapes and sizes of lines and points."""

from __future__ import annotations

import argparse
from typing import get_args

from ....choices import LineShape, PointShape, SizeUnit
from .. import values


def add_texture_filters(group) -> None:
    """Add the options of texture filtering."""
    group.add_argument(
        "--anisotropy",
        type=values.anisotropy,
        metavar="N",
        help="read textures at up to N places a pixel, 1 to 16, where surfaces recede; by default "
        "as their materials say, but at least 8",
    )
    group.add_argument(
        "--lod-bias",
        type=values.lod_bias,
        metavar="B",
        help="added to the level of detail of textures: less than 0 is sharper and flickers more; "
        "by default as their materials say, and -0.25 where these say nothing",
    )


def add_line_shapes(group) -> None:
    """Add the options for the shapes and the unit of lines and points."""
    group.add_argument(
        "--line-shape",
        choices=get_args(LineShape),
        help="plain lines, the default, or with round ends and joins, as wide as they say at any "
        "angle",
    )
    group.add_argument(
        "--point-shape",
        choices=get_args(PointShape),
        help="square points, the default, or round ones",
    )
    group.add_argument(
        "--size-unit",
        choices=get_args(SizeUnit),
        help="what --line-width and --point-size count: pixels, the default, or thousandths of the "
        "picture's height",
    )


def filtering(args: argparse.Namespace):
    """Return the `Filtering` that the options describe."""
    from ....stage.filtering import Filtering

    return Filtering(anisotropy=args.anisotropy, lod_bias=args.lod_bias, is_usual=True)

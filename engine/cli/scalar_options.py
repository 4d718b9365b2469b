"""The options of colours that stand for numbers, and of the grid with units around a model."""

from __future__ import annotations

import argparse

from . import values

#: Options that colour models by numbers.
COLORING = ("scalar_coloring", "coloring_array", "colormap", "range", "bar")
_DEFAULT_MAP = "viridis"


def add_scalars(parser) -> None:
    """Add colouring by numbers."""
    group = parser.add_argument_group("numbers")
    group.add_argument(
        "-s",
        "--scalar-coloring",
        action="store_true",
        help="colour models by a number that their vertices have",
    )
    group.add_argument(
        "--coloring-array",
        metavar="NAME",
        help="which number: a scalar property of a PLY file, or x, y, z; by default the file's "
        "first one, or without any how high it is. Implies -s",
    )
    group.add_argument(
        "--colormap",
        metavar="FILE|NAME",
        help="viridis (the default), plasma, inferno, magma, turbo, coolwarm, gray, or a picture "
        "whose middle row goes from the lowest to the highest number. Implies -s",
    )
    group.add_argument(
        "--range",
        type=values.interval,
        metavar="MIN,MAX",
        help="what the first and the last colour stand for; by default the lowest and the highest "
        "number. Implies -s",
    )
    group.add_argument(
        "-b", "--bar", action="store_true", help="show which colour is which number. Implies -s"
    )
    group.add_argument(
        "--axes-grid",
        action="store_true",
        help="show a grid behind the model, with numbers and, where the file has one, their unit",
    )


def coloring(args: argparse.Namespace):
    """Return the `ScalarColoring` that the options name, or None."""
    if "scalar_coloring" not in args:  # some commands have no such options
        return None
    given = (args.coloring_array, args.colormap, args.range, args.scalar_coloring or None)
    if given == (None,) * 4 and not args.bar:
        return None
    from ..viewer.colormaps import colormap
    from ..viewer.scalars import ScalarColoring

    colors = colormap(args.colormap or _DEFAULT_MAP)
    return ScalarColoring(colors, args.coloring_array, args.range)


def shown(args: argparse.Namespace) -> dict:
    """Return the fields of `Settings` that the options of numbers name."""
    return {name: getattr(args, name, False) for name in ("axes_grid", "bar")}

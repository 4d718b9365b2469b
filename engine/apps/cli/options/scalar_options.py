"""The options for colouring by numbers, and for the axes grid."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from .. import values

if TYPE_CHECKING:
    from ....stage.overlays.numbers import Numbers

#: Options that colour models by numbers.
COLORING = (
    "scalar_coloring",
    "coloring_array",
    "coloring_component",
    "coloring_by_cells",
    "colormap",
    "range",
    "bar",
)


def add_scalars(parser) -> None:
    """Add the options for colouring by numbers."""
    group = parser.add_argument_group("numbers")
    group.add_argument(
        "-s",
        "--scalar-coloring",
        action="store_true",
        help="colour models by a number that their vertices or faces have",
    )
    group.add_argument(
        "--coloring-array",
        metavar="NAME",
        help="which number: a property of a PLY file, an attribute of a glTF file that begins "
        "with _, or x, y, z, normals; by default the file's first one in alphabetical order, or "
        "without any how high it is. Implies -s",
    )
    group.add_argument(
        "-y",
        "--coloring-component",
        type=values.component,
        metavar="N",
        help="which number of vectors, from 0 on; -1, the default: their length; -2: none, they "
        "are colours. Implies -s",
    )
    group.add_argument(
        "-c",
        "--coloring-by-cells",
        action="store_true",
        help="colour by a number of faces: a property of them in a PLY file. Implies -s",
    )
    group.add_argument(
        "--colormap",
        "--colormap-file",
        metavar="MAP",
        help="viridis (the default), plasma, inferno, magma, turbo, coolwarm, gray; a picture "
        "whose middle row goes from the lowest to the highest number; or places from 0 to 1 with "
        "their colours, 0,#000000,0.4,red,1,white. Implies -s",
    )
    group.add_argument(
        "--range",
        "--coloring-range",
        type=values.interval,
        metavar="MIN,MAX",
        help="what the first and the last colour stand for; by default the lowest and the highest "
        "number. Implies -s",
    )
    group.add_argument(
        "-b",
        "--bar",
        "--coloring-scalar-bar",
        action="store_true",
        help="show which colour is which number. Implies -s",
    )
    group.add_argument(
        "--axes-grid",
        action="store_true",
        help="show a grid behind the model, with numbers and, where the file has one, their unit",
    )


def marks(args: argparse.Namespace) -> dict[str, Any]:
    """Return what the options say about numbers, as keywords of `engine3d.render`."""
    from ....stage.overlays.numbers import DEFAULT_MAP

    by_cells = "faces" if args.coloring_by_cells else None
    given = {
        "color_by": args.coloring_array,
        "colormap": args.colormap or (DEFAULT_MAP if args.scalar_coloring else None),
        "clim": args.range,
        "component": args.coloring_component,
        "on": by_cells,
    }
    held = {name: value for name, value in given.items() if value is not None}
    return held | {name: True for name, is_shown in shown(args).items() if is_shown}


def coloring(args: argparse.Namespace) -> Numbers | None:
    """Return the `Numbers` that the options describe, or None."""
    if "scalar_coloring" not in args:  # some commands have no such options
        return None
    from ....stage.overlays.numbers import take_marks

    return take_marks(marks(args)).numbers


def shown(args: argparse.Namespace) -> dict:
    """Return the fields of `Settings` set by these options."""
    return {name: getattr(args, name, False) for name in ("axes_grid", "bar")}

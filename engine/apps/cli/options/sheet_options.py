"""The options of ``engine3d sheet``.

In: an argparse parser. Out: the same parser with options; their texts are checked when it runs.
"""

from __future__ import annotations

from .. import values
from .camera_options import add_up
from .drawing_options import add_lines
from .input_options import add_robot, add_root
from .inspection_options import add_explode, add_measure
from .picture_options import add_drawing, add_look
from .scalar_options import add_scalars
from .scene_options import add_color


def add(parser) -> None:
    """Add the options for models, drawing and output."""
    parser.add_argument(
        "models", metavar="MODEL", nargs="+", help="model files; - for standard input"
    )
    group = parser.add_argument_group("output")
    group.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="a .png file; .svg and .pdf draw lines to scale; - writes PNG to standard output",
    )
    group.add_argument(
        "--json",
        action="store_true",
        help="write the report beside the picture, as FILE with .json in place of .png",
    )
    group.add_argument(
        "--report",
        metavar="FILE",
        help="write the report there; - writes it to standard output. Without -o no picture is "
        "written",
    )
    group = parser.add_argument_group("what to show")
    group.add_argument(
        "--views",
        metavar="VIEW,…",
        help="front, right, back, left, top, bottom, iso, camera0 (the file's first camera), "
        "NAME=X,Y,Z (the way the camera looks), NAME=AZIMUTH,ELEVATION (degrees); in rows, in this "
        "order. top,iso,front,right by default",
    )
    group.add_argument(
        "--section",
        action="append",
        metavar="AXIS=PLACE",
        help="cut the model in two views of its own: x=0.5 cuts off what has greater coordinates, "
        "-x=0.5 the rest, x=50%% is in the middle, as is x. May be given several times",
    )
    add_explode(group)
    add_measure(group)
    group.add_argument(
        "--size",
        type=values.size,
        metavar="WxH",
        help="pixels of each model's part; parts stand one below another. 1600x1200 by default, "
        "1600x480 with several models",
    )
    group.add_argument(
        "--unit", metavar="NAME", help="unit of lengths, where the file's format has none"
    )
    add_root(group)
    add_robot(group)
    add_up(group)
    add_color(group)
    add_scalars(parser)
    add_lines(parser, is_page=True)
    group = parser.add_argument_group("drawing")
    add_look(group)
    add_drawing(group)

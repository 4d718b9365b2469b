"""The options of ``render`` alone, for its output."""

from __future__ import annotations

from .. import values
from .drawing_options import add_lines


def add(parser) -> None:
    """Add the options of ``render`` alone."""
    group = parser.add_argument_group("output")
    group.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help=".png, .jpg, .tga, .webp; .svg and .pdf draw lines; - writes PNG to standard output, "
        "terminal: shows it there. "
        "{model}, {model.ext}, {model_ext}, {folder}, {date}, {n} (the first number that is free; "
        "{n:3} has three digits), {app} and {version} are filled in; {{ is a brace",
    )
    group.add_argument(
        "--turntable",
        type=values.picture_count,
        metavar="N",
        help="N pictures of one turn, to .gif, .webp, .apng, .mp4 (with engine3d[video]), or "
        "numbered pictures like frame_%%04d.png or frame_{:04}.png",
    )
    group.add_argument(
        "--animation",
        type=values.picture_count,
        metavar="N",
        help="N pictures of the model's animation, once through, to files as --turntable writes; "
        "with --turntable it plays while the model turns",
    )
    group.add_argument(
        "--no-background", action="store_true", help="leave the background transparent"
    )
    group.add_argument(
        "--watch", action="store_true", help="draw again when a model's file changes, until Ctrl+C"
    )
    group.add_argument(
        "--reference",
        metavar="FILE",
        help="compare with this picture; exit status 1 if they differ",
    )
    group.add_argument(
        "--reference-threshold",
        type=values.fraction,
        metavar="D",
        help="largest root mean square difference that still passes, 0 to 1; 0 by default",
    )
    add_lines(parser, is_page=False)

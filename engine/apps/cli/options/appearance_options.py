"""The options of how surfaces, their textures, lines and points are drawn."""

from __future__ import annotations

import argparse
from typing import get_args

from ....choices import (
    Culling,
    FrameCull,
    HiddenSurfaces,
    LineShape,
    Mode,
    Normals,
    OutputMode,
    PointShape,
    Shading,
    SizeUnit,
    Wireframe,
)
from .. import values
from ..usage import UsageError

MODES = (*get_args(Mode), *get_args(OutputMode))
WIREFRAMES = get_args(Wireframe)


def add_appearance(parser) -> None:
    """Add the options for drawing surfaces and lines."""
    group = parser.add_argument_group("look")
    group.add_argument("--mode", choices=MODES, help="what the pixels show; lit by default")
    group.add_argument("--unlit", action="store_true", help="the same as --mode unlit")
    _add_lines(group)
    _add_line_shapes(group)
    _add_texture_filters(group)
    _add_smoothing(group)
    group.add_argument(
        "--normals",
        choices=get_args(Normals),
        help="which normals to shade with: the model's (auto, the default), one per vertex "
        "(smooth), one per face (flat), or one per face and one light, that of its middle (facet)",
    )
    _add_visibility(group)


def _add_visibility(group) -> None:
    """Add what is drawn, and in which order."""
    group.add_argument(
        "--cull",
        choices=get_args(FrameCull),
        help="which faces to leave out; by default (auto) none of models, but the backs of what is "
        "closed, which do not show; in glTF and scenes the backs",
    )
    group.add_argument(
        "--culling",
        choices=get_args(Culling),
        help="what is left out before it is drawn: what is outside of the view, faces away or is "
        "hidden (all, the default; always: tried in every frame), only nodes outside of the view, "
        "found by a tree of boxes (tree) or by testing each box (frustum), or nothing (none); the "
        "picture is the same",
    )
    group.add_argument(
        "--hidden-surfaces",
        choices=get_args(HiddenSurfaces),
        help="method of hidden-surface removal: depth buffer (the default), painter's algorithm "
        "(drawing from far to near), or none",
    )
    group.add_argument(
        "--shading",
        choices=get_args(Shading),
        help="shade visible pixels once (the default) or every fragment; the picture is the same",
    )


def _add_texture_filters(group) -> None:
    """Add how textures are read."""
    group.add_argument(
        "--anisotropy",
        type=values.anisotropy,
        metavar="N",
        help="read textures at up to N places a pixel, 1 to 16, where surfaces recede; by default "
        "as they say, and 8 where they say nothing",
    )
    group.add_argument(
        "--lod-bias",
        type=values.lod_bias,
        metavar="B",
        help="added to the level of detail of textures: less than 0 is sharper and flickers more; "
        "by default as they say, and -0.25 where they say nothing",
    )


def _add_smoothing(group) -> None:
    """Add what keeps details that are finer than pixels from flickering."""
    group.add_argument(
        "--specular-antialiasing",
        action=argparse.BooleanOptionalAction,
        help="highlights are wider where normals differ within a pixel, so that "
        "small highlights do not flicker; on by default",
    )
    group.add_argument(
        "--alpha-to-coverage",
        action=argparse.BooleanOptionalAction,
        help="with multisampling, masks have edges as smooth as those of faces; on by default",
    )


def _add_lines(group) -> None:
    """Add edges, lines and points."""
    group.add_argument(
        "--wireframe",
        nargs="?",
        const=WIREFRAMES[-1],
        choices=WIREFRAMES,
        help="draw the edges: overlay over the faces, only (or no value) without them",
    )
    group.add_argument("-e", "--edges", action="store_true", help="the same as --wireframe overlay")
    group.add_argument(
        "--hidden-lines",
        action="store_true",
        help="in a wireframe, draw the edges that faces hide as well",
    )
    group.add_argument(
        "--line-width",
        type=values.width,
        metavar="PIXELS",
        help="width of lines and edges, up to 256; see --size-unit",
    )
    group.add_argument(
        "--line-color",
        type=values.color,
        metavar="COLOR",
        help="colour of the edges; by default dark over faces, and in contrast to the background "
        "without them",
    )
    group.add_argument(
        "--point-size",
        type=values.width,
        metavar="PIXELS",
        help="size of points, up to 256; by default larger the fewer points there are",
    )


def _add_line_shapes(group) -> None:
    """Add the shapes and the unit of lines and points."""
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


def appearance_of(args: argparse.Namespace) -> dict:
    """Return the fields of `Appearance` set by options of the same names."""
    if args.unlit and args.mode not in (None, "unlit"):
        raise UsageError(f"--unlit does not go with --mode {args.mode}")
    if args.edges and args.wireframe == "only":
        raise UsageError("--edges does not go with --wireframe only")
    from ....stage.appearance import DEFAULTS

    named = {name: value for name, value in vars(args).items() if name in DEFAULTS}
    if args.unlit:
        named["mode"] = "unlit"
    if args.edges:
        named["wireframe"] = "overlay"
    return {
        name: value
        for name, value in named.items()
        # A switch that isn't set leaves the value to the scene; one that is on can be set off.
        if value is not None and (value is not False or DEFAULTS[name] is True)
    }


def filtering(args: argparse.Namespace):
    """Return the `Filtering` that the options name."""
    from ....stage.filtering import Filtering

    return Filtering(anisotropy=args.anisotropy, lod_bias=args.lod_bias, is_usual=True)

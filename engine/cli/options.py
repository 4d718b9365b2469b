"""The options that commands share, and the types of their values.

In: an argparse parser. Out: the same parser with options; `settings` and `place_view` turn what was
parsed into what the viewer takes. Spellings follow f3d where it has the option.
"""

from __future__ import annotations

import argparse
import functools
import math
import re
from typing import get_args

from ..choices import (
    Backend,
    Culling,
    FrameCull,
    HiddenSurfaces,
    Mode,
    OutputMode,
    Shading,
    Wireframe,
)
from . import ambient_options, antialiasing, backdrop_options, scalar_options, values
from .environment_options import surroundings
from .filter_options import add_line_shapes, add_texture_filters, filtering
from .input_options import add_inputs, check_inputs
from .inputs import model_files
from .light_options import SHADOWS
from .loading_bar import LoadingBar
from .outputs import not_the_output
from .usage import UsageError

#: How models are shown; the first is the default.
LOOKS = tuple(antialiasing.PICTURES)
MODES = (*get_args(Mode), *get_args(OutputMode))
BACKENDS = get_args(Backend)
WIREFRAMES = get_args(Wireframe)
SCENES = (
    *("default", "vertices", "edges", "faces", "cube", "shapes"),
    *("textured", "asc", "city", "solar", "spheres", "lod", "parcels"),
)
#: Options whose value may start with a minus sign, which argparse would take for an option.
SIGNED_OPTIONS = frozenset(
    {
        "--up",
        "--light-position",
        "--light-direction",
        "--camera-position",
        "--camera-focal-point",
        "--camera-view-up",
        "--camera-direction",
        "--camera-azimuth-angle",
        "--camera-elevation-angle",
        "--environment-rotation",
        "--lod-bias",
        "--range",
        "--coloring-range",
        "--camera-index",
        "--animation-index",
        "--animation-time",
        "--section",
    }
)
_SIGNED_VALUE = re.compile(r"-(\.?\d|[XYZxyz]($|=)|inf|nan)")


def join_values(arguments: list[str]) -> list[str]:
    """Return the arguments with values joined to options where argparse would take them wrongly.

    ``--camera-position -1,2,3`` becomes ``--camera-position=-1,2,3``, and ``--wireframe MODEL``,
    whose value may be left out, becomes ``--wireframe=only MODEL``.
    """
    joined: list[str] = []
    for argument in arguments:
        option = joined[-1] if joined else ""
        if option in SIGNED_OPTIONS and _SIGNED_VALUE.match(argument):
            joined[-1] += "=" + argument
        elif option == "--wireframe" and argument not in WIREFRAMES:
            joined[-1] += "=" + WIREFRAMES[-1]
            joined.append(argument)
        else:
            joined.append(argument)
    return joined


# Groups of options


def add_viewed_scene(parser) -> None:
    """Add what to show."""
    group = parser.add_argument_group("what to show")
    group.add_argument(
        "models",
        metavar="MODEL",
        nargs="*",
        help="model files, or folders of them; - for standard input. Several are shown together, "
        "each where it places itself, or one by one: see --multi-file-mode",
    )
    add_inputs(group)
    group.add_argument(
        "--side-by-side",
        action="store_true",
        help="stand several models in a row, upright and in their own sizes",
    )
    group.add_argument(
        "--scene", choices=SCENES, metavar="NAME", help=f"a scene: {', '.join(SCENES)}"
    )
    group.add_argument(
        "--triangles",
        type=values.city_triangles,
        metavar="N",
        help="with --scene city: about how many triangles, 20,000 to 50,000,000",
    )
    group.add_argument(
        "--dusk",
        action="store_true",
        help="with --scene city: let the sun set, and lamps and windows shine",
    )
    group.add_argument(
        "--texture",
        metavar="FILE",
        help="texture for a model without materials; by default an image of the same name "
        "beside the model",
    )
    group.add_argument(
        "--color",
        type=values.color,
        metavar="COLOR",
        help="colour for a model, or for what in a scene is, without materials",
    )
    group.add_argument(
        "--animation-index",
        type=values.index,
        metavar="N",
        help="which animation of the model plays, from 0 on; -1 for all of them together",
    )
    group.add_argument(
        "--animation-time",
        type=values.number,
        metavar="T",
        help="seconds of the animation at which the model stands, or begins to play",
    )
    group.add_argument(
        "--variant",
        metavar="NAME",
        help="which of the sets of materials that the model offers, by name or number",
    )
    group.add_argument(
        "--crease-angle",
        type=values.crease_angle,
        metavar="DEGREES",
        help="where a model has no normals, draw edges sharp whose faces meet at more than this; "
        "35 by default, 180 makes all smooth, 0 all flat",
    )
    group.add_argument(
        "--no-texture", action="store_true", help="leave textures out; light and colours stay"
    )
    group.add_argument(
        "--verbose",
        action="store_true",
        help="print what is loaded and how long loading and each frame take",
    )


def add_quiet(parser) -> None:
    """Add what says less."""
    parser.add_argument("--quiet", action="store_true", help="print errors only, no warnings")


def add_drawing(group) -> None:
    """Add what draws."""
    group.add_argument(
        "--backend",
        choices=BACKENDS,
        default="auto",
        help="instruction set to draw with; auto is the fastest. All give the same picture",
    )
    group.add_argument(
        "--threads",
        type=values.thread_count,
        default=0,
        metavar="N",
        help="number of threads; 0, the default, is one per available CPU",
    )


def add_picture(parser) -> None:
    """Add the picture's size and what draws it."""
    group = parser.add_argument_group("picture")
    group.add_argument(
        "--resolution",
        type=values.resolution,
        metavar="WxH",
        help="size in pixels; 1280x720 by default",
    )
    group.add_argument(
        "--look",
        choices=LOOKS,
        default=LOOKS[0],
        help="studio: models stand on their shadow before a gradient, in soft light, with ambient "
        "occlusion, neutral tone mapping and 4 samples per pixel; plain: before one colour, with "
        "none of these. Other options have the last word",
    )
    antialiasing.add(group)
    add_drawing(group)
    group.add_argument(
        "--background-color",
        type=values.color,
        metavar="COLOR",
        help="R,G,B from 0 to 1 or from 0 to 255, #rrggbb, or a name; the same for every COLOR",
    )
    group.add_argument("-g", "--grid", action="store_true", help="show a grid under the model")
    group.add_argument("-x", "--axis", action="store_true", help="show the axes in the corner")
    group.add_argument(
        "-m",
        "--metadata",
        action="store_true",
        help="show what the file holds, as text in the picture",
    )
    group.add_argument(
        "--ui-scale",
        type=values.ui_scale,
        metavar="N",
        help="how many times larger texts are, 1 to 8; by default as the screen and the picture "
        "want it",
    )


def add_appearance(parser) -> None:
    """Add how surfaces and lines are drawn."""
    group = parser.add_argument_group("look")
    group.add_argument("--mode", choices=MODES, help="what the pixels show")
    group.add_argument("--unlit", action="store_true", help="the same as --mode unlit")
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
    add_line_shapes(group)
    add_texture_filters(group)
    normals = group.add_mutually_exclusive_group()
    normals.add_argument(
        "--flat",
        action="store_const",
        const="flat",
        dest="normals",
        help="shade with one normal per face",
    )
    normals.add_argument(
        "--smooth",
        action="store_const",
        const="smooth",
        dest="normals",
        help="shade with one normal per vertex",
    )
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


def add_up(group) -> None:
    """Add what is up."""
    group.add_argument(
        "--up",
        type=values.up_direction,
        metavar="±X|±Y|±Z",
        help="the model's up direction; +Y by default, +Z for CAD and printing formats "
        "(.3mf, .asc, .iges, .step, .stl)",
    )


def add_camera(parser) -> None:
    """Add where to look from."""
    group = parser.add_argument_group("camera")
    add_up(group)
    group.add_argument(
        "--camera-index",
        type=values.index,
        metavar="N",
        help="look through a camera of the model, from 0 on; -1 for none of them",
    )
    group.add_argument(
        "--camera-position", type=values.vector, metavar="X,Y,Z", help="position of the camera"
    )
    group.add_argument(
        "--camera-focal-point", type=values.vector, metavar="X,Y,Z", help="point to look at"
    )
    group.add_argument(
        "--camera-direction",
        type=values.direction,
        metavar="X,Y,Z",
        help="direction in which the camera looks; --camera-position has the last word",
    )
    group.add_argument(
        "--camera-view-up",
        type=values.direction,
        metavar="X,Y,Z",
        help="direction that points up in the picture",
    )
    group.add_argument(
        "--camera-view-angle",
        type=values.view_angle,
        metavar="DEGREES",
        help="vertical field of view",
    )
    group.add_argument(
        "--camera-azimuth-angle",
        type=values.number,
        metavar="DEGREES",
        help="move the camera around the model, to the right",
    )
    group.add_argument(
        "--camera-elevation-angle",
        type=values.number,
        metavar="DEGREES",
        help="move the camera around the model, upwards",
    )
    group.add_argument(
        "--camera-zoom-factor",
        type=values.positive,
        metavar="F",
        help="divide the distance from the focal point by this",
    )
    group.add_argument(
        "--camera-orthographic", action="store_true", help="use a parallel projection"
    )
    for plane in ("near", "far"):
        group.add_argument(
            f"--{plane}",
            type=values.positive,
            metavar="D",
            help=f"distance of the {plane} clip plane; by default it encloses what is shown",
        )


def add_run(parser) -> None:
    """Add the options of ``run`` alone."""
    group = parser.add_argument_group("window")
    group.add_argument(
        "--animate",
        action=argparse.BooleanOptionalAction,
        help="start with the scene's animation, or for a model a slow turn, playing",
    )
    group.add_argument(
        "--camera",
        choices=("orbit", "fps"),
        default="orbit",
        help="orbit around the model (the default), or walk with WASD and the mouse",
    )
    group.add_argument(
        "--walkable",
        type=values.names,
        metavar="NAME,…",
        help="walk on these materials of the model only",
    )
    group.add_argument(
        "--slope",
        type=values.slope,
        metavar="DEGREES",
        help="the steepest ground of the model that one walks on; 40 by default",
    )
    group.add_argument(
        "-z", "--fps", action="store_true", help="show frames per second and statistics"
    )
    group.add_argument(
        "--vsync",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="wait for the screen's refresh (on by default)",
    )
    group.add_argument(
        "--watch", action="store_true", help="load the model again when its file changes"
    )
    group.add_argument(
        "--headless", action="store_true", help="open no window; write an animation to a file"
    )
    group.add_argument(
        "--terminal",
        action="store_true",
        help="show it in the terminal, also over SSH: as kitty graphics, sixels or coloured text",
    )
    group.add_argument(
        "--frames",
        type=values.count,
        metavar="N",
        help="stop after N frames; with --headless, write N frames",
    )
    group.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="what --headless writes: .gif, .webp, .apng, .mp4, or numbered pictures like "
        "frame_%%04d.png or frame_{:04}.png; one picture if N is 1",
    )


def add_render(parser) -> None:
    """Add the options of ``render`` alone."""
    group = parser.add_argument_group("output")
    group.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help=".png, .jpg, .tga, .webp; - writes PNG to standard output, terminal: shows it there. "
        "{model}, {model.ext}, {model_ext}, {date}, {n} (the first number that is free; {n:3} has "
        "three digits), {app} and {version} are filled in; {{ is a brace",
    )
    group.add_argument(
        "--turntable",
        type=values.count,
        metavar="N",
        help="N pictures of one turn, to .gif, .webp, .apng, .mp4 (with engine3d[video]), or "
        "numbered pictures like frame_%%04d.png or frame_{:04}.png",
    )
    group.add_argument(
        "--animation",
        type=values.count,
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


# What was parsed


def settings(args: argparse.Namespace):
    """Return the `Settings` that the options name."""
    from ..viewer.settings import Settings

    if args.unlit and args.mode not in (None, "unlit"):
        raise UsageError(f"--unlit does not go with --mode {args.mode}")
    if args.edges and args.wireframe == "only":
        raise UsageError("--edges does not go with --wireframe only")
    if args.light_position is not None and args.light_direction is not None:
        raise UsageError("--light-position and --light-direction do not go together")
    if None not in (args.near, args.far) and args.near >= args.far:
        raise UsageError("--near must be less than --far")
    appearance = {
        "mode": "unlit" if args.unlit else args.mode,
        "wireframe": "overlay" if args.edges else args.wireframe,
        "cull": args.cull,
        "culling": args.culling,
        "shading": args.shading,
        "normals": args.normals,
        "hidden_surfaces": args.hidden_surfaces,
        "line_width": args.line_width,
        "line_color": args.line_color,
        "hidden_lines": args.hidden_lines or None,
        "point_size": args.point_size,
        "line_shape": args.line_shape,
        "point_shape": args.point_shape,
        "size_unit": args.size_unit,
        "tone_mapping": args.tone_mapping,
        "bloom": args.bloom,
        **ambient_options.appearance_of(args),
    }
    return Settings(
        look=args.look,
        appearance={name: value for name, value in appearance.items() if value is not None},
        up=args.up,
        background=backdrop_options.background(args),
        **backdrop_options.fog(args),
        light_position=args.light_position,
        light_direction=args.light_direction,
        light_intensity=args.light_intensity,
        light_clamp=args.light_clamp,
        shadow=None if args.shadows is None else SHADOWS[args.shadows],
        surroundings=surroundings(args),
        exposure=args.exposure,
        textures=not args.no_texture,
        filtering=filtering(args),
        near=args.near,
        far=args.far,
        grid=args.grid,
        axes=args.axis,
        **scalar_options.shown(args),
        metadata=args.metadata,
        ui_scale=args.ui_scale,
    )


def place_view(args: argparse.Namespace, view_renderer, *, turns: bool = True):
    """Return the first view of the scene, as the camera options say.

    Where they leave it open, all of the scene shows: however it turns, or filling the picture.
    """
    from ..viewer.near_origin import from_file

    if args.camera_view_angle is None:
        view = view_renderer.view()
    else:
        view = view_renderer.view(math.radians(args.camera_view_angle))
    view.orthographic = args.camera_orthographic
    if args.camera_index is not None and args.camera_index >= 0:
        return _through_camera(args, view_renderer, view)
    if args.camera_view_up is not None:
        view.up = args.camera_view_up
    place = functools.partial(from_file, view_renderer.viewed)
    focal_point = None
    if args.camera_focal_point is not None:
        focal_point = place(args.camera_focal_point)
    if args.camera_position is not None:
        if args.camera_position == args.camera_focal_point:
            raise UsageError("--camera-position and --camera-focal-point are the same")
        view.look_from(place(args.camera_position), focal_point or view_renderer.bounds.center)
    elif args.camera_direction is not None:
        view.look_from(view.target - args.camera_direction, view.target)
    view.azimuth += math.radians(args.camera_azimuth_angle or 0.0)
    view.elevation += math.radians(args.camera_elevation_angle or 0.0)
    if args.camera_position is None:
        (view_renderer.frame if turns else view_renderer.fill)(view)
        if args.camera_focal_point is not None:
            view.target[:] = focal_point
    view.distance /= args.camera_zoom_factor or 1.0
    return view


def _through_camera(args: argparse.Namespace, view_renderer, view):
    """Return the view of one of the scene's cameras."""
    from ..scene.cameras import Camera
    from ..viewer.viewpoint import look_through

    title, scene = view_renderer.viewed.title, view_renderer.viewed.scene
    nodes = [node for node in scene.nodes if isinstance(node.object, Camera)]
    if args.camera_index >= len(nodes):
        known = f"the last is {len(nodes) - 1}" if nodes else "there are none"
        raise UsageError(f"{title} has no camera {args.camera_index} ({known})")
    look_through(view, nodes[args.camera_index], view_renderer.bounds)
    return view


#: Options that say how models are read or dressed; built-in scenes are neither.
OF_MODELS = (
    *("texture", "variant", "animation_index", "animation_time", "crease_angle"),
    *("force_reader", "max_size", *scalar_options.COLORING),
)


def viewed_scene(args: argparse.Namespace, default_scene: str | None = None):
    """Return the `ViewedScene` that the options name; ``default_scene`` if they name none."""
    if args.models and args.scene is not None:
        raise UsageError("give a MODEL or --scene, not both")
    if args.side_by_side and len(args.models) < 2:
        raise UsageError("--side-by-side needs several MODELs")
    if args.triangles is not None and args.scene != "city":
        raise UsageError("--triangles goes with --scene city")
    if args.dusk and args.scene != "city":
        raise UsageError("--dusk goes with --scene city")
    if not args.models:
        for option in OF_MODELS:
            given = getattr(args, option, None)
            if given is not None and given is not False:  # 0 is given, too
                raise UsageError(f"--{option.replace('_', '-')} needs a MODEL")
        if args.scene is None and default_scene is None:
            raise UsageError("give a MODEL or --scene NAME")
        from ..demos import load_demo

        how = {} if args.triangles is None else {"triangles": args.triangles}
        how |= {"dusk": True} if args.dusk else {}
        viewed = load_demo(args.scene or default_scene, **how)
        if args.color is not None:
            from ..viewer.open_model import dress_scene

            dress_scene(viewed.scene, args.color)
        return viewed
    from ..viewer.open_models import open_models

    check_inputs(args)
    with LoadingBar() as progress:
        return open_models(model_files(args.models), **opening(args), progress=progress)


def opening(args: argparse.Namespace) -> dict:
    """Return how the options say that models are to be opened."""
    creases = {} if args.crease_angle is None else {"crease_angle": args.crease_angle}
    return {
        **creases,
        "format": args.force_reader,
        "scalars": scalar_options.coloring(args),
        "side_by_side": args.side_by_side,
        "up": args.up,
        "texture": args.texture,
        "color": args.color,
        "companion": not_the_output(args.output),
        "variant": _variant(args.variant),
        "animation": _animation(args),
    }


def _variant(given: str | None) -> str | int | None:
    """A name, or a number where it is one."""
    return int(given) if given is not None and given.isdecimal() else given


def _animation(args: argparse.Namespace):
    """Return what lets a model that is opened play its animations, or stand at a time of them."""
    from ..viewer.clips import play_clips, stand_at

    plays = getattr(args, "animation", None) is not None or args.command == "run"
    asked = args.animation_index is not None or args.animation_time is not None
    if plays:
        return lambda viewed: play_clips(viewed, args.animation_index)
    if asked and getattr(args, "turntable", None) is None:
        return lambda viewed: stand_at(viewed, args.animation_index, args.animation_time or 0.0)
    return (lambda viewed: play_clips(viewed, args.animation_index)) if asked else None

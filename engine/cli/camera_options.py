"""The options of where to look from, and the view that they name."""

from __future__ import annotations

import argparse
import functools
import math

from . import values
from .usage import UsageError


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


def place_view(args: argparse.Namespace, view_renderer, *, turns: bool = True):
    """Return the first view of the scene, as the camera options say.

    Where they leave it open, all of the scene shows: however it turns, or filling the picture.
    """
    from ..stage.near_origin import from_file

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
    from ..stage.viewpoint import look_through

    title, scene = view_renderer.viewed.title, view_renderer.viewed.scene
    nodes = [node for node in scene.nodes if isinstance(node.object, Camera)]
    if args.camera_index >= len(nodes):
        known = f"the last is {len(nodes) - 1}" if nodes else "there are none"
        raise UsageError(f"{title} has no camera {args.camera_index} ({known})")
    look_through(view, nodes[args.camera_index], view_renderer.bounds)
    return view

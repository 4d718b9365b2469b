"""The options of the camera."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from .. import values
from ..usage import UsageError

if TYPE_CHECKING:
    from ....stage.views.first_view import FirstView


def add_up(group) -> None:
    """Add the option for the up direction."""
    group.add_argument(
        "--up",
        type=values.up_direction,
        metavar="±X|±Y|±Z",
        help="the model's up direction; +Y by default, +Z for CAD and printing formats "
        "(.3mf, .asc, .iges, .step, .stl)",
    )


def add_camera(parser) -> None:
    """Add the options of the camera."""
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
        "--camera-yfov",
        type=values.yfov,
        metavar="DEGREES",
        help="vertical field of view; by default the longer side of the picture has 38 degrees",
    )
    group.add_argument(
        "--camera-azimuth-angle",
        type=values.number,
        metavar="DEGREES",
        help="move the camera around the model, to the right; 0 by default, 30° from the front",
    )
    group.add_argument(
        "--camera-elevation-angle",
        type=values.number,
        metavar="DEGREES",
        help="move the camera around the model, upwards; 0 by default, 18° above the middle",
    )
    group.add_argument(
        "--camera-zoom-factor",
        type=values.positive,
        metavar="F",
        help="divide the distance from the focal point by this; 1 by default",
    )
    group.add_argument(
        "--camera-orthographic", action="store_true", help="use a parallel projection"
    )
    group.add_argument(
        "--camera-lens",
        metavar="FILE",
        help="look through the lens of a calibration: JSON of ROS, nerfstudio, COLMAP or a scene "
        "file, or COLMAP's cameras.txt",
    )
    for plane in ("near", "far"):
        group.add_argument(
            f"--{plane}",
            type=values.positive,
            metavar="D",
            help=f"distance of the {plane} clip plane; by default it encloses what is shown",
        )


def lens_of(args: argparse.Namespace):
    """Return the lens of a calibration, and the size that it is for; None for what there is not."""
    path = args.camera_lens
    if path is None:
        return None, None
    if args.camera_orthographic:
        raise UsageError("--camera-lens and --camera-orthographic do not go together")
    from ....io.camera_files import load_calibration
    from ....model.scene.cameras import IntrinsicsCamera
    from ....model.scene.lenses.lens_camera import LensCamera

    camera, size = load_calibration(path)
    if not isinstance(camera, LensCamera | IntrinsicsCamera):
        raise UsageError(f"--camera-lens: {path} holds no lens, but a {type(camera).__name__}")
    return camera, size


def first_view(args: argparse.Namespace, lens) -> FirstView:
    """Return the first view that the options describe, through a lens or None."""
    from ....stage.views.first_view import FirstView

    angle, index, position = args.camera_yfov, args.camera_index, args.camera_position
    through = index is not None and index >= 0
    if not through and position is not None and position == args.camera_focal_point:
        raise UsageError("--camera-position and --camera-focal-point are the same")
    return FirstView(
        yfov=None if angle is None else math.radians(angle),
        azimuth=math.radians(args.camera_azimuth_angle or 0.0),
        elevation=math.radians(args.camera_elevation_angle or 0.0),
        zoom=args.camera_zoom_factor or 1.0,
        orthographic=args.camera_orthographic,
        position=position,
        focal_point=args.camera_focal_point,
        direction=args.camera_direction,
        up=args.camera_view_up,
        camera=index if through else None,
        lens=lens,
    )

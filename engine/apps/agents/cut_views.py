"""Cuts through an agent's scene: a plane across an axis takes away what is before it.

In: an axis and a place. Out: a camera whose near plane is the cut, and the cut faces, painted.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ...model.measuring.cutting import Plane
from ...model.scene.cameras import Camera
from ...rendering.frame import Frame
from ...rendering.support_functions import support_of_box, support_of_scene
from ...stage.scene_bounds import sphere_of_box
from ..sheet.caps import Caps, find_caps, paint_caps
from ..sheet.layout import Padding, Rectangle
from ..sheet.placing import cut_obliquely, find_extent, place_camera
from ..sheet.views import parse_section
from .shown_scene import Shown
from .view_cameras import ViewChoice, camera_axes

_KEYS = ("axis", "at")
#: Free pixels around a cut object, as a fraction of the picture's sides.
_ROOM = 0.06
#: How far the plane may be from the model's box, in radii of the model.
_BESIDE = 0.01
#: A plane seen more steeply than this shows no cut, as a cosine.
_EDGE_ON = 0.05


class Cut(NamedTuple):
    """A cut that is seen by a camera."""

    plane: Plane
    camera: Camera
    pose: NDArray[np.float64]
    rectangle: Rectangle


def cut_scene(shown_: Shown, section: Any, choice: ViewChoice, size: tuple[int, int]) -> Cut:
    """Return the cut through a scene that a view shows, by a parallel projection.

    Parameters
    ----------
    shown_ : Shown
    section : dict
        ``axis``: "x", "y" or "z"; ``at``: a coordinate, or a share such as "50%", the default.
    choice : ViewChoice
    size : (int, int)

    Raises
    ------
    InvalidArgumentError
        It is no section, or the view shows its plane from the edge.
    """
    if not isinstance(section, dict) or not set(section) <= set(_KEYS) or "axis" not in section:
        raise InvalidArgumentError(
            f'section must be like {{"axis": "x", "at": "50%"}}, not {shown(section)}'
        )
    parsed = parse_section(f"{section['axis']}={section.get('at', '50%')}")
    axes = camera_axes(shown_, choice)
    towards = float(axes[parsed.axis, 2])
    if abs(towards) < _EDGE_ON:
        raise InvalidArgumentError(
            f"section: the view {choice.name!r} shows a plane across {section['axis']} from the "
            "edge: look from another side"
        )
    bounds = np.asarray(shown_.viewed.scene.bounds, np.float64)
    sphere = sphere_of_box(bounds)
    low, high = shown_.bounds[:, parsed.axis].tolist()
    beside = sphere.radius * _BESIDE
    coordinate = min(max(parsed.coordinate(low, high), low - beside), high + beside)
    plane = Plane(parsed.axis, coordinate - float(shown_.origin[parsed.axis]), towards > 0.0)
    support = support_of_scene(shown_.viewed.scene) or support_of_box(bounds)
    extent = find_extent(support, bounds.mean(axis=0), axes)
    rectangle = Rectangle(0, 0, *size)
    room = round(min(size) * _ROOM)
    rooms = [
        (side - 2 * room) / length
        for side, length in zip(size, extent.size[:2], strict=True)
        if length
    ]
    padding = Padding(room, room, room, room)
    scale = min(rooms, default=1.0)
    camera, pose = place_camera(extent, sphere, rectangle, padding, scale)
    return Cut(plane, cut_obliquely(camera, pose, rectangle, plane, bounds), pose, rectangle)


def show_caps(shown_: Shown, cut: Cut, frame: Frame) -> Caps:
    """Paint the cut faces over a frame, whose IDs show them, too."""
    caps = find_caps(shown_.viewed.scene.nodes, cut.plane, cut.camera, cut.pose, cut.rectangle)
    paint_caps(frame.color, caps.ids)
    is_cut = caps.ids >= 0
    frame.object_id[is_cut] = caps.ids[is_cut]
    frame.instance_id[is_cut], frame.face_id[is_cut] = 0, -1
    return caps

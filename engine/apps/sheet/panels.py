"""One panel of a sheet: its drawing, counts and report data.

In: a view with its place on the sheet, a studio. Out: pixels on the sheet, and a `Panel` that keeps
what the report and questions about pixels need.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...base import linalg
from ...model.measuring.cutting import Plane
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...rendering.canvas import Canvas
from ...rendering.frame import Frame
from ...stage.blank import Reason, reason_of
from ...stage.overlays.lettering import text_font
from ...stage.overlays.theme import DARK, LIGHT, Theme
from .caps import Caps, find_caps, paint_caps
from .hidden import AloneScene
from .layout import Padding, Rectangle
from .outlines import draw_outlines
from .panel_renderer import PanelRenderer
from .placing import (
    Extent,
    Matrices,
    cut,
    cut_obliquely,
    find_matrices,
    place_camera,
    section_plane,
)
from .views import ViewSpec
from .visible import SAME_COLOUR, box_of, contrast

#: The instance number of cut faces, which no other object has.
_CUT = 0x7FFFFFFF
# Code values above this are bright.
_MIDDLE = 127.5


@dataclass
class Panel:
    """A view on the sheet.

    Attributes
    ----------
    spec : ViewSpec
    rectangle : Rectangle
    extent : Extent
    camera, pose
        In the scene.
    scale : float or None
        Pixels per world unit; None with perspective.
    matrices : Matrices
    pose_in_file : (4, 4) ndarray of float64
        The pose in the file's coordinates.
    frame : Frame
        What was drawn.
    shown : (H, W) ndarray of bool
        Where it shows nodes of the scene's own.
    caps : Caps or None
        Where a section goes through something.
    alone : dict
        Pixels of nodes without the others, see `AloneScene`.
    reason : Reason or None
        Why nothing is seen.
    contrast : int
    """

    spec: ViewSpec
    rectangle: Rectangle
    extent: Extent
    camera: Camera
    pose: np.ndarray
    scale: float | None
    matrices: Matrices
    pose_in_file: np.ndarray
    frame: Frame
    shown: np.ndarray
    caps: Caps | None = None
    alone: dict[int, int | None] = field(default_factory=dict)
    reason: Reason | None = None
    contrast: int = 0

    def theme(self, paper: Theme) -> Theme:
        """Return the theme whose texts can be read on the panel."""
        if not self.spec.is_picture:
            return paper
        corner = self.frame.color[: 2 * text_font(1).line_height, :, :3]
        return LIGHT if float(corner.mean()) > _MIDDLE else DARK

    @property
    def box(self) -> tuple[int, int, int, int] | None:
        """Bounding box of the visible pixels in the panel."""
        return box_of(self.shown)


@dataclass(frozen=True)
class Place:
    """The place of a view on the sheet, and its scale; see `Panel`."""

    spec: ViewSpec
    rectangle: Rectangle
    extent: Extent
    padding: Padding
    scale: float


def draw_panel(
    studio: PanelRenderer,
    place: Place,
    canvas: Canvas,
    alone: AloneScene,
    cameras: list[Node],
    origin: tuple[float, float, float],
) -> Panel:
    """Draw a panel on the sheet and return it.

    Parameters
    ----------
    studio : PanelRenderer
    place : Place
    canvas : Canvas
        Over the sheet.
    alone : AloneScene
    cameras : list of Node
        Those of the file.
    origin : (float, float, float)
        Of the scene, in the file's coordinates.
    """
    spec, rectangle = place.spec, place.rectangle
    camera, pose, scale = _camera(studio, place, cameras, origin)
    if spec.is_picture:
        frame = studio.picture(camera, pose, rectangle)
    else:
        frame = studio.draw(camera, pose, rectangle, both_sides=spec.section is not None)
    shown = studio.staged.own_pixels(frame.object_id)
    panel = Panel(
        spec,
        rectangle,
        place.extent,
        camera,
        pose,
        scale,
        find_matrices(camera, pose, rectangle, origin),
        linalg.multiply(linalg.translation(origin), pose),
        frame,
        shown,
    )
    if spec.section is not None:
        plane = _plane(studio, spec, origin)
        panel.caps = find_caps(studio.scene.nodes, plane, camera, pose, rectangle)
        _show_caps(panel, plane, origin)
    if not spec.is_picture:
        _ink(panel, studio)
    _look_for_reasons(panel, studio)
    options = studio.options(rectangle, both_sides=spec.section is not None)
    panel.alone = alone.count(camera, pose, rectangle, options)
    x, y, width, height = rectangle
    canvas.pixels[y : y + height, x : x + width] = frame.color
    return panel


def _show_caps(panel: Panel, plane: Plane, origin) -> None:
    """Make the outputs of a frame show cut faces instead of what is behind them."""
    ids, frame = panel.caps.ids, panel.frame
    rows, columns = np.nonzero(ids >= 0)
    nodes = ids[rows, columns]
    other = frame.object_id[rows, columns] != nodes
    frame.material_id[rows[other], columns[other]] = 0
    frame.object_id[rows, columns], frame.face_id[rows, columns] = nodes, -1
    # The intersections of the lines of sight with the plane.
    across, down, away, start = panel.matrices.world_from_pixel[plane.axis].tolist()
    x, y = columns + (panel.rectangle.x + 0.5), rows + (panel.rectangle.y + 0.5)
    goal = plane.coordinate + origin[plane.axis]
    frame.depth[rows, columns] = (goal - start - x * across - y * down) / away
    panel.shown[rows, columns] = True


def _look_for_reasons(panel: Panel, studio: PanelRenderer) -> None:
    """Find out whether the panel is blank, and if so, why."""
    panel.contrast = _contrast(studio, panel)
    if not panel.shown.any():
        panel.reason = reason_of(studio.sight(panel.camera, panel.pose, panel.rectangle))
    elif panel.contrast <= SAME_COLOUR:
        panel.reason = Reason("same_colour", "what shows has the colour of the ground")


def _camera(studio: PanelRenderer, place: Place, cameras: list[Node], origin):
    spec = place.spec
    if spec.camera is not None:
        node = cameras[spec.camera]
        return node.object, np.array(node.world_pose), None
    camera, pose = place_camera(
        place.extent, studio.sphere, place.rectangle, place.padding, place.scale
    )
    plane = _plane(studio, spec, origin)
    if spec.kind == "section":
        camera, pose = cut(camera, pose, plane.axis, plane.coordinate)
    elif spec.kind == "cutaway":
        camera = cut_obliquely(camera, pose, place.rectangle, plane, studio.bounds)
    return camera, pose, place.scale


def _plane(studio: PanelRenderer, spec: ViewSpec, origin) -> Plane | None:
    if spec.section is None:
        return None
    return section_plane(spec.section, studio.bounds, studio.sphere.radius, origin)


def _contrast(studio: PanelRenderer, panel: Panel) -> int:
    ground = studio.paper.background
    if panel.spec.is_picture:
        # The ground is what pictures show in their lower left corner, beside the model.
        red, green, blue, _ = panel.frame.color[-1, 0].tolist()
        ground = red, green, blue
    return contrast(panel.frame, panel.shown, ground)


def _ink(panel: Panel, studio: PanelRenderer) -> None:
    """Draw a panel's outlines, and the cut faces of a section."""
    box = panel.box
    if box is None:
        return
    # One more pixel on all sides, where the lines end.
    left, top = max(box[0] - 1, 0), max(box[1] - 1, 0)
    window = slice(top, box[1] + box[3] + 1), slice(left, box[0] + box[2] + 1)
    frame = panel.frame
    things = (frame.object_id[window].astype(np.int64) << 32) + frame.instance_id[window]
    # Points and lines get no outlines.
    things = np.where(panel.shown[window] & (frame.face_id[window] >= 0), things, -1)
    depth, normals = frame.depth[window], frame.world_normal[window]
    if panel.caps is not None:
        ids = panel.caps.ids[window]
        is_cut = ids >= 0
        paint_caps(frame.color[window], ids)
        things = np.where(is_cut, (ids << 32) + _CUT, things)
        normals = np.where(is_cut[..., np.newaxis], np.float32(1), normals)
    normals = None if studio.has_normal_maps else normals
    draw_outlines(frame.color[window], things, depth, normals, panel.scale)

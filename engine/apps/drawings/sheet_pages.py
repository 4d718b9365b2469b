"""Pages of line drawings: a model from several sides to scale, with a frame and a title block.

In: an opened model, views, a page. Out: a `Page`, with a group for each view. The layout is that of
contact sheets, in tenths of a millimetre.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...errors import InvalidArgumentError, warn
from ...model.measuring.cutting import cut_nodes
from ...model.scene.cameras import Camera
from ...rendering.support_functions import support_of_scene
from ...stage.overlays.lengths import length_text
from ...stage.scene_bounds import sphere_of_box
from ...stage.viewed_scene import ViewedScene
from ...stage.views.viewpoint import UP_DIRECTIONS
from ..sheet.layout import Padding, Reach, Rectangle, lay_out
from ..sheet.marks import short
from ..sheet.placing import (
    Extent,
    cut,
    cut_obliquely,
    find_extents,
    fitting_scale,
    place_camera,
    section_plane,
    warn_of_misses,
)
from ..sheet.views import ViewSpec
from .chains import chained
from .cut_faces import Cap, cap_of
from .line_drawing import LineDrawing, layers_of
from .model_lines import section_lines
from .paper import Group, Page, Strokes, Text
from .pdf import text_width
from .pieces import find_pieces
from .projections import matrix_of, projection_onto
from .styles import FRAME, HATCHING, THIN
from .surfaces import Surfaces, surfaces_of
from .units import PAGES, millimetres, scale_text, usual_scale

#: Millimetres left free at the left of the frame, and at its other sides (ISO 5457).
_BINDING, _MARGIN = 20.0, 10.0
#: Millimetres: the title block, the gap between views, the hatching, heights of letters.
_BLOCK = (180.0, 22.0)
_GAP, _HATCH = 5.0, 3.0
_LARGE, _SMALL = 5.0, 2.5
#: Units of the layout in a millimetre.
_TENTHS = 10.0
#: Of panels, in tenths of a millimetre.
_DRAWING, _PICTURE = Padding(140, 100, 60, 140), Padding(40, 100, 40, 40)
#: Views that are not to scale get this share of the room they would need.
_SHARE = 0.8
#: Millimetres: arrows of dimensions, and their distance from the drawing.
_ARROW, _AWAY = 2.5, 6.0


class Look(NamedTuple):
    """How drawings of a page look.

    Attributes
    ----------
    hidden : bool
    crease_angle : float
        Radians.
    intersections : bool
    line_width : float
        Factor on the widths of lines.
    threads : int
    """

    hidden: bool
    crease_angle: float
    intersections: bool
    line_width: float
    threads: int


class _View(NamedTuple):
    """A view on the page: its place, and pixels of the layout per world unit."""

    spec: ViewSpec
    rectangle: Rectangle
    extent: Extent
    padding: Padding
    scale: float


class SheetPage:
    """The page of a model.

    Parameters
    ----------
    model : ViewedScene
    up : str
        A key of `UP_DIRECTIONS`.
    unit : str or None
    look : Look

    Attributes
    ----------
    scale : float
        That of the page, once it is drawn.
    """

    def __init__(self, model: ViewedScene, up: str, unit: str | None, look: Look) -> None:
        self._model, self._look, self._unit = model, look, unit
        self._length = millimetres(unit)
        self._up = up
        self._bounds = np.array(model.scene.bounds, np.float64)
        self._sphere = sphere_of_box(self._bounds)
        self._cameras = [node for node in model.scene.nodes if isinstance(node.object, Camera)]
        self.scale = 1.0

    @np.errstate(all="ignore")
    def draw(self, specs: list[ViewSpec], page: str, scale: float | None) -> Page:
        """Return the page with its views.

        Parameters
        ----------
        specs : list of ViewSpec
        page : str
            A key of `PAGES`.
        scale : float or None
            By default the largest usual one at which all fits.
        """
        width, height = PAGES[page]
        surfaces, omitted = surfaces_of(self._model.scene, self._look.crease_angle)
        for sentence in omitted:
            warn(sentence)
        made = Page(width, height, self._model.title)
        for view in self._views(specs, width, height, scale):
            made.groups.append(self._group(len(made.groups), view, surfaces))
        made.groups.append(self._title(page, width, height))
        return made

    def _views(
        self, specs: list[ViewSpec], width: float, height: float, scale: float | None
    ) -> list[_View]:
        for spec in specs:
            if spec.camera is not None and spec.camera >= len(self._cameras):
                raise InvalidArgumentError(f"views: the model has no camera {spec.camera}")
        warn_of_misses(specs, self._bounds, self._model.origin)
        up = np.array(UP_DIRECTIONS[self._up], np.float64)
        extents = find_extents(specs, support_of_scene(self._model.scene), self._bounds, up)
        area = Rectangle(
            round((_BINDING + _GAP) * _TENTHS),
            round((_MARGIN + _GAP) * _TENTHS),
            round((width - _BINDING - _MARGIN - 2 * _GAP) * _TENTHS),
            round((height - 2 * _MARGIN - 2 * _GAP - _BLOCK[1]) * _TENTHS),
        )
        reaches = []
        for spec, extent in zip(specs, extents, strict=True):
            share = 1.0 if spec.to_scale else _SHARE
            reaches.append(Reach(extent.size[0] * share, extent.size[1] * share))
        columns = 2 if len(specs) == 4 else None
        rectangles, largest = lay_out(area, reaches, _DRAWING, round(_GAP * _TENTHS), columns)
        shown = self._chosen_scale(largest, scale)
        views = []
        for spec, extent, rectangle in zip(specs, extents, rectangles, strict=True):
            padding = _DRAWING if spec.to_scale else _PICTURE
            own = shown if spec.to_scale else fitting_scale(extent, rectangle, padding)
            views.append(_View(spec, rectangle, extent, padding, own))
        return views

    def _chosen_scale(self, largest: float, scale: float | None) -> float:
        """Return the layout's units per world unit, and keep the page's scale."""
        if not np.isfinite(largest):
            return _TENTHS * self._length  # the model is a point
        fitting = largest / (_TENTHS * self._length)
        self.scale = usual_scale(fitting) if scale is None else scale
        if self.scale > fitting * (1.0 + 1e-9):
            raise InvalidArgumentError(
                f"scale: the views do not fit the page at {scale_text(self.scale)}; they do at "
                f"{scale_text(usual_scale(fitting))}"
            )
        return self.scale * _TENTHS * self._length

    def _group(self, number: int, view: _View, surfaces: Surfaces) -> Group:
        x, y, width, height = (side / _TENTHS for side in view.rectangle)
        group = Group(f"view-{number + 1}", view.spec.name, x=x, y=y, clip=(width, height))
        pixels = view.rectangle.width, view.rectangle.height
        camera, pose, caps = self._camera(view)
        projection = projection_onto((width, height), matrix_of(camera, pixels), pose)
        ids = {cap.node: part for part, cap in enumerate(caps, len(surfaces.names))}
        names = [*surfaces.names, *(self._name(node) for node in ids)]
        pieces = find_pieces(
            surfaces,
            projection,
            intersections=self._look.intersections,
            threads=self._look.threads,
            more_lines=[section_lines(cap.outline, ids[cap.node]) for cap in caps],
            caps=[cap.triangles for cap in caps],
        )
        drawing = LineDrawing((width, height), pieces, names, view.spec.name)
        hatching = []
        for cap in caps:
            ends = projection.on_paper(cap.hatching.reshape(-1, 3))[:, :2].reshape(-1, 2, 2)
            hatching.append(Strokes(self._name(cap.node), chained(ends)))
        if any(one.polylines for one in hatching):
            group.layers.append((HATCHING, hatching))
        group.layers += layers_of(drawing, self._look.hidden, self._look.line_width)
        title = short(view.spec.name, max(int(width / 2.0), 8), len)
        group.texts.append(Text(1.0, 4.0, title, _SMALL + 1.0))
        if not len(pieces.ends):
            group.texts.append(Text(1.0, 8.0, "no lines", _SMALL))
        if view.spec.to_scale:
            _dimension(group, view, self._unit)
        return group

    def _name(self, node: int) -> str:
        return next(one.name for one in self._model.scene.nodes if one.id == node)

    def _camera(self, view: _View) -> tuple[Camera, np.ndarray, list[Cap]]:
        spec = view.spec
        if spec.camera is not None:
            node: Any = self._cameras[spec.camera]
            return node.object, np.array(node.world_pose), []
        place = view.extent, self._sphere, view.rectangle, view.padding, view.scale
        camera, pose = place_camera(*place)
        if spec.section is None:
            return camera, pose, []
        radius, origin = self._sphere.radius, self._model.origin
        plane = section_plane(spec.section, self._bounds, radius, origin)
        spacing = _HATCH * _TENTHS / view.scale
        caps = []
        for outline in cut_nodes(self._model.scene.nodes, plane):
            cap = cap_of(outline, plane, spacing)
            if cap is None:
                warn(f"{self._name(outline.node)}: its cut is too intricate to be filled")
            else:
                caps.append(cap)
        if spec.kind == "section":
            return *cut(camera, pose, plane.axis, plane.coordinate), caps
        oblique = cut_obliquely(camera, pose, view.rectangle, plane, self._bounds)
        return oblique, pose, caps

    def _title(self, page: str, width: float, height: float) -> Group:
        """Return the frame of the page and its title block."""
        group = Group("page", "")
        left, right = _BINDING, width - _MARGIN
        top, bottom = _MARGIN, height - _MARGIN
        x, y, middle = right - _BLOCK[0], bottom - _BLOCK[1], right - 50.0
        frame = [_rectangle(left, top, right, bottom), _rectangle(x, y, right, bottom)]
        group.layers.append((FRAME, [Strokes("", frame)]))
        thin = [
            _line(middle, y, middle, bottom),
            _line(middle, (y + bottom) / 2, right, (y + bottom) / 2),
        ]
        group.layers.append((THIN, [Strokes("", thin)]))
        columns = int((middle - x) / (0.55 * _LARGE))
        sizes = " x ".join(length_text(float(s), None) for s in self._bounds[1] - self._bounds[0])
        unit = self._unit or "mm"
        told = f"X x Y x Z: {sizes} {unit}. {self._up} is up"
        group.texts += [
            Text(x + 3.0, y + 9.0, short(self._model.title, columns, len), _LARGE),
            Text(x + 3.0, bottom - 4.0, told, _SMALL),
            Text(middle + 3.0, y + 7.5, f"Scale {scale_text(self.scale)}", _LARGE - 1.0),
            Text(middle + 3.0, bottom - 4.0, f"{page}, lengths in {unit}", _SMALL),
        ]
        return group


def _steps(*places: float) -> list[int]:
    return [round(place * 1000.0) for place in places]


def _line(*ends: float) -> list[tuple[int, int]]:
    x, y, to_x, to_y = _steps(*ends)
    return [(x, y), (to_x, to_y)]


def _rectangle(*sides: float) -> list[tuple[int, int]]:
    left, top, right, bottom = _steps(*sides)
    return [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)]


def _dimension(group: Group, view: _View, unit: str | None) -> None:
    """Add the width and the height of a drawing, below and at its left."""
    pad, scale = view.padding, view.scale / _TENTHS
    width, height = view.rectangle.width / _TENTHS, view.rectangle.height / _TENTHS
    x = (pad.left / _TENTHS + width - pad.right / _TENTHS) / 2
    y = (pad.top / _TENTHS + height - pad.bottom / _TENTHS) / 2
    across, upward, _ = view.extent.size
    left, right = x - across * scale / 2, x + across * scale / 2
    top, bottom = y - upward * scale / 2, y + upward * scale / 2
    lines: list[list[tuple[int, int]]] = []
    if across > 0.0:
        level = bottom + _AWAY
        lines += [_line(left, level, right, level)]
        lines += [_line(end, bottom + 1.0, end, level + 1.0) for end in (left, right)]
        if right - left > 2.5 * _ARROW:
            lines += [*_arrow(left, level, 1, 0), *_arrow(right, level, -1, 0)]
        text = length_text(across, unit)
        half = text_width(text, _SMALL) / 2
        middle = max(x, half + 0.5)
        group.texts.append(Text(middle, level + _SMALL + 0.8, text, _SMALL, "middle"))
    if upward > 0.0:
        level = left - _AWAY
        lines += [_line(level, top, level, bottom)]
        lines += [_line(left - 1.0, end, level - 1.0, end) for end in (top, bottom)]
        if bottom - top > 2.5 * _ARROW:
            lines += [*_arrow(level, top, 0, 1), *_arrow(level, bottom, 0, -1)]
        text = length_text(upward, unit)
        group.texts.append(Text(level - 0.8, y, text, _SMALL, "middle", is_upward=True))
    if lines:
        group.layers.append((THIN, [Strokes("", lines)]))


def _arrow(x: float, y: float, right: int, down: int) -> list[list[tuple[int, int]]]:
    """Return the strokes of an arrow's head, whose tip is at a place."""
    aside = _ARROW * 0.17
    return [
        _line(x, y, x + right * _ARROW + down * side, y + down * _ARROW + right * side)
        for side in (aside, -aside)
    ]

"""The pages of a sheet: each model's title, panels, dimensions and scale.

In: opened models and views. Out: a canvas with all of them, their panels and reports. Only lengths
and file names are written, nothing about the machine or the time.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ...base.image_size import check_size
from ...errors import InvalidArgumentError, printable
from ...model.materials.material import Material
from ...model.scene.cameras import Camera
from ...rendering.canvas import Canvas
from ...rendering.support_functions import support_of_scene
from ...stage.look import Look
from ...stage.overlays.lengths import length_text
from ...stage.overlays.lettering import heading_font, text_font
from ...stage.viewed_scene import ViewedScene
from ...stage.views.viewpoint import UP_DIRECTIONS
from . import marks
from .hidden import AloneScene
from .layout import Padding, Reach, Rectangle, lay_out
from .panel_renderer import PanelRenderer
from .panels import Panel, Place, draw_panel
from .placing import Extent, find_extents, fitting_scale, place_camera, warn_of_misses
from .report import ModelReport
from .views import ViewSpec

SIZE, SIZE_OF_SEVERAL = (1600, 1200), (1600, 480)
MOST_ROWS = 16384
_LARGE = 1400  # pages at least this high get larger text
_WIDE = 900  # if they are also this wide
#: Pixels, times the text scale: page margin, gap between panels, title, last line.
_MARGIN, _GAP, _TITLE, _FOOT = 16, 10, 40, 30
_DRAWING = Padding(56, 30, 20, 56)
_PICTURE = Padding(14, 26, 14, 14)
#: Views without scale get this fraction of the room they would need.
_SHARE = 0.8


class Dress(NamedTuple):
    """How models are drawn; see `PanelRenderer`."""

    drawing: Mapping[str, Any]
    look: Look
    material: Material | None
    marks: Mapping[str, Any]


class Pages(NamedTuple):
    """The drawn panels and reports, model by model."""

    canvas: Canvas
    panels: list[list[Panel]]
    reports: list[dict[str, Any]]


def draw_pages(
    models: list[ViewedScene],
    specs: list[ViewSpec],
    size: tuple[int, int] | None,
    up: str | None,
    unit: str | None,
    dress: Dress,
) -> Pages:
    """Draw all models; see `engine3d.sheets.contact_sheet`."""
    if up is not None and up not in UP_DIRECTIONS:
        raise InvalidArgumentError(f"up must be one of {', '.join(UP_DIRECTIONS)}, not {up!r}")
    if unit is not None and not isinstance(unit, str):
        raise InvalidArgumentError(f"unit must be a text, not {type(unit).__name__}")
    if size is None:
        size = SIZE if len(models) == 1 else SIZE_OF_SEVERAL
    width, height = check_size(size)
    if height * len(models) > MOST_ROWS:
        raise InvalidArgumentError(
            f"size: {len(models)} parts of {height} rows are more than {MOST_ROWS} rows"
        )
    canvas = Canvas((width, height * len(models)))
    panels, reports = [], []
    for number, model in enumerate(models):
        area = Rectangle(0, number * height, width, height)
        columns = len(specs)
        if len(models) == 1:
            columns = 2 if len(specs) == 4 else None
        page = _Page(canvas, area, model, up or model.up, unit)
        drawn, report = page.draw(specs, columns, dress)
        panels.append(drawn)
        reports.append(report)
    return Pages(canvas, panels, reports)


class _Page:
    """The part of a sheet for one model."""

    def __init__(
        self, canvas: Canvas, area: Rectangle, model: ViewedScene, up: str, unit: str | None
    ) -> None:
        self._canvas, self._area, self._model = canvas, area, model
        self._up = model.up = up
        self._unit = model.unit or None if unit is None else printable(unit)
        large = area.height >= _LARGE and area.width >= _WIDE
        self._text = 2 if large else 1

    def draw(self, specs, columns: int | None, dress: Dress) -> tuple[list[Panel], dict[str, Any]]:
        scene, text = self._model.scene, self._text
        cameras = [node for node in scene.nodes if isinstance(node.object, Camera)]
        self._check_cameras(specs, cameras)
        studio = PanelRenderer(self._model, self._up, *dress)
        alone = AloneScene(scene)
        warn_of_misses(specs, studio.bounds, self._model.origin)
        extents = find_extents(specs, support_of_scene(scene), studio.bounds, studio.up)
        x, y, width, height = self._area
        margin, title, foot = (side * text for side in (_MARGIN, _TITLE, _FOOT))
        room = Rectangle(x + margin, y + title, width - 2 * margin, height - title - foot)
        reaches = _reaches(specs, extents)
        rectangles, scale = lay_out(room, reaches, self._padding(_DRAWING), _GAP * text, columns)
        with studio:
            self._choose_paper(studio, extents[0])
            self._canvas.rectangle(x, y, width, height, (*studio.paper.background, 255))
            panels = []
            for spec, extent, rectangle in zip(specs, extents, rectangles, strict=True):
                place = self._place(spec, extent, rectangle, scale)
                origin = self._model.origin
                panels.append(draw_panel(studio, place, self._canvas, alone, cameras, origin))
            report = ModelReport(self._model, studio, self._unit)
            told = report.as_dict(self._up, panels)
        for panel in panels:
            self._mark_panel(panel, studio)
        self._write_title(told, studio)
        self._write_foot(told, scale, studio)
        return panels, told

    def _check_cameras(self, specs, cameras) -> None:
        for spec in specs:
            if spec.camera is not None and spec.camera >= len(cameras):
                known = f"the last is {len(cameras) - 1}" if cameras else "there are none"
                raise InvalidArgumentError(
                    f"views: {self._model.title} has no camera {spec.camera} ({known})"
                )

    def _padding(self, padding: Padding) -> Padding:
        return Padding(*(side * self._text for side in padding))

    def _choose_paper(self, studio: PanelRenderer, extent: Extent) -> None:
        if studio.has_faces:
            return  # lines separate drawings of faces from any background
        area = Rectangle(0, 0, 160, 120)
        scale = fitting_scale(extent, area, Padding(0, 0, 0, 0))
        studio.choose_paper(*place_camera(extent, studio.sphere, area, Padding(0, 0, 0, 0), scale))

    def _place(self, spec, extent: Extent, rectangle: Rectangle, scale: float) -> Place:
        if spec.to_scale:
            return Place(spec, rectangle, extent, self._padding(_DRAWING), scale)
        padding = self._padding(_PICTURE)
        own = fitting_scale(extent, rectangle, padding)
        return Place(spec, rectangle, extent, padding, own)

    def _mark_panel(self, panel: Panel, studio: PanelRenderer) -> None:
        canvas, text = self._canvas, self._text
        theme = panel.theme(studio.paper)
        x, y, width, height = panel.rectangle
        window = Canvas(canvas.pixels[y : y + height, x : x + width])
        if panel.spec.to_scale:
            self._draw_dimensions(window, panel, studio)
        corner = 28 * text
        if panel.spec.camera is None:
            marks.draw_triad(window, corner, height - corner, panel.pose[:3, :3], theme, text)
        font, room = text_font(text), width - 16 * text
        name = marks.short(printable(panel.spec.name), room, font.width)
        window.text(8 * text, 5 * text, name, theme.title, font=font)
        if panel.reason is not None:
            place = font.width(name) + 14 * text
            reason = f"blank: {panel.reason.sentence}"
            if font.width(reason) > room - place:
                reason = marks.short(f"blank: {panel.reason.word}", room - place, font.width)
            window.text(8 * text + place, 5 * text, reason, theme.key, font=font)
        marks.draw_frame(canvas, panel.rectangle, studio.paper)

    def _draw_dimensions(self, window: Canvas, panel: Panel, studio: PanelRenderer) -> None:
        across, upward, _ = panel.extent.size
        text, theme, pad = self._text, studio.paper, self._padding(_DRAWING)
        _, _, width, height = panel.rectangle
        middle = (pad.left + width - pad.right) / 2, (pad.top + height - pad.bottom) / 2
        half = across * panel.scale / 2, upward * panel.scale / 2
        left, right = middle[0] - half[0], middle[0] + half[0]
        top, bottom = middle[1] - half[1], middle[1] + half[1]
        if across > 0.0:
            length = length_text(across, self._unit)
            marks.draw_width(window, left, right, round(bottom) + 14 * text, length, theme, text)
        if upward > 0.0:
            length = length_text(upward, self._unit)
            marks.draw_height(window, top, bottom, round(left) - 14 * text, length, theme, text)

    def _write_title(self, told: dict[str, Any], studio: PanelRenderer) -> None:
        x, y, width, _ = self._area
        text, theme = self._text, studio.paper
        heading, font, room = heading_font(text), text_font(text), width - 2 * _MARGIN * text
        title, facts = marks.short(told["title"], room, heading.width), _facts(told)
        self._canvas.text(x + _MARGIN * text, y + 6 * text, title, theme.text, font=heading)
        if heading.width(title) + font.width(facts) + 2 * _MARGIN * text <= room:
            place = x + width - _MARGIN * text - font.width(facts)
            self._canvas.text(place, y + 13 * text, facts, theme.text, font=font)

    def _write_foot(self, told: dict[str, Any], scale: float, studio: PanelRenderer) -> None:
        x, y, width, height = self._area
        text, theme = self._text, studio.paper
        row = y + height - (_FOOT - 8) * text
        end = x + _MARGIN * text
        if any(view["to_scale"] for view in told["views"]) and told["bounds"] is not None:
            end = marks.draw_scale_bar(self._canvas, end, row, scale, self._unit, theme, text)
        line = _sizes(told, self._unit)
        font = text_font(text)
        place = x + width - _MARGIN * text - font.width(line)
        if place >= end + 2 * _MARGIN * text:
            self._canvas.text(place, row, line, theme.text, font=font)


def _reaches(specs, extents) -> list[Reach]:
    """Return the extent that each view needs in the layout, in world units."""
    reaches = []
    for spec, extent in zip(specs, extents, strict=True):
        share = 1.0 if spec.to_scale else _SHARE
        reaches.append(Reach(extent.size[0] * share, extent.size[1] * share))
    return reaches


def _facts(told: dict[str, Any]) -> str:
    kinds = [kind for kind in ("triangles", "lines", "points") if told[kind]] or ["triangles"]
    numbers = [(told[kind], kind) for kind in kinds]
    numbers += [(len(told[kind]), kind) for kind in ("nodes", "materials")]
    counted = [f"{number:,} {kind[:-1] if number == 1 else kind}" for number, kind in numbers]
    if told["format"]:
        counted.insert(0, told["format"])
    return "   ".join(counted)


def _sizes(told: dict[str, Any], unit: str | None) -> str:
    if told["bounds"] is None:
        return f"no size   {told['up']} is up"
    sizes = " x ".join(length_text(size, None) for size in told["bounds"]["size"])
    return f"X × Y × Z   {sizes}{' ' + unit if unit else ''}   {told['up']} is up"

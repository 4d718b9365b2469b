"""The panel that measures: distances, angles and circles between clicked points, surfaces of parts.

In: clicks on the model, also by keys, which snap to corners and edges. Out: marks over the
picture, and texts.
"""

from __future__ import annotations

import numpy as np

from ....base.language import translated
from ....measuring import measure
from ....model.scene.scene import Scene
from ....model.scene.shown import placing_pose, shown_object
from ....model.spatial.rays import RayHit
from ....stage.overlays.measurements import (
    KINDS,
    Measurement,
    measurement_text,
    surface_text,
)
from ..list_panels import HIDDEN, SHOWN, Row
from .pointing_panel import PointingPanel
from .snapping import snap

_SURFACE = "surface"
_WORDS = {
    "distance": "distance: 2 points",
    "angle": "angle: 3 points",
    "circle": "circle: 3 points",
    _SURFACE: "area and volume: a part",
}
_CLEAR = "clear"


class MeasuringPanel(PointingPanel):
    """Measures by clicks while it is open; the marks stay when Escape closes it.

    Parameters
    ----------
    viewer : ViewerState
    """

    title = "Measure"
    hint = "Tab, arrows, Enter; Escape keeps the marks"
    takes_clicks = True
    shows_cross = False

    def __init__(self, viewer) -> None:
        super().__init__(viewer)
        self._kind = "distance"
        self._points = np.zeros((0, 3))
        marked = viewer.view_renderer.settings.measured
        self._done = [measured for measured in marked if measured.is_complete]
        self._surface: list[str] = []

    def rows(self) -> list[Row]:
        rows = [
            Row(f"{SHOWN if kind == self._kind else HIDDEN} {translated(words)}")
            for kind, words in _WORDS.items()
        ]
        unit = self.viewer.view_renderer.viewed.unit
        told = [measurement_text(measured, unit) for measured in self._done]
        return [*rows, Row(translated(_CLEAR)), *map(Row, self._surface), *map(Row, told)]

    def press(self, number: int, alone: bool) -> None:
        if number < len(_WORDS):
            self._kind = list(_WORDS)[number]
        elif number == len(_WORDS):
            self._done, self._surface = [], []
        self._points = self._points[:0]
        self._mark()

    def key(self, event) -> bool:
        if event.control or event.key not in ("Tab", "Delete"):
            return super().key(event)
        kinds = list(_WORDS)
        step = -1 if event.shift else 1
        following = (kinds.index(self._kind) + step) % len(kinds)
        self.press(following if event.key == "Tab" else len(kinds), False)
        self.viewer.redraw()
        return True

    def point(self, x: int, y: int, shift: bool) -> None:
        self.take(x, y)

    def take(self, x: int, y: int) -> bool:
        viewer = self.viewer
        hit = viewer.view_renderer.pick(viewer.view, viewer.time, x, y)
        if hit is None or not np.isfinite(hit.position).all():
            viewer.say("measure: there is no surface here")
        elif self._kind == _SURFACE:
            self._measure_part(hit)
        else:
            self._add(hit)
        viewer.redraw()
        return True

    def _add(self, hit: RayHit) -> None:
        """Take another point; with enough of them, note what they measure."""
        viewer = self.viewer
        found = snap(hit, viewer.frame, viewer.view_renderer.text_scale(viewer.frame))
        point = found.point + np.array(viewer.view_renderer.viewed.origin)
        self._points = np.concatenate([self._points, point[np.newaxis]])
        left = KINDS[self._kind] - len(self._points)
        if not left:
            self._done.append(Measurement(self._kind, self._points))
            self._points = self._points[:0]
            unit = viewer.view_renderer.viewed.unit
            viewer.say(measurement_text(self._done[-1], unit))
        else:
            viewer.say("{kind}; {count} more", kind=translated(found.kind), count=left)
        self._mark()

    def _measure_part(self, hit: RayHit) -> None:
        alone = Scene()
        alone.add(shown_object(hit.node), pose=placing_pose(hit.node))
        name = hit.node.name or translated("object {number}", number=hit.node.id)
        unit = self.viewer.view_renderer.viewed.unit
        self._surface = [name, *surface_text(measure(alone), unit)]

    def _mark(self) -> None:
        """Draw what is measured, in screenshots as well."""
        now = Measurement(self._kind, self._points)
        begun = (now,) if len(self._points) else ()
        self.viewer.view_renderer.settings.measured = (*self._done, *begun)

    def forget(self) -> None:
        self._points, self._done, self._surface = self._points[:0], [], []

    def end(self) -> None:
        self.viewer.view_renderer.settings.measured = ()
        super().end()

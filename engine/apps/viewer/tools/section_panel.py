"""The panel of the section: axis, place, which side is cut off."""

from __future__ import annotations

from ....base.language import translated
from ....stage.overlays.lengths import length_text
from ..list_panels import HIDDEN, SHOWN, Row
from .slider_panel import SliderPanel

_AXES = "XYZ"


class SectionPanel(SliderPanel):
    """Cuts the model while it is open, and after it was closed with Escape.

    Parameters
    ----------
    viewer : ViewerState
    """

    title = "Section"
    hint = "X Y Z F arrows; Escape keeps the cut"
    slider = 4

    def __init__(self, viewer) -> None:
        super().__init__(viewer)
        self.viewer.inspector.is_cut = True
        self.viewer.inspector.arrange()

    def rows(self) -> list[Row]:
        cut, unit = self.viewer.inspector, self.viewer.view_renderer.viewed.unit
        axis = _AXES[cut.axis]
        side = translated("greater {axis}" if cut.from_above else "smaller {axis}", axis=axis)
        return [
            Row(f"{SHOWN if cut.is_cut else HIDDEN} {translated('cut the model')}"),
            Row(translated("across the axis"), axis),
            Row(translated("cut off"), side),
            Row(translated("place"), f"{axis} = {length_text(cut.place, unit)}"),
            Row(""),
            Row(cut.state_of_cuts()),
        ]

    def share(self) -> float:
        return self.viewer.inspector.share

    def slide(self, share: float) -> None:
        self.viewer.inspector.share = share
        self.viewer.inspector.arrange()

    def choose(self, number: int) -> None:
        cut = self.viewer.inspector
        if number == 0:
            cut.is_cut = not cut.is_cut
        elif number == 1:
            cut.axis = (cut.axis + 1) % 3
        elif number == 2:
            cut.from_above = not cut.from_above
        cut.arrange()

    def key(self, event) -> bool:
        cut = self.viewer.inspector
        if event.key in tuple(_AXES) and not event.control:
            cut.axis = _AXES.index(event.key)
        elif event.key == "F" and not event.control:
            cut.from_above = not cut.from_above
        else:
            return super().key(event)
        cut.arrange()
        return True

    def end(self) -> None:
        self.viewer.inspector.is_cut = False
        self.viewer.inspector.arrange()
        super().end()

"""The panel that moves the parts of the model apart."""

from __future__ import annotations

from ....base.language import translated, translated_count
from ..list_panels import Row
from .slider_panel import SliderPanel

#: How far parts are moved at the right end of the slider.
_MOST = 2.0
#: How far they are moved when the panel opens.
_FIRST = 0.5


class ExplosionPanel(SliderPanel):
    """Moves the parts apart while it is open, and after it was closed with Escape.

    Parameters
    ----------
    viewer : ViewerState
    """

    title = "Explode"
    hint = "arrows: farther, nearer; Escape keeps it"
    slider = 2

    def __init__(self, viewer) -> None:
        super().__init__(viewer)
        if not viewer.inspector.amount:
            viewer.inspector.amount = _FIRST
        viewer.inspector.arrange()

    def rows(self) -> list[Row]:
        inspector = self.viewer.inspector
        return [
            Row(translated("together again")),
            Row(
                translated_count("{count:,} part", "{count:,} parts", inspector.parts),
                translated("moved by {amount:.2f}", amount=inspector.amount),
            ),
            Row(""),
        ]

    def share(self) -> float:
        return self.viewer.inspector.amount / _MOST

    def slide(self, share: float) -> None:
        self.viewer.inspector.amount = share * _MOST
        self.viewer.inspector.arrange()

    def choose(self, number: int) -> None:
        if number == 0:
            self.slide(0.0)

    def end(self) -> None:
        self.slide(0.0)
        super().end()

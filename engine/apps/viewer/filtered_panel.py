"""A list over the picture that typed text filters, and keys or clicks choose from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...base.language import translated
from ...errors import printable
from .list_panels import ChoosingPanel

if TYPE_CHECKING:
    from .viewer import Viewer


class FilteredPanel(ChoosingPanel):
    """A filtered list.

    Attributes
    ----------
    filter : str
        The typed text.
    """

    def __init__(self, viewer: Viewer):
        super().__init__(viewer)
        self.filter = ""

    def heads(self, left_out: int) -> list[str]:
        return [*super().heads(left_out), translated("filter: {text}_", text=self.filter)]

    def key(self, event) -> bool:
        """Handle all keys but those with Ctrl and the window's own, such as F11."""
        if event.control:
            return False
        if event.key == "Backspace":
            self._rub_out()
        elif event.key == "Tab":
            self._change_list()
        elif not super().key(event):
            typed = len(event.key) == 1 or event.key == "Space" or event.key.startswith("Keypad")
            return typed  # its text arrives as a separate event
        self.viewer.redraw_controls()
        return True

    def type(self, text: str) -> None:
        self.set_filter(self.filter + printable(text))

    def set_filter(self, text: str) -> None:
        """Show only what contains a text."""
        self.filter, self._follows = text, True
        self.chosen = next(iter(self.choices()), 0)
        self.viewer.redraw_controls()

    def _rub_out(self) -> None:
        self.set_filter(self.filter[:-1])

    def _change_list(self) -> None:
        """Switch to another list, if there is one."""

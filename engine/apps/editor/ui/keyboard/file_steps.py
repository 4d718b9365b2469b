"""The way of arrow keys through the files of a dialog, while its name is typed.

In: the listed files, keys. Out: the name of a file.
"""

from __future__ import annotations

from collections.abc import Sequence

from .....base.files.folder_listing import Item
from ..translated_imgui import imgui
from .row_in_view import scroll_to_row


class FileSteps:
    """Steps from file to file.

    Attributes
    ----------
    items : sequence of Item
        Those that are listed.
    """

    def __init__(self) -> None:
        self.items: Sequence[Item] = ()
        self._scrolls = False
        self._typed = self._reached = ""

    def typed_before(self, name: str) -> str:
        """Return what was typed before arrow keys led to a name; "" if they did not."""
        return self._typed if name == self._reached else ""

    def _place(self, name: str) -> int | None:
        names = [item.name for item in self.items]
        return names.index(name) if name in names else None

    def step(self, data) -> int:
        """Replace the name in a text field by the one that an arrow key leads to."""
        if self.items and not imgui.get_io().key_alt:
            if data.buf != self._reached:
                self._typed = data.buf
            step = -1 if data.event_key == imgui.Key.up_arrow else 1
            place = self._place(data.buf)
            place = min(step, 0) if place is None else place + step
            data.delete_chars(0, data.buf_text_len)
            self._reached = self.items[place % len(self.items)].name
            data.insert_chars(0, self._reached)
            data.select_all()
            self._scrolls = True
        return 0

    def scroll_to(self, name: str) -> None:
        """Scroll to a file that an arrow key led to, within the list."""
        place = self._place(name) if self._scrolls else None
        self._scrolls = False
        if place is not None:
            scroll_to_row(place, covered=2)

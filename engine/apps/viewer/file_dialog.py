"""The viewer's file dialog: folders, and recently opened files.

In: keys, typed text and clicks. Out: a file that the viewer opens. Typed text filters both lists;
Tab switches between them.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from ...base.files.folder_listing import Item, list_folder
from ...base.language import translated
from ...errors import printable
from ..desktop.recent_files import RecentFiles
from .filtered_panel import FilteredPanel
from .list_panels import Row
from .model_files import MODEL_EXTENSIONS

if TYPE_CHECKING:
    from .opened_files import Opening
    from .viewer import Viewer

COLUMNS, ROWS = 72, 16
UP = ".."
#: Each unit is a thousand of the one before.
SIZES = ("{size:.3g} B", "{size:.3g} kB", "{size:.3g} MB", "{size:.3g} GB", "{size:.3g} TB")


class _FilePanel(FilteredPanel):
    """A filtered list of paths."""

    corner = "middle"
    least_columns, most_columns, least_rows = COLUMNS, COLUMNS, ROWS

    def __init__(self, viewer: Viewer, opening: Opening):
        super().__init__(viewer)
        self._opening = opening

    def _open(self, path: str) -> None:
        self.close()
        self._opening.open([path])


class FolderPanel(_FilePanel):
    """The folders and models in a folder, initially that of the shown file."""

    title = "Open a model"
    hint = "Enter, click: open   Esc: close   type: filter   Tab: opened before"

    def __init__(self, viewer: Viewer, opening: Opening):
        super().__init__(viewer, opening)
        shown = opening.files.first()
        self._go(os.path.dirname(shown) if shown else os.getcwd())
        if shown:
            self._choose(shown)

    def _go(self, folder: str) -> None:
        before = getattr(self, "folder", folder)
        self._listing = list_folder(folder)
        self.folder = self._listing.path
        self.set_filter("")
        if os.path.dirname(before) == self.folder:
            self._choose(before)  # after going up, select the previous folder

    def _choose(self, path: str) -> None:
        """Select the row of a path, if it exists."""
        names = [item.name for item in self._items]
        if os.path.basename(path) in names:
            self.chosen = names.index(os.path.basename(path))

    def heads(self, left_out: int) -> list[str]:
        """Return also the current folder, shortened at its start."""
        title, *others = super().heads(left_out)
        path = printable(self.folder)
        path = path if len(path) <= COLUMNS else ".." + path[2 - COLUMNS :]
        reasons = [self._listing.reason] if self._listing.reason else []
        return [title, path, *others, *reasons]

    def set_filter(self, text: str) -> None:
        """Show only names that contain a text; a folder name that ends with a slash opens it."""
        self.filter, self._follows = text, True
        path = os.path.join(self.folder, os.path.expanduser(text))
        if text.endswith(("/", os.sep)) and os.path.isdir(path):
            self._go(os.path.normpath(path))
            return
        hidden = text.startswith(".")
        found = self._listing.filtered(MODEL_EXTENSIONS, text, hidden=hidden)
        above = Item(UP, os.path.dirname(self.folder), True, 0, 0.0)
        self._items = found if text else (above, *found)
        self.chosen = 0 if text or not found else 1
        self.viewer.redraw_controls()

    def rows(self) -> list[Row]:
        return [
            Row(printable(item.name) + "/" * item.is_folder, "" if item.is_folder else _size(item))
            for item in self._items
        ]

    def press(self, number: int, alone: bool) -> None:
        item = self._items[number]
        if item.is_folder:
            self._go(item.path)
        else:
            self._open(item.path)

    def _rub_out(self) -> None:
        if self.filter:
            super()._rub_out()
        else:
            self._go(os.path.dirname(self.folder))

    def _change_list(self) -> None:
        self.viewer.panel = RecentPanel(self.viewer, self._opening)


class RecentPanel(_FilePanel):
    """The recently opened files."""

    title = "Opened before"
    hint = "Enter, click: open   Esc: close   type: filter   Tab: folders"

    def __init__(self, viewer: Viewer, opening: Opening):
        super().__init__(viewer, opening)
        self._all = RecentFiles().paths()

    @property
    def _paths(self) -> list[str]:
        return [path for path in self._all if self.filter.casefold() in path.casefold()]

    def rows(self) -> list[Row]:
        return [
            Row(printable(os.path.basename(path)), printable(os.path.dirname(path)))
            for path in self._paths
        ]

    def press(self, number: int, alone: bool) -> None:
        self._open(self._paths[number])

    def _change_list(self) -> None:
        self.viewer.panel = FolderPanel(self.viewer, self._opening)


def _size(item: Item) -> str:
    """Return a file's size with at most four digits."""
    size, units = float(item.size), [*SIZES]
    while size >= 1000 and len(units) > 1:
        size /= 1000
        del units[0]
    return translated(units[0], size=size)

"""The file dialog: folders, file kinds, search, recent files, and a thumbnail.

In: the purpose of the file. Out: a path, passed to a callback.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable

from ....base.files.folder_listing import Item, Listing, list_folder
from ....base.language import translated, translated_number
from ...desktop.recent_files import RecentFiles
from ...imgui_painter.imgui_painter import ImguiPainter
from ..file_pictures import FilePictures
from .keyboard.file_steps import FileSteps
from .style import scaled
from .translated_imgui import imgui

_SIZE = 62, 30  # in heights of the font
#: Side of a thumbnail at scale 1.
PICTURE = 192


class LastFolders:
    """The folders where files were looked for last.

    Attributes
    ----------
    of_known, of_new : str
        Of files that are there, and of new ones.
    """

    def __init__(self) -> None:
        self.of_known = self.of_new = os.getcwd()
        self._beside = ""

    def go_beside(self, path: str) -> None:
        """Look for new files in the folder of a file, the first time that it is given."""
        if path != self._beside:
            self._beside, self.of_new = path, os.path.dirname(os.path.abspath(path))

    def note(self, folder: str, is_new: bool) -> None:
        """Note a folder; what is loaded often lies where nobody wants to save."""
        self.of_known = folder
        if is_new:
            self.of_new = folder


class FileDialog:
    """A dialog for choosing a file.

    Parameters
    ----------
    recent : RecentFiles
    painter : ImguiPainter
        Shows pictures of files.

    Attributes
    ----------
    is_waiting : bool
        Whether the picture of a file is being made: the next frame is another one.
    """

    def __init__(self, recent: RecentFiles, painter: ImguiPainter) -> None:
        self._recent, self._painter = recent, painter
        self._pictures = FilePictures(round(scaled(PICTURE)))
        self._picture, self._pixels = 0, None
        self._hovered = ""
        self.is_waiting = False
        self._title = ""
        self._opens = self._focuses = False
        self._proposed: str | None = None  # what a new file may be called
        self._steps = FileSteps()
        self._kinds: dict[str, tuple[str, ...]] = {}
        self._kind = ""
        self._others: tuple[str, ...] = ()
        self._answer: Callable[[str], object] = print
        self._listing = Listing("", (), "")
        self._last = LastFolders()
        self._name = ""
        self._search = ""

    def ask(
        self,
        title: str,
        kinds: dict[str, tuple[str, ...]],
        answer: Callable[[str], object],
        *,
        name: str | None = None,
        others: tuple[str, ...] = (),
        beside: str | None = None,
    ) -> None:
        """Open the dialog.

        Parameters
        ----------
        title : str
        kinds : dict of str to tuple of str
            Extensions by what the dialog calls them; the first is chosen.
        answer : callable
            Given the path.
        name : str, optional
            What a new file may be called; without it only files that are there can be chosen.
        others : tuple of str
            Extensions of a new file that are kept as entered; all others get the first of a kind.
        beside : str, optional
            A file in whose folder the first new file is looked for a place; the next ones where
            the last one was.
        """
        self._title, self._kinds, self._answer = title, kinds, answer
        self._kind = next(iter(kinds))
        self._proposed, self._name = name, name or ""
        self._others = others
        self._opens = self._focuses = True
        if beside is not None:
            self._last.go_beside(beside)
        self._go(self._last.of_new if self._is_new else self._last.of_known)

    def _go(self, folder: str) -> None:
        self._listing, self._search = list_folder(folder), ""
        self._last.note(self._folder, self._is_new)

    @property
    def _is_new(self) -> bool:
        return self._proposed is not None

    @property
    def _folder(self) -> str:
        return self._listing.path

    def draw(self) -> None:
        """Lay out the dialog, if it is open."""
        self.is_waiting = False
        if self._opens:
            imgui.open_popup(self._title)
            self._opens = False
        if not self._title:
            return
        height, room = imgui.get_font_size(), imgui.get_io().display_size
        size = [min(height * side, most) for side, most in zip(_SIZE, room, strict=True)]
        imgui.set_next_window_size(tuple(size), imgui.Cond_.appearing)
        shown, is_open = imgui.begin_popup_modal(self._title, True)
        if not is_open:
            self._title = ""
        if shown:
            self._draw_places()
            self._draw_lists()
            if self._title:  # not if a double click chose a file
                self._draw_answer()
            imgui.end_popup()

    def _draw_places(self) -> None:
        if imgui.button("Up"):
            self._go(os.path.dirname(self._folder))
        imgui.same_line()
        if imgui.button("Home"):
            self._go(os.path.expanduser("~"))
        imgui.same_line()
        imgui.set_next_item_width(-1.0)
        entered, folder = imgui.input_text(
            "##folder", self._folder, imgui.InputTextFlags_.enter_returns_true
        )
        if entered:
            self._go(folder)
        imgui.set_next_item_width(imgui.get_font_size() * 12)
        if imgui.begin_combo("##kind", translated(self._kind)):
            for kind in self._kinds:
                if imgui.selectable(translated(kind), kind == self._kind)[0]:
                    self._kind = kind
            imgui.end_combo()
        imgui.same_line()
        imgui.set_next_item_width(-1.0)
        _, self._search = imgui.input_text_with_hint("##search", "Search", self._search)

    def _draw_lists(self) -> None:
        below = -imgui.get_frame_height_with_spacing() * 1.5
        wide = imgui.get_content_region_avail().x
        self._hovered = ""
        if imgui.begin_child("recent", (imgui.get_font_size() * 10, below), _BORDERS):
            imgui.text_disabled("Opened lately")
            for path in self._recent.paths():
                if imgui.selectable(os.path.basename(path) + f"##{path}", False)[0]:
                    self._go(os.path.dirname(path))
                    self._name = os.path.basename(path)
                imgui.set_item_tooltip(path)
                if imgui.is_item_hovered():
                    self._hovered = path
        imgui.end_child()
        imgui.same_line()
        side = scaled(PICTURE) + 2 * imgui.get_style().window_padding.x
        shows = wide > 4 * side
        if imgui.begin_child("files", (-side * shows, below), _BORDERS):
            self._draw_table()
        imgui.end_child()
        if shows:
            imgui.same_line()
            if imgui.begin_child("picture", (0.0, below), _BORDERS):
                self._draw_picture()
            imgui.end_child()

    def _draw_picture(self) -> None:
        """Lay out the thumbnail of the file under the mouse, or else the chosen one."""
        path = self._hovered or os.path.join(self._folder, self._name)
        pixels, self.is_waiting = self._pictures.get(path) if path else (None, False)
        if pixels is None:
            imgui.text_disabled("..." if self.is_waiting else "no picture")
            return
        if pixels is not self._pixels:
            self._picture = self._picture or self._painter.add(pixels, opaque=True)
            self._painter.replace(self._picture, pixels, opaque=True)
            self._pixels = pixels
        imgui.image(imgui.ImTextureRef(self._picture), (scaled(PICTURE), scaled(PICTURE)))
        imgui.text_wrapped(os.path.basename(path))

    def _draw_table(self) -> None:
        if self._listing.reason:
            imgui.text_disabled(self._listing.reason)
        items = self._steps.items = self._listing.filtered(self._kinds[self._kind], self._search)
        if not imgui.begin_table("items", 3, imgui.TableFlags_.scroll_y):
            return
        fixed, height = imgui.TableColumnFlags_.width_fixed, imgui.get_font_size()
        imgui.table_setup_column("Name", imgui.TableColumnFlags_.width_stretch)
        imgui.table_setup_column("Size", fixed, 5 * height)
        imgui.table_setup_column("Changed", fixed, 8.5 * height)
        imgui.table_headers_row()
        self._steps.scroll_to(self._name)
        clipper = imgui.ListClipper()
        clipper.begin(len(items))
        while clipper.step():
            for item in items[clipper.display_start : clipper.display_end]:
                self._draw_item(item)
        imgui.end_table()

    def _draw_item(self, item: Item) -> None:
        imgui.table_next_row()
        imgui.table_next_column()
        flags = imgui.SelectableFlags_
        chosen = flags.span_all_columns | flags.allow_double_click | flags.no_auto_close_popups
        label = f"{item.name}{'/' * item.is_folder}"
        clicked, _ = imgui.selectable(label, item.name == self._name, chosen)
        if imgui.is_item_hovered() and not item.is_folder:
            self._hovered = item.path
        imgui.table_next_column()
        imgui.text_unformatted("" if item.is_folder else translated_number(item.size, ","))
        imgui.table_next_column()
        imgui.text_unformatted(time.strftime("%Y-%m-%d %H:%M", time.localtime(item.modified)))
        if not clicked:
            return
        twice = imgui.is_mouse_double_clicked(0)
        if not item.is_folder:
            self._name = item.name
            if twice:
                self._finish()
        elif twice:
            self._go(item.path)
        elif not self._is_new:  # a new file's name stays
            self._name = item.name

    def _draw_answer(self) -> None:
        imgui.set_next_item_width(-imgui.get_font_size() * 12)
        if self._focuses:
            imgui.set_keyboard_focus_here()
            self._focuses = False
        flags = imgui.InputTextFlags_
        how = flags.enter_returns_true | flags.auto_select_all | flags.callback_history
        entered, self._name = imgui.input_text("##name", self._name, how, self._steps.step)
        path = os.path.join(self._folder, self._name)
        imgui.same_line()
        imgui.begin_disabled(not self._name or not (self._is_new or os.path.exists(path)))
        pressed = imgui.button(self._title.split()[0])
        imgui.end_disabled()
        goes_up = imgui.get_io().key_alt and imgui.is_key_pressed(imgui.Key.up_arrow)
        if goes_up:
            self._enter(os.path.dirname(self._folder))
        elif (pressed or entered) and self._name and os.path.isdir(path):
            self._enter(path)
        elif (pressed or entered) and self._name:
            self._finish()
        imgui.same_line()
        if imgui.button("Cancel") or imgui.is_key_pressed(imgui.Key.escape):
            self._close()

    def _enter(self, folder: str) -> None:
        """Go to a folder; the name of a new file stays."""
        typed = self._steps.typed_before(self._name) if self._is_new else ""
        self._go(folder)
        self._name, self._focuses = typed or self._proposed or "", True

    def _finish(self) -> None:
        path = os.path.join(self._folder, self._name)
        extensions = self._kinds[self._kind]
        known = (*extensions, *self._others)
        if self._is_new and extensions and not self._name.lower().endswith(known):
            path += extensions[0]
        if self._is_new or os.path.isfile(path):
            self._close()
            self._answer(path)

    def _close(self) -> None:
        self._title = ""
        imgui.close_current_popup()


_BORDERS = imgui.ChildFlags_.borders

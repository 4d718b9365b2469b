"""A dialog with a list that is searched by typing, and chosen from by arrows and Enter.

In: options. Out: the chosen one, passed to a callback.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from ..middle import place_large
from ..translated_imgui import imgui
from .owned_keys import STEPS, own, pressed
from .row_in_view import scroll_to_row

_SIZE = 34, 24  # in heights of the font
_STAYS_OPEN = imgui.SelectableFlags_.no_auto_close_popups


class Option(NamedTuple):
    """A line of the list.

    Attributes
    ----------
    name : str
        As it is shown; what is typed is looked for in it and in the remark.
    act : callable
        Called when it is chosen.
    remark : str
        Stands at the right.
    """

    name: str
    act: Callable[[], object]
    remark: str = ""

    def holds(self, words: Sequence[str]) -> bool:
        """Return whether all words are in it."""
        text = f"{self.name} {self.remark}".casefold()
        return all(word in text for word in words)


class ListDialog:
    """Offers options.

    Parameters
    ----------
    title : str
    """

    def __init__(self, title: str) -> None:
        self._title = title
        self._options: Sequence[Option] = ()
        self._found: Sequence[Option] = ()
        self._search = ""
        self._place = 0
        self._opens = self._scrolls = self._focuses = False

    def ask(self, options: Sequence[Option]) -> None:
        """Open the dialog with some options."""
        self._options = self._found = options
        self._search, self._place = "", 0
        self._opens = True

    def draw(self) -> None:
        """Lay the dialog out, if it is open."""
        if self._opens:
            imgui.open_popup(self._title)
            self._opens = False
        place_large(*_SIZE)
        if not imgui.begin_popup_modal(self._title, None, imgui.WindowFlags_.no_saved_settings)[0]:
            return
        chosen = self._draw_search()
        if imgui.begin_child("options"):
            chosen = self._draw_options() or chosen
        imgui.end_child()
        if chosen is not None or imgui.is_key_pressed(imgui.Key.escape, False):
            imgui.close_current_popup()
        imgui.end_popup()
        if chosen is not None:
            self._options = self._found = ()
            chosen.act()

    def _draw_search(self) -> Option | None:
        """Lay out the field to type in; return the marked option if Enter was pressed."""
        own("list", STEPS)
        if imgui.is_window_appearing() or self._focuses:
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(-1.0)
        flags = imgui.InputTextFlags_.enter_returns_true
        before = self._search
        entered, self._search = imgui.input_text_with_hint(
            "##search", "Search", self._search, flags
        )
        if self._search != before:
            words = self._search.casefold().split()
            self._found = [option for option in self._options if option.holds(words)]
            self._place, self._scrolls = 0, True
        for key, step in STEPS.items():
            if pressed(key):
                self._place, self._scrolls = self._place + step, True
        self._focuses = entered and not self._found  # Enter took the keyboard away
        self._place = max(min(self._place, len(self._found) - 1), 0)
        return self._found[self._place] if entered and self._found else None

    def _draw_options(self) -> Option | None:
        """Lay out the visible options; return the one that was clicked."""
        chosen = None
        faded = imgui.get_style_color_vec4(imgui.Col_.text_disabled)
        if self._scrolls:
            self._scrolls = False
            scroll_to_row(self._place)
        if not self._found:
            imgui.text_disabled("nothing found")
        clipper = imgui.ListClipper()
        clipper.begin(len(self._found), imgui.get_text_line_height_with_spacing())
        while clipper.step():
            for number in range(clipper.display_start, clipper.display_end):
                option = self._found[number]
                if imgui.selectable(f"##{number}", number == self._place, _STAYS_OPEN)[0]:
                    chosen = option
                imgui.same_line(0.0, 0.0)
                imgui.text_unformatted(option.name)
                if option.remark:
                    width = imgui.calc_text_size(option.remark).x
                    room = imgui.get_window_width() - width - imgui.get_font_size()
                    imgui.same_line(max(room, 0.0))
                    imgui.push_style_color(imgui.Col_.text, faded)
                    imgui.text_unformatted(option.remark)
                    imgui.pop_style_color()
        return chosen

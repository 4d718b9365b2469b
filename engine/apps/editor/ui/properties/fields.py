"""Fields that show and change attributes of one thing, or of several at once.

In: things and the names of their attributes. Out: commands; a mouse drag is one step from press to
release. Where the values of several things differ, a field shows a dash, and an edit sets them all.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from .....base.held_values import same
from .....base.language import translated, translated_choice
from .....model.materials.colors import split_alpha
from .....model.materials.display_colors import display_color
from ...value_commands import SetEach, SetValues
from ..translated_imgui import imgui
from ..workspace import Workspace

Option = TypeVar("Option")
#: Shown where values differ.
DIFFERS = "—"
#: Of more things the values are not compared: comparing takes microseconds for each.
MOST_COMPARED = 500
#: The part of the panel's width that fields take, and the letters that labels of rows of numbers
#: need.
SHARE, LABEL_LETTERS = 0.55, 5.0
#: What a number needs, in digits, and a colour, in letters.
NUMBER_DIGITS, COLOR_LETTERS = 8, 9.5
_FAR = 1e9
_NEARLY, _SMALL = 1e-7, 5e-4


class Fields:
    """Lays out fields.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._drag: Hashable = None

    # Commands

    def set(self, things: Iterable[Any], values: Mapping[str, Any], label: str = "") -> None:
        """Assign the same values to all things, as a step of its own."""
        self._workspace.do(SetValues(things, values, translated(label)))

    def set_each(self, each: Iterable[tuple[Any, Mapping[str, Any]]], label: str = "") -> None:
        """Assign values to things, as a step of its own."""
        self._workspace.do(SetEach(each, translated(label)))

    def drag(self, each: Iterable[tuple[Any, Mapping[str, Any]]], label: str = "") -> None:
        """Assign values to things, as part of the drag that goes on."""
        self._workspace.do(SetEach(each, translated(label)), drag=self._drag)

    @property
    def drag_key(self) -> Hashable:
        """What commands of the present drag share; another one for each drag."""
        return self._drag

    def follow_drag(self) -> None:
        """Note that the mouse grabbed the last item."""
        if imgui.is_item_activated():
            self._drag = self._workspace.next_drag()

    # Layout

    def folder(self, title: str, *, is_open: bool = True) -> bool:
        """Lay out a heading; return whether what is below it shows."""
        return imgui.collapsing_header(title, imgui.TreeNodeFlags_.default_open if is_open else 0)

    @contextlib.contextmanager
    def fold(self, title: str) -> Iterator[bool]:
        """Lay out what is rarely used, folded at first; yield whether it shows."""
        is_open = imgui.tree_node(title)
        yield is_open
        if is_open:
            imgui.tree_pop()

    def label(self, text: str, room: float | None = None) -> None:
        """Lay out a label to the left of the next item, or above it where it would be cut.

        Parameters
        ----------
        text : str
        room : float, optional
            Pixels that the item takes; by default a share of the panel's width.
        """
        text = translated(text)
        start, whole = imgui.get_cursor_pos_x(), imgui.get_content_region_avail().x
        room = whole * SHARE if room is None else room
        imgui.align_text_to_frame_padding()
        imgui.text_unformatted(text)
        width = imgui.calc_text_size(text).x + imgui.get_style().item_spacing.x
        if width <= whole - room:
            imgui.same_line()
            imgui.set_cursor_pos_x(start + whole - room)
        imgui.set_next_item_width(-1.0)

    def note(self, text: str) -> None:
        """Lay out a sentence, in as many lines as it needs."""
        imgui.push_style_color(
            imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled)
        )
        imgui.text_wrapped(text)
        imgui.pop_style_color()

    def value(self, label: str, text: str) -> None:
        """Lay out a value that cannot be edited."""
        self.label(label)
        imgui.text_wrapped(text)

    def button(self, label: str, *, beside: bool = False) -> bool:
        """Lay out a button, where asked beside the last item; return whether it was pressed."""
        if beside:
            imgui.same_line()
            width = imgui.calc_text_size(translated(label)).x
            width += 2.0 * imgui.get_style().frame_padding.x
            if width > imgui.get_content_region_avail().x:
                imgui.new_line()
        return imgui.button(label)

    # Values

    def text(self, now: str) -> str | None:
        """Lay out a text; return another one when it was entered, or left, but not by Esc."""
        new = imgui.input_text("##text", now)[1]
        return new if imgui.is_item_deactivated_after_edit() else None

    def numbers(
        self,
        label: str,
        rows: Sequence[Sequence[float]],
        speed: float,
        factor: float = 1.0,
        low: float = -_FAR,
        high: float = _FAR,
        form: str = "",
    ) -> dict[int, float] | None:
        """Lay out numbers side by side, whose values are rows of one or several things.

        ``low`` and ``high`` are as shown: times ``factor``.

        Returns
        -------
        changed : dict of int to float, or None
            The new number by its place in a row.
        """
        count = len(rows[-1])
        whole, letter = imgui.get_content_region_avail().x, imgui.get_font_size()
        gap = imgui.get_style().item_inner_spacing.x
        room = whole - LABEL_LETTERS * letter if count > 1 else whole * SHARE
        needed = count * (NUMBER_DIGITS * imgui.calc_text_size("0").x + gap)
        self.label(label, room if room >= needed or count == 1 else whole)
        width = (imgui.calc_item_width() - gap * (count - 1)) / count
        touched: dict[int, float] = {}
        for place in range(count):
            if place:
                imgui.same_line(0.0, gap)
            imgui.set_next_item_width(width)
            now = float(rows[-1][place])
            differs = any(_differ(float(row[place]), now) for row in rows)
            shown = now * factor
            how = DIFFERS if differs else form or _short(shown)
            changed, new = imgui.drag_float(f"##{label} {place}", shown, speed, low, high, how)
            self.follow_drag()
            if changed:
                touched[place] = min(max(new, low), high) / factor
        return touched or None

    def vector(
        self, things: Sequence[Any], name: str, label: str, speed: float, factor: float = 1.0
    ) -> None:
        """Lay out an attribute that is a few numbers; those not touched stay to the bit."""
        rows = rows_of(things, lambda thing: [float(value) for value in getattr(thing, name)])
        changed = self.numbers(label, rows, speed, factor)
        if changed is None:
            return
        self.drag((thing, {name: _replaced(getattr(thing, name), changed)}) for thing in things)

    def number(
        self,
        things: Sequence[Any],
        name: str,
        label: str,
        speed: float,
        low: float = -_FAR,
        high: float = _FAR,
        factor: float = 1.0,
    ) -> None:
        """Lay out an attribute that is a number; ``low`` and ``high`` are as shown."""
        now = getattr(things[-1], name)
        if now is None or not math.isfinite(now):
            self.value(label, translated("none") if now is None else f"{now:g}")
            return
        rows = rows_of(things, lambda thing: [getattr(thing, name)])
        changed = self.numbers(label, rows, speed, factor, low, high)
        if changed is not None:
            self.drag((thing, {name: changed[0]}) for thing in things)

    def integers(
        self, label: str, rows: Sequence[Sequence[int]], low: int, high: int
    ) -> dict[int, int]:
        """Lay out whole numbers side by side; as `numbers`, but nothing is {}."""
        changed = self.numbers(label, rows, 0.1, 1.0, low, high, "%.0f")
        whole = {place: round(value) for place, value in (changed or {}).items()}
        return {k: value for k, value in whole.items() if any(row[k] != value for row in rows)}

    def share(self, things: Sequence[Any], name: str, label: str) -> None:
        """Lay out an attribute that is a number from 0 to 1."""
        now, differs = self._held(things, name)
        self.label(label)
        how = DIFFERS if differs else "%.3f"
        changed, new = imgui.slider_float(f"##{label}", now, 0.0, 1.0, how)
        self.follow_drag()
        if changed:
            self.drag((thing, {name: min(max(new, 0.0), 1.0)}) for thing in things)

    def color(self, things: Sequence[Any], name: str, label: str) -> None:
        """Lay out an attribute that is a colour; the alpha of each thing stays."""
        now, differs = self._held(things, name)
        new = self.new_color(label, now, f"{translated(label)} {DIFFERS}" if differs else label)
        if new is not None:
            self.drag(
                (thing, {name: _with_alpha_of(getattr(thing, name), new)}) for thing in things
            )

    def new_color(self, label: str, color: Any, title: str = "") -> tuple[int, int, int] | None:
        """Lay out a colour; return another one if it was changed, 8-bit sRGB."""
        room = imgui.get_content_region_avail().x * SHARE
        self.label(title or label, max(room, COLOR_LETTERS * imgui.get_font_size()))
        shown = list(display_color(split_alpha(color)[0], "srgb"))
        changed, new = imgui.color_edit3(f"##{label}", shown)
        self.follow_drag()
        red, green, blue = (round(255 * part) for part in new)
        return (red, green, blue) if changed else None

    def flag(self, things: Sequence[Any], name: str, label: str) -> None:
        """Lay out an attribute that is on or off."""
        changed, new = self.checkbox(label, self._all(things, name))
        if changed:
            self.set(things, {name: new})

    def checkbox(self, label: str, values: Sequence[bool]) -> tuple[bool, bool]:
        """Lay out a box for one or several values; return whether it was changed, and to what."""
        differs = any(value != values[-1] for value in values)
        corner, side = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
        changed, new = imgui.checkbox(label, values[-1] and not differs)
        if differs:
            middle, color = corner.y + side / 2, imgui.get_color_u32(imgui.Col_.check_mark)
            first, last = (corner.x + part * side for part in (0.25, 0.75))
            imgui.get_window_draw_list().add_line((first, middle), (last, middle), color, 2.0)
        return changed, new

    def choice(
        self,
        label: str,
        now: str,
        options: Iterable[tuple[str, Option | None]],
        context: str = "",
    ) -> Option | None:
        """Lay out a choice; return the chosen option, or None.

        Parameters
        ----------
        label, now : str
            ``now`` is the name that is shown, and marked among the options.
        options : iterable of (str, object)
            None in place of an object makes a heading.
        context : str, optional
            Of the names in the catalogue of the language; without one they are shown as they are.
        """

        def told(name: str) -> str:
            return translated_choice(context, name) if context else name

        self.label(label)
        chosen = None
        if imgui.begin_combo(f"##{label}", told(now)):
            for number, (name, option) in enumerate(options):
                if option is None:
                    imgui.separator_text(name)
                elif imgui.selectable(f"{told(name)}##{number}", name == now)[0]:
                    chosen = option
            imgui.end_combo()
        return chosen

    def _all(self, things: Sequence[Any], name: str) -> list[bool]:
        """Return the switches of all things; of too many the opposite of the last, and the last."""
        if len(things) <= MOST_COMPARED:
            return [bool(getattr(thing, name)) for thing in things]
        last = bool(getattr(things[-1], name))
        return [not last, last]

    def _held(self, things: Sequence[Any], name: str) -> tuple[Any, bool]:
        """Return the attribute of the last thing, and whether those of the others differ."""
        now = getattr(things[-1], name)
        if len(things) > MOST_COMPARED:
            return now, True
        return now, not all(same(getattr(thing, name), now) for thing in things)


def label_before(text: str, letters: float) -> None:
    """Lay out a label at the left of a row, and begin the next item a number of letters on."""
    start = imgui.get_cursor_pos_x()
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(translated(text))
    imgui.same_line(start + letters * imgui.get_font_size())


def rows_of(things: Sequence[Any], numbers_of: Callable[[Any], list[Any]]) -> list[list[Any]]:
    """Return the numbers of each thing; of too many those of the last, after what differs."""
    if len(things) <= MOST_COMPARED:
        return [numbers_of(thing) for thing in things]
    last = numbers_of(things[-1])
    return [[math.nan] * len(last), last]


def _differ(one: float, other: float) -> bool:
    """Return whether two numbers differ by more than what rounding did to one of them."""
    return not math.isclose(one, other, rel_tol=_NEARLY, abs_tol=_NEARLY)


def _short(value: float) -> str:
    """Return a number with up to three decimals, as a format that has no placeholder."""
    if value and abs(value) < _SMALL:
        return f"{value:.2e}"
    return f"{value + 0.0:.3f}".rstrip("0").rstrip(".")


def _replaced(values: Any, changed: dict[int, float]) -> list[float]:
    return [changed.get(place, float(value)) for place, value in enumerate(values)]


def _with_alpha_of(color: Any, shown: tuple[int, int, int]) -> tuple[int, ...]:
    """Return the colour that is shown, with the alpha of another."""
    alpha = split_alpha(color)[1]
    return shown if alpha == 1.0 else (*shown, round(255 * alpha))


def name_of(values: Iterable[str]) -> str:
    """Return the name that all share, or a dash."""
    names = set(values)
    return names.pop() if len(names) == 1 else DIFFERS

"""The bar above the picture: a menu for each theme of commands, and buttons of some of them.

In: the table of commands, a strip of pixels, the mouse. Out: the bar, drawn on; what is under the
mouse.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ....base.language import translated
from ....rendering.canvas import Canvas
from ....rendering.fonts.font import Font
from ....stage.overlays.theme import Theme
from ..keymap import BINDINGS, SECTIONS, Binding

if TYPE_CHECKING:
    from ..viewer import Viewer

#: Above and below the texts, at scale 1.
MARGIN = 4
#: Left and right of a button's text, in letters' sizes.
_INSET = 0.6
#: Alpha of the button under the mouse.
HOVER_ALPHA = 40
#: The command that stands at the right end.
_LAST = "toggle_help"


class Button(NamedTuple):
    """A button of the bar: of the menu of a theme or, with a binding, of a command."""

    text: str  # in English, by which it is known
    left: int
    width: int
    binding: Binding | None = None

    @property
    def shown(self) -> str:
        """What it says."""
        return translated(self.text)


def bar_buttons(width: int, font: Font) -> list[Button]:
    """Return the buttons that fit a bar: the last one at its right end, the others from its left.

    Parameters
    ----------
    width : int
        Of the bar in pixels.
    font : Font
    """
    commands = [binding for binding in BINDINGS if binding.button]
    last = next(binding for binding in commands if binding.action == _LAST)
    end = _button(last.button, width, font, last)
    end = end._replace(left=width - end.width)
    found, left = [], 0
    wanted = [(title, None) for title in SECTIONS]
    wanted += [(one.button, one) for one in commands if one is not last]
    for text, binding in wanted:
        button = _button(text, left, font, binding)
        left += button.width
        if left <= end.left:
            found.append(button)
    return [*found, end]


def _button(text: str, left: int, font: Font, binding: Binding | None) -> Button:
    arrow, inset = 0 if binding is not None else round(font.size), round(_INSET * font.size)
    return Button(text, left, font.width(translated(text)) + arrow + 2 * inset, binding)


def button_at(buttons: list[Button], x: int) -> Button | None:
    """Return the button at a column of the bar, or None."""
    found = (one for one in buttons if 0 <= x - one.left < one.width)
    return next(found, None)


def lit_buttons(buttons: list[Button], viewer: Viewer) -> list[bool]:
    """Return of each button whether its command is on."""
    values = (None if one.binding is None else one.binding.value for one in buttons)
    return [value is not None and value(viewer).is_lit for value in values]


def draw_menu_bar(
    canvas: Canvas,
    buttons: list[Button],
    lit: list[bool],
    chosen: str | None,
    line: str,
    font: Font,
    theme: Theme,
) -> None:
    """Draw the bar.

    Parameters
    ----------
    canvas : Canvas
        Over the strip.
    buttons : list of Button
    lit : list of bool
        Which of them are lit up as on.
    chosen : str or None
        The text of the button under the mouse, or of the open menu.
    line : str
        A text before the last button.
    font : Font
    theme : Theme
    """
    canvas.clear((*theme.block[:3], 255))
    inset, y = round(_INSET * font.size), (canvas.height - font.line_height) // 2
    for button, is_lit in zip(buttons, lit, strict=True):
        if button.text == chosen:
            color = (*theme.text[:3], HOVER_ALPHA)
            canvas.rectangle(button.left, 0, button.width, canvas.height, color)
        x = button.left + inset
        canvas.text(x, y, button.shown, theme.title if is_lit else theme.text, font=font)
        if is_lit:
            wide, high = font.width(button.shown), max(round(font.size / 8), 1)
            canvas.rectangle(x, canvas.height - high, wide, high, theme.title)
        if button.binding is None:
            _draw_arrow(canvas, button, font, theme)
    x = buttons[-1].left - font.width(line) - round(font.size)
    canvas.text(x, y, line, theme.key, font=font)


def _draw_arrow(canvas: Canvas, button: Button, font: Font, theme: Theme) -> None:
    """Draw the triangle that points down to a menu."""
    half = font.size / 5
    x = button.left + button.width - _INSET * font.size - 1.6 * half
    y = canvas.height / 2 + half / 4
    canvas.polygon([(x - half, y - half / 2), (x + half, y - half / 2), (x, y + half)], theme.key)


def bar_height(font: Font) -> int:
    """Return the height of a strip with a line of text, in pixels."""
    return font.line_height + 2 * round(MARGIN * font.size / 14)

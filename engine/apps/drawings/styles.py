"""How lines and texts of a drawing look: types and widths of lines as in ISO 128-2.

In: kind and visibility of a line. Out: its layer and style.
"""

from __future__ import annotations

from typing import NamedTuple

from ...choices import LineKind
from .line_kinds import KINDS

#: Widths of wide and narrow lines in millimetres: line group 0.5.
WIDE, NARROW = 0.5, 0.25
#: Dashes and gaps of lines 02.1, in widths of the line.
_DASH, _GAP = 12.0, 3.0


class Style(NamedTuple):
    """The look of lines.

    Attributes
    ----------
    width : float
        Millimetres.
    dashes : (float, float) or None
        Millimetres drawn and left out.
    color : str
        As ``#rrggbb``.
    """

    width: float
    dashes: tuple[float, float] | None = None
    color: str = "#000000"


class Layer(NamedTuple):
    """The lines of a drawing that look alike.

    Attributes
    ----------
    name : str
        An identifier.
    title : str
    style : Style
    """

    name: str
    title: str
    style: Style


_WORDS = "outlines of cuts/outlines/borders/edges/intersections/lines"
_TITLES = dict(zip(KINDS, _WORDS.split("/"), strict=True))
_NARROW_KINDS = ("line",)
HATCHING = Layer("hatching", "Hatching", Style(NARROW))
FRAME = Layer("frame", "Frame", Style(WIDE))
THIN = Layer("title", "Title block and dimensions", Style(NARROW))


def layer_of(kind: LineKind, hidden: bool, scale: float = 1.0) -> Layer:
    """Return the layer of lines of a kind.

    Parameters
    ----------
    kind : str
    hidden : bool
    scale : float
        Of line widths.
    """
    narrow, wide = NARROW * scale, WIDE * scale
    if hidden:
        dashes = _DASH * narrow, _GAP * narrow
        return Layer(f"hidden-{kind}", f"Hidden: {_TITLES[kind]}", Style(narrow, dashes))
    return Layer(kind, _TITLES[kind].capitalize(), Style(narrow if kind in _NARROW_KINDS else wide))


def layers(hidden: bool, scale: float = 1.0) -> list[tuple[LineKind, bool, Layer]]:
    """Return all layers of a view in the order of drawing: hidden lines, if any, come first."""
    states = (True, False) if hidden else (False,)
    return [(kind, state, layer_of(kind, state, scale)) for state in states for kind in KINDS[::-1]]

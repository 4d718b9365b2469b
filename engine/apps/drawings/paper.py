"""A page of vectors: strokes in layers, and texts.

In: what a drawing puts on paper. Out: the same as plain records, of which SVG and PDF are made.
Places are millimetres from the upper left corner, x right, y down.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, NamedTuple, TypeAlias

from .styles import Layer

Anchor: TypeAlias = Literal["start", "middle", "end"]
#: Polylines in thousandths of a millimetre.
Polylines: TypeAlias = list[list[tuple[int, int]]]


class Strokes(NamedTuple):
    """Polylines of one part.

    Attributes
    ----------
    part : str
        Its name; empty for what belongs to no part.
    polylines : list of list of (int, int)
    """

    part: str
    polylines: Polylines


class Text(NamedTuple):
    """A line of text.

    Attributes
    ----------
    x, y : float
        Where it begins, has its middle or ends, on its base line.
    text : str
    size : float
        Height of its font in millimetres.
    anchor : str
    is_upward : bool
        Whether it runs from below upward.
    """

    x: float
    y: float
    text: str
    size: float
    anchor: Anchor = "start"
    is_upward: bool = False


@dataclass
class Group:
    """A part of a page, such as a view: layers with strokes, within a rectangle.

    Attributes
    ----------
    name : str
        An identifier.
    title : str
    layers : list of (Layer, list of Strokes)
    texts : list of Text
    x, y : float
        Where its own upper left corner is on the page.
    clip : (float, float) or None
        Width and height beyond which nothing is drawn.
    """

    name: str
    title: str
    layers: list[tuple[Layer, list[Strokes]]] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    x: float = 0.0
    y: float = 0.0
    clip: tuple[float, float] | None = None


@dataclass
class Page:
    """A page.

    Attributes
    ----------
    width, height : float
    title : str
    groups : list of Group
    background : str or None
        As ``#rrggbb``.
    """

    width: float
    height: float
    title: str
    groups: list[Group] = field(default_factory=list)
    background: str | None = "#ffffff"

"""A ball of axes to click: the world's directions as a camera sees them.

In: a camera's rotation, a place on a `Canvas`, the mouse. Out: the ball, drawn with smooth edges;
the direction under the mouse, from which a click is to look. Viewer and editor share it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...rendering.canvas import Canvas
from ...rendering.fonts.font import font
from ..views.viewpoint import UP_DIRECTIONS, Viewpoint
from .overlay import AXIS_COLORS
from .theme import DARK, Rgba, Theme

#: The radius of the ball at scale 1, in pixels.
RADIUS = 44.0
#: Of the radius: where the tips of the axes are, how large they are, and the axes' width.
_REACH, _TIP, _LINE = 0.76, 0.21, 0.045
#: Of a tip: the size of its letter, and the width of its ring.
_LETTER, _RING = 1.35, 0.2
#: Tips at the back are mixed with the background by this share.
_FADED = 0.45
_DISC_ALPHA = 70
#: A view looks along an axis if the cosine between them is larger.
_SAME = 1.0 - 1e-9


class BallPlace(NamedTuple):
    """Where a ball is: its centre and radius, in pixels of a picture."""

    x: float
    y: float
    radius: float

    def covers(self, x: float, y: float) -> bool:
        """Return whether a pixel belongs to the ball."""
        return (x - self.x) ** 2 + (y - self.y) ** 2 <= self.radius**2


class Tip(NamedTuple):
    """The end of an axis: its direction, such as ``"-X"``, where it shows, and how near it is."""

    name: str
    x: float
    y: float
    nearness: float


def tips(rotation: np.ndarray, place: BallPlace) -> list[Tip]:
    """Return the ends of the axes, the farthest first.

    Parameters
    ----------
    rotation : (3, 3) ndarray of float64
        The camera's axes in world space: columns right, up and back.
    place : BallPlace
    """
    reach = _REACH * place.radius
    found = []
    for name, direction in UP_DIRECTIONS.items():
        axis = next(k for k in range(3) if direction[k])
        right, up, back = (direction[axis] * part for part in rotation[axis].tolist())
        found.append(Tip(name, place.x + right * reach, place.y - up * reach, back))
    return sorted(found, key=lambda tip: tip.nearness)


def tip_at(rotation: np.ndarray, place: BallPlace, x: float, y: float) -> str | None:
    """Return the direction of the nearest tip at a pixel, or None."""
    reach = (1.25 * _TIP * place.radius) ** 2
    for tip in reversed(tips(rotation, place)):
        if (x - tip.x) ** 2 + (y - tip.y) ** 2 <= reach:
            return tip.name
    return None


def draw_ball(
    canvas: Canvas,
    rotation: np.ndarray,
    place: BallPlace,
    *,
    theme: Theme = DARK,
    lit: str | None = None,
    is_hovered: bool = False,
) -> None:
    """Draw the ball.

    Parameters
    ----------
    canvas : Canvas
    rotation, place
        As for `tips`.
    theme : Theme
    lit : str, optional
        The tip under the mouse.
    is_hovered : bool
        Whether the mouse is over the ball, which then shows as a disc.
    """
    if is_hovered:
        canvas.disc(place.x, place.y, place.radius, (*theme.text[:3], _DISC_ALPHA))
    for tip in tips(rotation, place):
        _draw_tip(canvas, place, tip, tip.name == lit, theme)


def _draw_tip(canvas: Canvas, place: BallPlace, tip: Tip, is_lit: bool, theme: Theme) -> None:
    """Draw a tip; that of a positive direction with its axis and its letter."""
    color = _faded(AXIS_COLORS["XYZ".index(tip.name[1])], tip.nearness, theme)
    radius = _TIP * place.radius
    if tip.name[0] == "+":
        _draw_line(canvas, (place.x, place.y), (tip.x, tip.y), _LINE * place.radius, color)
        canvas.disc(tip.x, tip.y, radius, theme.text if is_lit else color)
        _draw_letter(canvas, tip.name[1], tip, radius, theme if is_lit else DARK)
        return
    canvas.disc(tip.x, tip.y, radius, theme.text if is_lit else (*theme.block[:3], 130))
    canvas.disc(tip.x, tip.y, radius, color, width=_RING * radius)
    if is_lit:
        _draw_letter(canvas, tip.name, tip, radius, theme)


def _faded(color: Rgba, nearness: float, theme: Theme) -> Rgba:
    share = _FADED * (1.0 - nearness) / 2
    mixed = [round(a + (b - a) * share) for a, b in zip(color[:3], theme.block[:3], strict=True)]
    return mixed[0], mixed[1], mixed[2], 255


def _draw_line(
    canvas: Canvas, start: tuple[float, float], end: tuple[float, float], width: float, color: Rgba
) -> None:
    along = np.subtract(end, start)
    length = float(np.sqrt((along * along).sum()))
    if length < 1.0:
        return  # seen end on
    aside = np.array([-along[1], along[0]]) * (width / length)
    canvas.polygon([start + aside, end + aside, end - aside, start - aside], color)


def _draw_letter(canvas: Canvas, text: str, tip: Tip, radius: float, theme: Theme) -> None:
    lettering = font("sans", max(round(_LETTER * radius / len(text) ** 0.25), 4))
    width, height = lettering.text_size(text)
    place = round(tip.x - width / 2), round(tip.y - height / 2)
    canvas.text(*place, text, (*theme.block[:3], 255), font=lettering)


def turn_to(view: Viewpoint, name: str) -> None:
    """Look at a view's target along an axis: from a direction or, if it does so, from the other.

    Parameters
    ----------
    view : Viewpoint
        Changed in place.
    name : str
        A direction, such as ``"+X"``: from there, the view looks at its target.
    """
    direction = np.array(UP_DIRECTIONS[name])
    if linalg.dot(view.rotation()[:, 2], direction) > _SAME:
        direction = -direction
    target = view.target.copy()
    view.look_from(target + direction * view.distance, target)
    view.target = target

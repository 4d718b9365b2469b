"""The box around a model over a picture, with its three lengths.

In: a frame, the box, the unit of its lengths. Out: the same frame, drawn on.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...base.box_corners import CORNER_ENDS, box_corners
from ...rendering.frame import Frame
from .debug_lines import Lines, box_edges, draw_lines
from .lengths import length_text
from .lettering import text_font
from .theme import Theme

#: Distance of a text from its edge in pixels, times the scale.
_GAP = 6


def draw_dimensions(
    frame: Frame, box: NDArray[np.float64], unit: str, scale: float, theme: Theme
) -> None:
    """Draw a box, (2, 3) in world space, and its lengths beside the outer edges of the picture."""
    if not np.isfinite(box).all():
        return
    draw_lines(frame, [Lines(box_edges(box[np.newaxis]), theme.title)], scale)
    middle, _ = frame.project(box.mean(axis=0))
    for axis in range(3):
        length = float(box[1, axis] - box[0, axis])
        edge = _outer_edge(frame, box, axis, middle)
        if length > 0.0 and edge is not None:
            text = f"{'XYZ'[axis]} {length_text(length, unit)}"
            write_beside(frame, text, edge, middle, scale, theme)


def _outer_edge(
    frame: Frame, box: NDArray[np.float64], axis: int, middle: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    """Return the edge along an axis that is lowest in the picture, or leftmost if it is upright."""
    corners = box_corners(box)
    low = corners[CORNER_ENDS[:, axis] == 0]
    high = corners[CORNER_ENDS[:, axis] == 1]
    pixels, _ = frame.project(np.stack([low, high], axis=1).reshape(-1, 3))
    edges = pixels.reshape(-1, 2, 2)
    if not (np.isfinite(edges).all() and np.isfinite(middle).all()):
        return None
    along = np.abs(edges[0, 1] - edges[0, 0])
    sign, column = (1.0, 1) if along[0] > along[1] else (-1.0, 0)
    return edges[int(np.argmax(sign * edges.mean(axis=1)[:, column]))]


def write_beside(
    frame: Frame,
    text: str,
    edge: NDArray[np.float64],
    middle: NDArray[np.float64],
    scale: float,
    theme: Theme,
) -> None:
    """Write a text on a block beside an edge, (2, 2) in pixels, away from a point."""
    font = text_font(scale)
    size = np.array(font.text_size(text), np.float64)
    at, along = edge.mean(axis=0), edge[1] - edge[0]
    outward = np.array([along[1], -along[0]])
    length = float(np.sqrt((outward * outward).sum()))
    if length < 1.0:  # seen end on
        return
    outward *= np.sign((outward * (at - middle)).sum() or 1.0) / length
    reach = _GAP * scale + float((np.abs(outward) * size).sum()) / 2
    corner = at + outward * reach - size / 2
    room = np.maximum(np.array([frame.width, frame.height]) - size - 2 * scale, 0.0)
    write_on_block(frame, text, corner.clip(2.0 * scale, room), scale, theme)


def write_on_block(
    frame: Frame, text: str, corner: NDArray[np.float64], scale: float, theme: Theme
) -> None:
    """Write a text on a translucent block, whose top left corner is given in pixels."""
    font, canvas = text_font(scale), frame.canvas()
    (x, y), (width, height) = np.rint(corner).tolist(), font.text_size(text)
    canvas.rectangle(x - 3 * scale, y, width + 6 * scale, height, theme.block)
    canvas.text(int(x), int(y), text, theme.text, font=font)

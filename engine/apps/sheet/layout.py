"""The layout of a sheet: places of its panels, and their common scale.

In: how far each view reaches in world units, the room in pixels. Out: a rectangle for each, and
pixels per unit. A column is as wide as its widest view needs, a row as high as its highest, so that
a long part fills the sheet and views stand above and beside each other as in technical drawings.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ...errors import InvalidArgumentError

#: The minimum size of a panel in pixels.
LEAST_WIDTH, LEAST_HEIGHT = 96, 80
_HALVINGS = 80


class Rectangle(NamedTuple):
    """Pixels of the sheet: the top left one, width and height."""

    x: int
    y: int
    width: int
    height: int


class Reach(NamedTuple):
    """The extent of a view across and up, in world units."""

    width: float
    height: float


class Padding(NamedTuple):
    """Pixels in a panel around the scaled drawing."""

    left: int
    top: int
    right: int
    bottom: int


def lay_out(
    area: Rectangle, reaches: list[Reach], padding: Padding, gap: int, columns: int | None
) -> tuple[list[Rectangle], float]:
    """Return the panels' rectangles, row by row, and the scale.

    Parameters
    ----------
    area : Rectangle
        What they share.
    reaches : list of Reach
        One for each panel.
    padding : Padding
    gap : int
        Pixels between panels.
    columns : int or None
        How many panels stand in a row; None for what gives the largest scale.

    Raises
    ------
    InvalidArgumentError
        The area is too small.
    """
    count = len(reaches)
    if not any(max(reach) > 0.0 for reach in reaches):
        reaches = [Reach(1.0, 1.0)] * count
    choices = range(1, count + 1) if columns is None else (min(columns, count),)
    filled = [c for c in choices if _rows(count, _rows(count, c)) == c]  # no column is empty
    found = [_grid(area, reaches, padding, gap, c) for c in filled]
    fitting = [grid for grid in found if grid is not None]
    if not fitting:
        raise InvalidArgumentError(
            f"size: pixels are too few for {count} views: "
            f"{max(area.width, 0)}x{max(area.height, 0)} are left beside the texts, "
            f"and each view needs {LEAST_WIDTH}x{LEAST_HEIGHT}"
        )
    return max(fitting, key=lambda grid: grid[1])


def _rows(count: int, columns: int) -> int:
    return -(-count // columns)


def _grid(area, reaches, padding, gap, columns):
    """Return rectangles and scale for a number of columns, or None if they do not fit."""
    rows = _rows(len(reaches), columns)
    widths = [max(reach.width for reach in reaches[c::columns]) for c in range(columns)]
    heights = [
        max(reach.height for reach in reaches[r * columns : (r + 1) * columns]) for r in range(rows)
    ]
    across = area.width - gap * (columns - 1), LEAST_WIDTH, padding.left + padding.right
    down = area.height - gap * (rows - 1), LEAST_HEIGHT, padding.top + padding.bottom
    scale = min(_largest_scale(widths, *across), _largest_scale(heights, *down))
    if scale <= 0.0:
        return None
    xs = _sides(widths, scale, *across)
    ys = _sides(heights, scale, *down)
    rectangles = []
    for number in range(len(reaches)):
        row, column = divmod(number, columns)
        left, right = xs[column : column + 2]
        top, bottom = ys[row : row + 2]
        rectangles.append(
            Rectangle(
                area.x + left + gap * column,
                area.y + top + gap * row,
                right - left,
                bottom - top,
            )
        )
    return rectangles, scale


def _taken(needs: list[float], scale: float, least: int, pad: int) -> list[float]:
    # Much shorter sides still get a fair share.
    return [max(least, pad + need * scale) for need in needs]


def _largest_scale(needs: list[float], total: int, least: int, pad: int) -> float:
    """Return the largest scale at which all fit, by bisection; 0 if none does."""
    fair = _fair(len(needs), total, least)
    if sum(_taken(needs, 0.0, fair, pad)) > total:
        return 0.0
    if max(needs) <= 0.0:
        return math.inf
    low, high = 0.0, total / max(needs)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if sum(_taken(needs, middle, fair, pad)) <= total:
            low = middle
        else:
            high = middle
    return low


def _fair(count: int, total: int, least: int) -> int:
    """Return the minimum size of a panel, which grows with the sheet."""
    return max(least, total // (4 * count))


def _sides(needs: list[float], scale: float, total: int, least: int, pad: int) -> list[int]:
    """Return where panels begin and end; they share the remaining space equally."""
    taken = _taken(needs, scale, _fair(len(needs), total, least), pad)
    rest = (total - sum(taken)) / len(taken)
    ends, place = [0], 0.0
    for side in taken:
        place += side + rest
        ends.append(int(place + 0.5))
    return ends

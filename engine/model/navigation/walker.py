"""A walker on a navigation grid: it tests each step, and slides along obstacles.

In: a `NavigationGrid`, a start, and moves. Out: a position that is always walkable. A move is cut
into steps of half a cell, and each step is traced through every cell it crosses, so no wall is too
thin and no step too long.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.calls import checks_types
from ...base.numbers import real
from ...base.validation import Closed, finite
from ...errors import InvalidArgumentError
from .grid import NavigationGrid

#: Length of a step in cells.
_STRIDE = 0.5
#: The most steps in one move; a longer move is cut off there.
_MOST_STEPS = 4096
#: Within this many cells of the edge, ask for a new grid; then not again for half as many.
_EDGE = 80


class Walker(Closed):
    """A point on the ground, and eyes above it.

    Parameters
    ----------
    grid : NavigationGrid
    x, z : float
        The start; the nearest walkable cell is used.
    y : float, optional
        The approximate height; by default the highest walkable layer.
    eye_height : float
        Height of the eyes above the ground.
    survey : callable, optional
        Returns the `NavigationGrid` around x and z, with cells aligned to those of ``grid``. Called
        near the grid's edge, so that the ground can be endless.

    Attributes
    ----------
    grid : NavigationGrid
    x, y, z : float
        Position of the feet; y is the ground's height.
    eye_height : float

    Raises
    ------
    InvalidArgumentError
        No cell is walkable, or a number is not finite.
    """

    grid: NavigationGrid
    x: float
    y: float
    z: float
    eye_height: float

    @checks_types
    def __init__(
        self,
        grid: NavigationGrid,
        x: float,
        z: float,
        y: float | None = None,
        eye_height: float = 1.7,
        *,
        survey: Callable[[float, float], NavigationGrid] | None = None,
    ) -> None:
        if not isinstance(grid, NavigationGrid):
            raise InvalidArgumentError(f"grid must be a NavigationGrid, not {type(grid).__name__}")
        self.grid = grid
        self._survey = survey
        self._surveyed = math.inf, math.inf
        self.eye_height = finite(eye_height, "eye_height")
        y = None if y is None else finite(y, "y")
        self._layer, self.x, self.z = _nearest(grid, finite(x, "x"), finite(z, "z"), y)
        self.y = self._ground(self.x, self.z)

    @property
    def eye(self) -> NDArray[np.float64]:
        """Position of the eyes, (3,) float64."""
        return np.array([self.x, self.y + self.eye_height, self.z])

    @checks_types
    def move(self, dx: float, dz: float) -> bool:
        """Move by (dx, dz), or slide along obstacles; return whether the walker moved."""
        dx, dz = real(dx), real(dz)
        strides = math.hypot(dx, dz) / (_STRIDE * self.grid.cell)
        if not math.isfinite(strides) or strides == 0.0:
            return False
        count = math.ceil(strides)
        x, z = dx / count, dz / count
        before = self.x, self.z
        for _ in range(min(count, _MOST_STEPS)):
            # Slide along the longer component first, which is closer to the wanted direction.
            parts = ((x, 0.0), (0.0, z)) if abs(x) >= abs(z) else ((0.0, z), (x, 0.0))
            self._look_around()
            if not (self._step(x, z) or self._step(*parts[0]) or self._step(*parts[1])):
                break
        return (self.x, self.z) != before

    def _look_around(self) -> None:
        """Switch to a new grid if the edge of this one is near."""
        if self._survey is None:
            return
        column, row = _cell(self.grid, self.x, self.z)
        rows, columns = self.grid.shape
        far = math.dist(self._surveyed, (self.x, self.z)) > 0.5 * _EDGE * self.grid.cell
        if min(column, row, columns - 1 - column, rows - 1 - row) >= _EDGE or not far:
            return
        self._surveyed = self.x, self.z
        grid = self._survey(self.x, self.z)
        column, row = _cell(grid, self.x, self.z)
        layer = grid._standing(row, column, self.x, self.z, self.y)
        if layer is not None:
            self.grid, self._layer = grid, layer

    def _step(self, dx: float, dz: float) -> bool:
        """Move by less than a cell if every cell crossed is walkable."""
        if dx == 0.0 and dz == 0.0:
            return False
        x, z = self.x + dx, self.z + dz
        layer, y = self._layer, self._ground(x, z)
        for row, column in _cells_between(self.grid, self.x, self.z, x, z):
            layer = self.grid._standing(row, column, x, z, y)
            if layer is None:
                return False
            y = self.grid._height(layer, row, column, x, z)
        self.x, self.y, self.z, self._layer = x, y, z, layer
        return True

    def _ground(self, x: float, z: float) -> float:
        """Return the height of the ground at a nearby point, on the walker's layer."""
        column, row = _cell(self.grid, self.x, self.z)
        return self.grid._height(self._layer, row, column, x, z)

    def __repr__(self) -> str:
        return f"Walker(x={self.x:g}, y={self.y:g}, z={self.z:g})"


_BEYOND = 1e15  # cells from the grid: clamp coordinates there


def _cells_between(grid: NavigationGrid, x0: float, z0: float, x1: float, z1: float) -> Any:
    """Yield the cells that a segment enters, in order, without the start and with the end.

    A segment shorter than a cell enters at most two. Through a corner, it visits the cells on both
    sides, since either may hold a wall.
    """
    i0, j0 = _cell(grid, x0, z0)
    i1, j1 = _cell(grid, x1, z1)
    if i0 != i1 and j0 != j1:
        edge_x = grid.origin[0] + max(i0, i1) * grid.cell
        edge_z = grid.origin[1] + max(j0, j1) * grid.cell
        # The products are the segment's parameters at its crossings with the edges, up to a factor.
        at_x, at_z = abs(edge_x - x0) * abs(z1 - z0), abs(edge_z - z0) * abs(x1 - x0)
        if at_x <= at_z:
            yield j0, i1
        if at_z <= at_x:
            yield j1, i0
    yield j1, i1


def _cell(grid: NavigationGrid, x: float, z: float) -> tuple[int, int]:
    """Return the column and row of a point, also outside the grid."""
    left, top = grid.origin.tolist()
    return _floor((x - left) / grid.cell), _floor((z - top) / grid.cell)


def _floor(number: float) -> int:
    return math.floor(min(max(number, -_BEYOND), _BEYOND))


@np.errstate(over="ignore")  # beyond overflow, all places are equally far
def _nearest(grid: NavigationGrid, x: float, z: float, y: float | None) -> Any:
    """Return the walkable layer nearest to a point, and x and z of the nearest place on it."""
    layers = np.flatnonzero(grid.walkable)
    if not len(layers):
        raise InvalidArgumentError("nothing in the navigation grid is walkable")
    cells = np.searchsorted(grid.starts, layers, side="right") - 1
    rows, columns = np.divmod(cells, grid.shape[1])
    centers = [grid.origin[0] + (columns + 0.5) * grid.cell]
    centers.append(grid.origin[1] + (rows + 0.5) * grid.cell)
    heights = grid.heights[layers].astype(np.float64)
    # Any place within a cell is as near as its centre.
    dx, dz = (
        np.maximum(np.abs(c - p) - 0.5 * grid.cell, 0.0)
        for c, p in zip(centers, (x, z), strict=True)
    )
    up = 0.0 if y is None else heights - float(y)
    # A point on an edge belongs to one cell only, however the distances were rounded.
    here = (columns == _cell(grid, x, z)[0]) & (rows == _cell(grid, x, z)[1])
    distance = np.where(here, 0.0, dx * dx + dz * dz) + up * up
    best = np.lexsort((-heights, ~here, distance))[0]
    if here[best]:
        return int(layers[best]), x, z
    return int(layers[best]), float(centers[0][best]), float(centers[1][best])

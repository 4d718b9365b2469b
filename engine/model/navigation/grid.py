"""The walkable surfaces of meshes, on a grid of square cells.

In: meshes with named materials, Y up. Out: for each cell its layers (ground, a bridge over it, …),
from below upward, in read-only arrays. C finds the layers (`csrc/scene/navigation/`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..._native import navigation as _native
from ..._native.loaders import frozen
from ...base import linalg
from ...base.angles import limited_angle
from ...base.calls import checks_types
from ...base.numbers import floats, real, shown
from ...base.validation import Closed, not_negative
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..materials.material import Material
from ..scene.instances import InstancedMesh
from ..scene.scene import Scene
from ._placed_meshes import bounds_of, placed_meshes

MAX_CELLS = 1 << 26
Choice: TypeAlias = Collection[str] | Callable[[Material], bool] | None


class NavigationGrid(Closed):
    """The ground of a scene, seen from above.

    A layer of a cell is a surface that at the cell's centre is flat enough and has headroom above
    it. It is walkable if its material is, and if no obstacle between step height and headroom is
    within the radius. Later changes of the scene are not seen: build a new grid.

    Parameters
    ----------
    thing : Scene, Mesh, InstancedMesh or sequence of these meshes
        Y is up. Of a scene, the visible meshes.
    cell : float
        Side of a cell in world units.
    walkable : collection of str, or callable, optional
        Names of walkable materials, or a function from a `Material` to bool. By default all are.
    ignore : collection of str, or callable, optional
        Materials that do not block the way, such as leaves.
    bounds : (2, 2) float, optional
        Least and greatest (x, z) of the grid; by default those of the meshes.
    max_slope : float
        The steepest walkable slope, in radians, less than a quarter turn.
    step : float
        The highest step one can climb or cross, in world units.
    headroom : float
        The free height needed, in world units.
    radius : float
        The smallest distance to walls, in world units.

    Attributes
    ----------
    origin : (2,) float64
        Least x and z.
    cell : float
    shape : (int, int)
        Numbers of cells along z and x.
    step, headroom : float
    starts : (cells + 1,) int32
        The layers of cell k (x first) are ``starts[k]`` to ``starts[k + 1]``.
    heights : (L,) float32
        Of each layer at the cell's centre.
    walkable : (L,) bool

    Raises
    ------
    InvalidArgumentError
        A parameter is out of its range, or the grid would have more than 2**26 cells.
    OutOfMemoryError
    """

    origin: np.ndarray
    cell: float
    shape: tuple[int, int]
    step: float
    headroom: float
    starts: np.ndarray
    heights: np.ndarray
    walkable: np.ndarray

    def __init__(
        self,
        thing: Scene | Mesh | InstancedMesh | Iterable[Mesh | InstancedMesh],
        *,
        cell: float = 0.5,
        walkable: Choice = None,
        ignore: Choice = (),
        bounds: ArrayLike | None = None,
        max_slope: float = math.radians(40.0),
        step: float = 0.4,
        headroom: float = 1.8,
        radius: float = 0.25,
    ) -> None:
        placed = placed_meshes(thing)
        self.cell, self.step, self.headroom = _sizes(cell, step, headroom)
        words = "from 0 to less than pi/2 radians"
        if limited_angle(max_slope, "max_slope", math.pi / 2, words) == math.pi / 2:
            raise InvalidArgumentError(f"max_slope must be {words}, not {shown(max_slope)}")
        radius = not_negative(radius, "radius")
        low, high = _area(placed, bounds)
        self.origin = low
        sides = [side / self.cell for side in (high - low).tolist()]
        if max(sides) > MAX_CELLS:
            raise InvalidArgumentError(
                f"{max(sides):g} cells in a row are too many: take larger ones"
            )
        columns, rows = (math.ceil(side) or 1 for side in sides)
        if columns * rows > MAX_CELLS:
            raise InvalidArgumentError(f"{columns} x {rows} cells are too many: take larger ones")
        self.shape = (rows, columns)
        least = float(linalg.cos(max_slope))
        x, z = low.tolist()
        native = _native.NativeGrid(
            x, z, self.cell, columns, rows, least, self.step, self.headroom, radius
        )
        for choice, what in ((walkable, "walkable"), (ignore, "ignore")):
            _check_choice(choice, what)
        kinds = [_kinds(mesh.materials, walkable, ignore) for mesh, _ in placed]
        for ground in (True, False):
            for (mesh, pose), kind in zip(placed, kinds, strict=True):
                matrix = np.ascontiguousarray(pose, np.float64)
                native.add(ground, mesh.positions, mesh.faces, mesh.material_ids, kind, matrix)
            if ground:
                native.sort()
        self.origin, self.starts, self.heights, self._slope_x, self._slope_z, self.walkable = map(
            frozen, (self.origin, *native.layers())
        )

    def sample_ground(
        self, x: ArrayLike, z: ArrayLike, y: ArrayLike | None = None
    ) -> tuple[Any, Any]:
        """Return the height of the ground at points, and whether it is walkable.

        Parameters
        ----------
        x, z : float or (N,) float
            World coordinates.
        y : float or (N,) float, optional
            The current height: selects the highest layer at most a step above. By default, the
            highest layer.

        Returns
        -------
        height : float or (N,) float64
            NaN where there is no such layer, and outside the grid.
        walkable : bool or (N,) bool

        Raises
        ------
        InvalidArgumentError
            An argument is not a number, or the shapes differ.
        """
        x, z = floats(x, "x"), floats(z, "z")
        limit = np.inf if y is None else floats(y, "y") + self.step
        try:
            x, z, limit = np.broadcast_arrays(x, z, limit)
        except ValueError as error:
            raise InvalidArgumentError(f"x, z and y must be numbers: {error}") from None
        layer, heights = self._layers(x.ravel(), z.ravel(), limit.ravel())
        walkable = np.zeros(len(layer), bool)
        walkable[layer >= 0] = self.walkable[layer[layer >= 0]]
        if x.ndim == 0:
            return float(heights[0]), bool(walkable[0])
        return heights.reshape(x.shape), walkable.reshape(x.shape)

    def _layers(self, x: Any, z: Any, limit: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return the highest layer below a limit at each point, or -1, and its height there."""
        rows, columns = self.shape
        with np.errstate(over="ignore", invalid="ignore"):
            i = np.floor((x - self.origin[0]) / self.cell)
            j = np.floor((z - self.origin[1]) / self.cell)
            inside = (i >= 0) & (i < columns) & (j >= 0) & (j < rows)
        i, j = (np.where(inside, part, 0).astype(np.int64) for part in (i, j))
        found, heights = np.full(len(x), -1), np.full(len(x), np.nan)
        first, end = self.starts[j * columns + i], self.starts[j * columns + i + 1]
        dx = x - (self.origin[0] + (i + 0.5) * self.cell)
        dz = z - (self.origin[1] + (j + 0.5) * self.cell)
        for number in range(int((end - first).max(initial=0))):
            some = np.flatnonzero(inside & (first + number < end))
            layer = first[some] + number
            height = self.heights[layer] + self._slope_x[layer].astype(np.float64) * dx[some]
            height = height + self._slope_z[layer].astype(np.float64) * dz[some]
            low = height <= limit[some]
            found[some[low]], heights[some[low]] = layer[low], height[low]
        return found, heights

    @checks_types
    def standing(self, row: int, column: int, x: float, z: float, y: float) -> int | None:
        """Return the layer of a cell on which one can stand, or None.

        Parameters
        ----------
        row, column : int
            The cell; outside the grid, the result is None.
        x, z, y : float
            A point in or near the cell. Only the layer nearest in height counts, if it is at most a
            step away.
        """
        return self._standing(row, column, real(x), real(z), real(y))

    def _standing(self, row: int, column: int, x: float, z: float, y: float) -> int | None:
        if not (0 <= row < self.shape[0] and 0 <= column < self.shape[1]):
            return None
        cell = row * self.shape[1] + column
        found, nearest = None, self.step
        for layer in range(int(self.starts[cell]), int(self.starts[cell + 1])):
            distance = abs(self._height(layer, row, column, x, z) - y)
            if distance <= nearest:
                found, nearest = layer, distance
        return found if found is not None and self.walkable[found] else None

    @checks_types
    def height(self, layer: int, row: int, column: int, x: float, z: float) -> float:
        """Return the height of a layer's plane at a point.

        Raises
        ------
        InvalidArgumentError
            There is no such layer, or an argument is not a number.
        """
        if not 0 <= layer < len(self.heights):
            raise InvalidArgumentError(f"layer must be in 0..{len(self.heights) - 1}, not {layer}")
        return self._height(int(layer), real(row), real(column), real(x), real(z))

    def _height(self, layer: int, row: float, column: float, x: float, z: float) -> float:
        dx = x - (float(self.origin[0]) + (column + 0.5) * self.cell)
        dz = z - (float(self.origin[1]) + (row + 0.5) * self.cell)
        slopes = float(self._slope_x[layer]), float(self._slope_z[layer])
        return float(self.heights[layer]) + slopes[0] * dx + slopes[1] * dz

    def __repr__(self) -> str:
        rows, columns = self.shape
        count = int(self.walkable.sum())
        return f"NavigationGrid({columns} x {rows} cells of {self.cell:g}, {count} walkable)"


def _sizes(cell: Any, step: Any, headroom: Any) -> tuple[float, float, float]:
    cell, step, headroom = real(cell), real(step), real(headroom)
    if not 0.0 < cell < math.inf:
        raise InvalidArgumentError(f"cell must be greater than 0, not {cell!r}")
    if not 0.0 <= step < headroom < math.inf:
        raise InvalidArgumentError(f"0 <= step < headroom must hold: {step!r}, {headroom!r}")
    return cell, step, headroom


def _area(placed: Any, bounds: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return the smallest and largest x and z."""
    if bounds is None:
        if not placed:
            raise InvalidArgumentError("there are no faces to walk on")
        low, high = bounds_of(placed)[:, [0, 2]]
    else:
        area = floats(bounds, "bounds")
        if area.shape != (2, 2) or not np.isfinite(area).all() or (area[0] >= area[1]).any():
            raise InvalidArgumentError("bounds must be the least and the greatest (x, z)")
        low, high = area
    return low.copy(), high.copy()


def _kinds(materials: list[Material], walkable: Choice, ignore: Choice) -> np.ndarray:
    """Return the flags of each material, (N,) uint8."""
    kinds = [
        0
        if _chosen(material, ignore)
        else _native.SOLID | (_native.WALKABLE if _chosen(material, walkable, True) else 0)
        for material in materials
    ]
    return np.array(kinds, np.uint8)


def _check_choice(choice: Choice, what: str) -> None:
    """Raise unless the argument can select materials."""
    if choice is None or callable(choice):
        return
    several = isinstance(choice, Collection) and not isinstance(choice, (str, bytes))
    if not several or not all(isinstance(name, str) for name in choice):
        raise InvalidArgumentError(
            f"{what} must be names of materials, or a function of a Material, not {shown(choice)}"
        )


def _chosen(material: Material, choice: Choice, default: bool = False) -> bool:
    if choice is None:
        return default
    return bool(choice(material)) if callable(choice) else material.name in choice

"""A city of any size: streets, houses, towers, a river with bridges, parks, trees, lamps.

In: about how many triangles, and a seed. Out: a `World` of districts, each a `Mesh` in world
coordinates. The city is round and grows outward: what stands on a tile is a function of the seed
and the tile, so the streets in the middle are the same whatever the size. Trees on the meadows
round it make up the number of triangles.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..._native.loaders import frozen
from ...base.calls import checks_types, hinted
from ...base.validation import own
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.primitives.arguments import integer
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from .buildings import add_houses, house_quads
from .frames import Frames
from .furniture import LAMP_HEIGHT, template
from .parks import add_parks
from .patchwork import Patchwork
from .placements import placements, wood
from .plan import (
    HOUSES,
    PARK,
    PLAZA,
    RIVER,
    RIVER_COLUMN,
    TOWERS,
    houses,
    tile_kinds,
    towers,
)
from .river import add_river, add_wild_river, has_bridge
from .skyscrapers import add_towers, tower_quads
from .streets import add_ground, add_meadow, corners
from .surfaces import FOLIAGE, NUMBER, WALKABLE, materials

LEAST, MOST = 20_000, 50_000_000
#: Tiles along each side of a district.
DISTRICT = 4
#: Rings of meadows around the city.
_MEADOWS = 1
_FEWEST_A_TILE = 1_500
#: Details up to these sizes in metres may be omitted or moved at coarser levels.
_TOLERANCES = (0.3, 1.5)
#: By kind of tile: functions that make a table of buildings, count their quads, and add them.
_BUILDINGS: tuple[tuple[int, Callable[..., Any], Callable[..., Any], Callable[..., Any]], ...] = (
    (HOUSES, houses, house_quads, add_houses),
    (TOWERS, towers, tower_quads, add_towers),
)
_LAND = {HOUSES: "gravel", TOWERS: "stone", PARK: "grass", PLAZA: "stone"}


@dataclass(frozen=True)
class World:
    """A city to walk through, made by `city`. Y is up, the unit is the metre.

    Attributes
    ----------
    seed : int
    districts : tuple of Mesh
        In world coordinates, each of up to 4 by 4 tiles of 72 metres; they share ``materials``.
    materials : list of Material
        By their names: ``"asphalt"``, ``"stone"``, ``"water"``, ``"grass"``, ``"gravel"`` …
    lamps : (N, 3) float64, read-only
        Where the street lamps shine.
    walkable : frozenset of str
        The names of the materials that people walk on.
    foliage : frozenset of str
        Those of leaves, which stop nobody.
    """

    seed: int
    districts: tuple[Mesh, ...]
    materials: list[Material]
    lamps: np.ndarray
    walkable: frozenset[str]
    foliage: frozenset[str]
    _asked: int

    @property
    def triangles(self) -> int:
        """Number of triangles."""
        return sum(len(mesh.faces) for mesh in self.districts)

    def mesh(self) -> Mesh:
        """Return everything as one mesh, for example for `Mesh.save`."""
        return Mesh.concatenate(self.districts, name="city")

    def levels(self) -> tuple[tuple[tuple[Mesh, ...], float], ...]:
        """Return the districts at full and coarser detail, for `DetailedMeshes`.

        The ground is the same at every level, so that districts of different levels match.

        Returns
        -------
        levels : tuple of (tuple of Mesh, float)
            The same districts in the same order, and an error in metres: nothing is farther from
            where it was, and nothing that is left out is wider.
        """
        ground = _Ground(self.seed, self._asked)
        levels = [(self.districts, 0.0)]
        for tolerance in _TOLERANCES:
            made = (
                _district(ground, key, self.materials, tolerance)[0] for key in ground.districts()
            )
            levels.append((tuple(made), tolerance))
        return tuple(levels)

    @checks_types
    def add_to(self, scene: Scene) -> Node:
        """Add the districts to a scene; return their group node."""
        group = scene.add(name="city")
        for mesh in self.districts:
            scene.add(mesh, parent=group)
        return group

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({name: own(value) for name, value in state.items()})

    def __repr__(self) -> str:
        return (
            f"World({self.triangles} triangles, {len(self.districts)} districts, seed={self.seed})"
        )


@hinted
def city(triangles: int = 1_000_000, seed: int = 0) -> World:
    """Return a city of about the given number of triangles, the same on every machine.

    Parameters
    ----------
    triangles : int
        From 20,000 to 50 million; what comes out has up to 1 % less.
    seed : int
        Another city for each, modulo 2**32.

    Returns
    -------
    World
        Its middle, a crossing of streets, is the origin.

    Raises
    ------
    InvalidArgumentError
        If an argument is no integer or out of range.
    """
    triangles = integer("triangles", triangles, LEAST, MOST)
    seed = integer("seed", seed, -(2**63), 2**63 - 1)
    ground = _Ground(seed, triangles)
    shared = materials()
    districts, lamps = [], []
    for key in ground.districts():
        mesh, lights = _district(ground, key, shared)
        districts.append(mesh)
        lamps.append(lights)
    light = frozen(np.concatenate(lamps))
    return World(seed, tuple(districts), shared, light, WALKABLE, FOLIAGE, triangles)


class _Ground:
    """The ground: city and meadow tiles, and the trees that make up the number of triangles."""

    def __init__(self, seed: int, triangles: int) -> None:
        self.seed = seed
        i, j = _tiles_by_distance(triangles // _FEWEST_A_TILE)
        cost = np.cumsum(_tile_triangles(seed, i, j, tile_kinds(seed, i, j)))
        low, high = 1, len(i)
        while high - low > 1:
            middle = (low + high) // 2
            wild = _meadows(i[:middle], j[:middle])
            if cost[middle - 1] + _meadow_triangles(wild[0]) <= triangles:
                low = middle
            else:
                high = middle
        self.i, self.j = i[:low], j[:low]
        self.kinds = tile_kinds(seed, self.i, self.j)
        self.wild_i, self.wild_j = _meadows(self.i, self.j)
        missing = triangles - int(cost[low - 1]) - _meadow_triangles(self.wild_i)
        dry = self.wild_i != RIVER_COLUMN
        self.wood_i, self.wood_j = self.wild_i[dry], self.wild_j[dry]
        self.wood = wood(seed, self.wood_i, self.wood_j, max(0, missing))

    def districts(self) -> list[tuple[int, int]]:
        """Return the non-empty districts, row by row."""
        i, j = np.concatenate([self.i, self.wild_i]), np.concatenate([self.j, self.wild_j])
        keys = np.unique(np.stack([j // DISTRICT, i // DISTRICT], axis=1), axis=0)
        return [(a, b) for b, a in keys.tolist()]


def _tiles_by_distance(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return i and j of the ``count`` tiles nearest to the origin, and some more."""
    reach = int(count**0.5 * 0.6) + 3
    j, i = (part.ravel() for part in np.mgrid[-reach:reach, -reach:reach])
    order = np.argsort((2 * i + 1) ** 2 + (2 * j + 1) ** 2, kind="stable")
    return i[order], j[order]


def _meadows(i: np.ndarray, j: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the tiles around the city, row by row."""
    low = int(min(i.min(), j.min())) - _MEADOWS
    side = int(max(i.max(), j.max())) + _MEADOWS + 1 - low
    built = np.zeros((side, side), bool)
    built[j - low, i - low] = True
    near = built.copy()
    for axis in (0, 1):
        near = np.logical_or.reduce(
            [np.roll(near, step, axis) for step in range(-_MEADOWS, _MEADOWS + 1)]
        )
    rows, columns = np.nonzero(near & ~built)
    return columns + low, rows + low


def _tile_triangles(seed: int, i: np.ndarray, j: np.ndarray, kinds: np.ndarray) -> np.ndarray:
    """Return the number of triangles of each tile."""
    count = np.zeros(len(i), np.int64)
    for kind in (HOUSES, TOWERS, PARK, PLAZA):
        count[kinds == kind] = _ground_triangles(kind)
    river = np.flatnonzero(kinds == RIVER)
    ends = has_bridge(seed, j[river]).astype(np.int64) + has_bridge(seed, j[river] + 1)
    none, both = (_river_triangles(flag) for flag in (False, True))
    count[river] = none + (both - none) // 2 * ends
    for kind, table, quads, _ in _BUILDINGS:
        tiles = np.flatnonzero(kinds == kind)
        things = table(seed, i[tiles], j[tiles])
        np.add.at(count, tiles[things.tile], 2 * quads(things))
    for name, (tile, _) in placements(seed, i, j, kinds).items():
        count += np.bincount(tile, minlength=len(i)) * len(template(name).faces)
    return count


def _ground_triangles(kind: int) -> int:
    patch, tile = Patchwork(), corners(np.zeros(1), np.zeros(1))
    _add_land(patch, tile, np.array([kind]))
    return patch.triangles


def _river_triangles(bridges: bool) -> int:
    patch, tile = Patchwork(), corners(np.zeros(1), np.zeros(1))
    add_river(patch, tile, np.array([bridges]), np.array([bridges]))
    return patch.triangles


def _meadow_triangles(i: np.ndarray) -> int:
    patch = Patchwork()
    _add_meadows(patch, i, np.zeros(len(i)))
    return patch.triangles


def _add_land(patch: Patchwork, tile: Frames, kinds: np.ndarray) -> None:
    """Add the ground of tiles without the river."""
    land = np.array([NUMBER[_LAND[kind]] for kind in range(len(_LAND))])[kinds]
    add_ground(patch, tile, land)
    add_parks(patch, tile[kinds == PARK])


def _add_meadows(patch: Patchwork, i: np.ndarray, j: np.ndarray) -> None:
    tile, wet = corners(i, j), i == RIVER_COLUMN
    add_meadow(patch, tile[~wet])
    add_wild_river(patch, tile[wet])


def _district(
    ground: _Ground, key: tuple[int, int], shared: list[Material], tolerance: float = 0.0
) -> tuple[Mesh, np.ndarray]:
    """Return a district's mesh, and the positions of its lamps."""
    inside = (ground.i // DISTRICT == key[0]) & (ground.j // DISTRICT == key[1])
    seed, i, j, kinds = ground.seed, ground.i[inside], ground.j[inside], ground.kinds[inside]
    patch, tile = Patchwork(tolerance), corners(i, j)
    dry = kinds != RIVER
    _add_land(patch, tile[dry], kinds[dry])
    add_river(patch, tile[~dry], has_bridge(seed, j[~dry]), has_bridge(seed, j[~dry] + 1))
    for kind, table, _, add in _BUILDINGS:
        chosen = kinds == kind
        add(patch, table(seed, i[chosen], j[chosen]), seed)
    wild = (ground.wild_i // DISTRICT == key[0]) & (ground.wild_j // DISTRICT == key[1])
    _add_meadows(patch, ground.wild_i[wild], ground.wild_j[wild])
    wooded = (ground.wood_i // DISTRICT == key[0]) & (ground.wood_j // DISTRICT == key[1])
    for name, (tiles, places) in ground.wood.items():
        patch.place(template(name, tolerance), places[wooded[tiles]])
    lights = np.zeros((0, 3))
    for name, (_, places) in placements(seed, i, j, kinds).items():
        patch.place(template(name, tolerance), places)
        if name == "lamp":
            lights = places[:, :3] + np.array([0.0, LAMP_HEIGHT, 0.0])
    return patch.mesh(f"district {key[0]} {key[1]}", shared), lights

"""The walkable ground of a model, for a walker of suitable height.

In: the scene, its bounds and its up direction. Out: a `NavigationGrid` in the space of the walk,
where Y is up, and a `Walker` on it.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NamedTuple

import numpy as np

from ...base import linalg
from ...base.language import translated
from ...base.near_words import meant
from ...errors import warn
from ...model.navigation import NavigationGrid, Walker
from ...model.scene.orbiting import home_axes
from ...model.scene.scene import Scene
from ...model.scene.shown import placing_pose, shown_object
from ..visibility import DRAWABLE, mesh_of
from .viewpoint import Sphere, Viewpoint

#: The walker's height assumes that the model's unit is the metre, except for small and large
#: models: their radius is clamped to this many metres.
LEAST_RADIUS, MOST_RADIUS = 4.0, 400.0
#: Sizes in these metres, and the maximum number of grid cells per side.
CELL, STEP, HEADROOM, RADIUS, EYES = 0.25, 0.4, 1.8, 0.25, 1.7
MOST_CELLS = 1500


class Ground(NamedTuple):
    """The ground to walk on.

    Attributes
    ----------
    axes : (3, 3) ndarray
        Right, up and back of the walk, in world space: its X, Y and Z.
    metre : float
        World units per metre of the walker.
    walker : Walker
        A walker at the place nearest to the camera.
    """

    axes: np.ndarray
    metre: float
    walker: Walker


def find_ground(
    scene: Scene,
    bounds: Sphere,
    view: Viewpoint,
    walkable: Collection[str] | None = None,
    slope: float | None = None,
) -> Ground:
    """Find the ground of a scene, and a place to stand on it.

    Parameters
    ----------
    scene : Scene
    bounds : Sphere
    view : Viewpoint
        Gives the up direction and the camera's position.
    walkable : collection of str, optional
        Names of walkable materials; by default all.
    slope : float, optional
        The steepest ground in radians; by default `NavigationGrid`'s.

    Raises
    ------
    InvalidArgumentError
        No cell is walkable.
    """
    axes = home_axes(view.up)
    metre = min(max(1.0, bounds.radius / MOST_RADIUS), bounds.radius / LEAST_RADIUS)
    turned = _turned(scene, axes)
    if walkable is not None:
        _warn_of_unknown(walkable, turned)
    low, high = turned.bounds
    cell = max(CELL * metre, float((high - low)[[0, 2]].max()) / MOST_CELLS)
    options: dict[str, Any] = {} if slope is None else {"max_slope": slope}
    grid = NavigationGrid(
        turned,
        cell=cell,
        walkable=walkable,
        step=STEP * metre,
        headroom=HEADROOM * metre,
        radius=RADIUS * metre,
        **options,
    )
    eye = np.clip(linalg.dot(axes, view.position()), low, high)
    walker = Walker(grid, float(eye[0]), float(eye[2]), float(low[1]), EYES * metre)
    return Ground(axes, metre, walker)


def _turned(scene: Scene, axes: np.ndarray) -> Scene:
    """Return a scene with another's objects, rotated so that Y is up."""
    turned, pose = Scene(), np.eye(4)
    pose[:3, :3] = axes
    group = turned.add(pose=pose)
    scene.data.update()
    for node in scene.nodes:
        if isinstance(node.object, DRAWABLE) and node.shown:
            turned.add(shown_object(node), parent=group, pose=placing_pose(node))
    return turned


def _warn_of_unknown(walkable: Collection[str], scene: Scene) -> None:
    """Name the materials that are to be walked on, but which no mesh has."""
    meshes = [mesh_of(node.object) for node in scene.nodes if node.object is not None]
    known = dict.fromkeys(material.name for mesh in meshes for material in mesh.materials)
    for name in walkable:
        if name not in known:
            warn(f"walkable: no material is called {name!r}{meant(name, list(known))}")


def told(grid: NavigationGrid) -> str:
    """Return a message about a grid."""
    rows, columns = grid.shape
    return translated(
        "navigation grid: {columns} x {rows} = {cells:,} cells, {places:,} places to stand",
        columns=columns,
        rows=rows,
        cells=rows * columns,
        places=int(grid.walkable.sum()),
    )

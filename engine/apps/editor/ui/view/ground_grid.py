"""The grid on the ground and the axes through the origin, drawn with the scene.

In: a scene, its bounds, the up direction. Out: the scene with lines beside it. The grid changes
only when the scene's size doubles or halves, so that it rests while nodes are dragged.
"""

from __future__ import annotations

import math

import numpy as np

from .....base import linalg
from .....model.geometry.mesh import Mesh
from .....model.scene.orbiting import home_axes
from .....model.scene.scene import Scene
from .....model.scene.staged_scene import StagedScene
from .....stage.overlays.grid_lines import REACH, grid
from .....stage.overlays.overlay import AXIS_COLORS
from .....stage.views.viewpoint import Sphere

#: The grid reaches at least so far, unless the scene is smaller than that.
_USUAL, _SMALL = 4.0, 0.25
_DIAGONAL = math.sqrt(2.0)


def grid_sphere(bounds: Sphere) -> Sphere:
    """Return the sphere that the grid is made for: of a round size, around a round place."""
    radius = 2.0 ** (1 + math.ceil(math.log2(bounds.radius)))
    if bounds.radius > _SMALL:
        radius = max(radius, _USUAL)
    center = np.round(np.asarray(bounds.center) / radius) * radius
    return Sphere(tuple((center + 0.0).tolist()), radius)


def with_grid(bounds: Sphere) -> Sphere:
    """Return a sphere around a scene's bounds and the grid below it."""
    ground = grid_sphere(bounds)
    apart = float(linalg.length(np.subtract(ground.center, bounds.center)))
    height = float(linalg.length(np.asarray(ground.center)))
    reach = _DIAGONAL * (REACH + 0.5) * ground.radius + apart + height
    return Sphere(bounds.center, max(bounds.radius, reach))


class GroundGrid:
    """Adds the grid to scenes."""

    def __init__(self) -> None:
        self._staged: StagedScene | None = None
        self._made_of: tuple = ()

    def beside(self, scene: Scene, bounds: Sphere, up: tuple[float, float, float]) -> StagedScene:
        """Return the scene with the grid beside it: the same until the grid changes."""
        if self._staged is None or self._staged.scene is not scene:
            self._staged, self._made_of = StagedScene(scene), ()
        key = grid_sphere(bounds), up
        if key != self._made_of:
            self._staged.clear()
            for lines in (axes(*key), grid(0.0, *key)):
                node = self._staged.beside.add(lines, name="grid", cast_shadows=False)
                node.receive_shadows = False
            self._made_of = key
        return self._staged


def axes(ground: Sphere, up: tuple[float, float, float]) -> Mesh:
    """Return the axes through the origin as coloured lines: two as long as the grid, one short."""
    home = home_axes(up)
    reach = REACH * ground.radius + float(linalg.length(np.asarray(ground.center)))
    ends = [(-reach, reach), (0.0, 0.25 * ground.radius), (-reach, reach)]
    positions = [home[k] * end for k in range(3) for end in ends[k]]
    colors = [AXIS_COLORS[int(np.argmax(np.abs(home[k])))] for k in range(3) for _ in range(2)]
    return Mesh(
        np.array(positions, np.float32),
        lines=np.arange(6, dtype=np.int32).reshape(-1, 2),
        colors=np.array(colors, np.uint8),
        name="axes",
    )

"""The grid on the ground and the axes through the origin, drawn with the scene.

In: a scene, a view. Out: the scene with lines beside it. The grid is as large as what one looks at:
it changes when the view's distance doubles or halves, and rests while nodes are dragged.
"""

from __future__ import annotations

import math

import numpy as np

from .....base import linalg
from .....model.geometry.mesh import Mesh
from .....model.scene.orbiting import home_axes
from .....model.scene.scene import Scene
from .....model.scene.staged_scene import StagedScene
from .....stage.overlays.grid_lines import MAJOR_EVERY, REACH, grid, grid_step
from .....stage.overlays.overlay import AXIS_COLORS
from .....stage.views.viewpoint import Sphere, Viewpoint

#: The grid's size in the view's distance, at least.
_NEARER = 2.0
#: The grid's last square, in its size, at most.
_WHOLE = 0.8


def grid_sphere(view: Viewpoint) -> Sphere:
    """Return the sphere that the grid is made for: of a round size, around a round place."""
    radius = 2.0 ** math.floor(math.log2(view.distance / _NEARER))
    center = np.round(view.target / radius) * radius + 0.0
    return Sphere(tuple(center.tolist()), radius)


def with_grid(bounds: Sphere, view: Viewpoint) -> Sphere:
    """Return a sphere around a scene's bounds and the grid on the ground."""
    ground = grid_sphere(view)
    apart = float(linalg.length(np.subtract(ground.center, bounds.center)))
    height = abs(float(linalg.dot(ground.center, home_axes(view.up)[1])))
    reach = math.sqrt(2.0) * (REACH + _WHOLE) * ground.radius + apart + height
    return Sphere(bounds.center, max(bounds.radius, reach))


class GroundGrid:
    """Adds the grid to scenes."""

    def __init__(self) -> None:
        self._staged: StagedScene | None = None
        self._made_of: tuple = ()

    def beside(self, scene: Scene, view: Viewpoint) -> StagedScene:
        """Return the scene with the grid beside it: the same until the grid changes."""
        if self._staged is None or self._staged.scene is not scene:
            self._staged, self._made_of = StagedScene(scene), ()
        key = grid_sphere(view), view.up
        if key != self._made_of:
            self._staged.clear()
            for lines in (axes(*key), grid(0.0, *key)):
                node = self._staged.beside.add(lines, name="grid", cast_shadows=False)
                node.receive_shadows = False
            self._made_of = key
        return self._staged


def axes(ground: Sphere, up: tuple[float, float, float]) -> Mesh:
    """Return the axes through the origin as coloured lines: two as long as the grid, one short."""
    home, step = home_axes(up), grid_step(ground.radius)
    squares = math.ceil(REACH * ground.radius / step)
    reach = (squares + -squares % MAJOR_EVERY) * step
    middle = linalg.dot(home, np.asarray(ground.center))
    ends = [
        (float(place) - reach, float(place) + reach) for place in np.round(middle / step) * step
    ]
    ends[1] = 0.0, ground.radius / 4
    positions = [home[k] * end for k in range(3) for end in ends[k]]
    colors = [AXIS_COLORS[int(np.argmax(np.abs(home[k])))] for k in range(3) for _ in range(2)]
    return Mesh(
        np.array(positions, np.float32),
        lines=np.arange(6, dtype=np.int32).reshape(-1, 2),
        colors=np.array(colors, np.uint8),
        name="axes",
    )

"""The grid around the scene, on the sides away from the camera.

In: a scene for viewing. Out: a node beside it, and text over the picture.
"""

from __future__ import annotations

import numpy as np

from ...base.box_corners import box_corners
from ...model.scene.nodes import Node
from ...model.scene.staged_scene import StagedScene
from ...rendering.frame import Frame
from ..viewed_scene import ViewedScene
from ..views.free_region import Taken
from .axes_grid import AxesGrid
from .theme import Theme


class BoxGrid:
    """The grid around a scene; hidden until it is shown.

    Parameters
    ----------
    viewed : ViewedScene
        The scene in its first pose.
    staged : StagedScene
        The staged scene of it.
    """

    def __init__(self, viewed: ViewedScene, staged: StagedScene) -> None:
        self._staged = staged
        self._node: Node | None = None
        self.fit(viewed)

    def fit(self, viewed: ViewedScene) -> None:
        """Enclose a scene in its current pose."""
        low, high = viewed.scene.bounds
        self._grid = AxesGrid(low, high, np.array(viewed.origin), viewed.unit)
        self._far: tuple[bool, bool, bool] | None = None

    @property
    def corners(self) -> np.ndarray:
        """The corners of the grid, (8, 3)."""
        return box_corners(np.stack([self._grid.low, self._grid.high]))

    @property
    def shows(self) -> bool:
        """Whether the grid is drawn."""
        return self._node is not None and self._node.visible

    def hide(self) -> None:
        """Hide the grid, until `follow` shows it again."""
        if self._node is not None:
            self._node.visible = False

    def follow(self, eye: np.ndarray, shown: bool) -> None:
        """Update the grid for a camera's position, (3,) in world space, or hide it."""
        if shown and not np.isfinite([self._grid.low, self._grid.high]).all():
            return
        if shown:
            middle = (self._grid.low + self._grid.high) / 2
            far = self._grid.far_sides(eye - middle)
            if self._node is None or far != self._far:
                mesh = self._grid.lines(far)
                if self._node is None:
                    self._node = self._staged.beside.add(mesh, name=mesh.name, cast_shadows=False)
                self._node.object, self._far = mesh, far
            self._node.visible = True
        else:
            self.hide()

    def label(self, frame: Frame, scale: float, theme: Theme, beside: Taken) -> None:
        """Write the numbers of the grid, if it is in the frame, as `AxesGrid.label` does."""
        if self._node is not None and self._far is not None:
            self._grid.label(frame, self._far, scale, theme, beside)

"""The pictures of the scene panel: those to work in, and those that `engine3d.render` draws.

In: the workspace, a size. Out: a frame with what clicks need. The renderer is kept, so that only
what has changed is prepared anew.
"""

from __future__ import annotations

import numpy as np

from ....choices import LookName
from ....model.scene.scene import Scene
from ....model.scene.staged_scene import StagedScene
from ....rendering.frame import Frame
from ....stage.overlays.selection_outline import CLICK_OUTPUTS
from ....stage.renderer import Renderer
from ....stage.scenes_of_things import is_lit
from .view.ground_grid import GroundGrid
from .workspace import Workspace


class ScenePictures:
    """Draws the scene of a workspace.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._renderer: Renderer | None = None
        self._look: LookName | None = None
        self._grid = GroundGrid()
        self._drawn: Scene | StagedScene | None = None

    def draw(self, size: tuple[int, int], grid: bool) -> Frame:
        """Return the frame of the workspace's view, with or without the grid to work on."""
        workspace = self._workspace
        renderer, camera = self._renderer_for(size), workspace.camera()
        culling = workspace.display.culling
        is_worked_in = not workspace.display.as_rendered
        self._drawn = self._with_grid() if grid and is_worked_in else workspace.scene
        if not is_worked_in:
            return renderer.render(self._drawn, camera, outputs=CLICK_OUTPUTS, culling=culling)
        return renderer.render(
            self._drawn,
            camera,
            mode=workspace.display.mode,
            wireframe="overlay" if workspace.display.wireframe else None,
            outputs=CLICK_OUTPUTS,
            culling=culling,
        )

    def _with_grid(self) -> Scene | StagedScene:
        """Return the scene with the grid; without it where a look lays a ground."""
        workspace = self._workspace
        if workspace.display.worn_look != "plain" and not is_lit(workspace.scene):
            return workspace.scene
        return self._grid.beside(workspace.scene, workspace.view)

    def _renderer_for(self, size: tuple[int, int]) -> Renderer:
        look = self._workspace.display.worn_look
        if self._renderer is None or self._look != look:
            self.close()
            self._renderer, self._look = Renderer(size, look=look), look
        elif self._renderer.size != size:
            self._renderer.resize(size)
        return self._renderer

    def grid_pixels(self, frame: Frame) -> np.ndarray:
        """Return where the last frame shows lines of the grid, (H, W) of bool."""
        drawn = self._drawn
        if isinstance(drawn, StagedScene):
            return (frame.object_id >= 0) & ~drawn.own_pixels(frame.object_id)
        return np.zeros(frame.object_id.shape, bool)

    def close(self) -> None:
        """Free the renderer."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

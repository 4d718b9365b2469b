"""The pictures of the scene panel: those to work in, and those that `engine3d.render` draws.

In: the workspace, a size. Out: a frame with what clicks need. The renderer is kept, so that only
what has changed is prepared anew.
"""

from __future__ import annotations

from ....choices import LookName
from ....rendering.frame import Frame
from ....stage.overlays.selection_outline import CLICK_OUTPUTS
from ....stage.renderer import Renderer
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

    def draw(self, size: tuple[int, int]) -> Frame:
        """Return the frame of the workspace's view."""
        workspace = self._workspace
        renderer, camera = self._renderer_for(size), workspace.camera()
        if workspace.display.as_rendered:
            return renderer.render(workspace.scene, camera, outputs=CLICK_OUTPUTS)
        return renderer.render(
            workspace.scene,
            camera,
            mode=workspace.display.mode,
            wireframe="overlay" if workspace.display.wireframe else None,
            outputs=CLICK_OUTPUTS,
        )

    def _renderer_for(self, size: tuple[int, int]) -> Renderer:
        look = self._workspace.display.worn_look
        if self._renderer is None or self._look != look:
            self.close()
            self._renderer, self._look = Renderer(size, look=look), look
        elif self._renderer.size != size:
            self._renderer.resize(size)
        return self._renderer

    def close(self) -> None:
        """Free the renderer."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

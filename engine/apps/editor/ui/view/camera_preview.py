"""A small picture of what the selected camera sees, in a corner of the scene panel.

In: the workspace. Out: a picture, drawn again only if it would change.
"""

from __future__ import annotations

from imgui_bundle import imgui

from .....model.scene.cameras import Camera
from .....model.scene.nodes import Node
from .....stage.renderer import Renderer
from ....imgui_painter.imgui_painter import ImguiPainter
from ..workspace import Workspace

#: The picture's width as a part of the scene's, and its own sides' ratio.
SHARE, ASPECT = 0.28, 16 / 9
_MARGIN, _EDGE, _INSET = 0.6, 0.12, 0.3  # heights of the font
_LEAST_WIDTH = 64
_FRAME = (0.0, 0.0, 0.0, 0.8)
_TEXT = (1.0, 1.0, 1.0, 0.9)


class CameraPreview:
    """Shows what the selected camera sees.

    Parameters
    ----------
    workspace : Workspace
    painter : ImguiPainter
        Shows the picture.
    """

    def __init__(self, workspace: Workspace, painter: ImguiPainter) -> None:
        self._workspace, self._painter = workspace, painter
        self._renderer: Renderer | None = None
        self._number = 0
        self._drawn: tuple = ()

    def close(self) -> None:
        """Free the renderer."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def draw(self, corner, size: tuple[int, int]) -> None:
        """Draw the picture in the lower right corner of the scene's."""
        node = self._workspace.document.selection.active
        if node is None or not isinstance(node.object, Camera):
            return
        if node is self._workspace.through.node:
            return
        width = int(size[0] * SHARE)
        height = int(width / (getattr(node.object, "aspect", None) or ASPECT))
        if width < _LEAST_WIDTH or not 1 <= height < size[1]:
            return
        self._render(node, (width, height))
        letter = imgui.get_font_size()
        edge, inset, margin = (round(part * letter) for part in (_EDGE, _INSET, _MARGIN))
        right, bottom = corner.x + size[0] - margin, corner.y + size[1] - margin
        first, last = (right - width, bottom - height), (right, bottom)
        lines = imgui.get_window_draw_list()
        around = (first[0] - edge, first[1] - edge), (right + edge, bottom + edge)
        lines.add_rect_filled(*around, imgui.get_color_u32(_FRAME))
        lines.add_image(imgui.ImTextureRef(self._number), first, last)
        place = first[0] + inset, first[1] + inset
        lines.add_text(place, imgui.get_color_u32(_TEXT), node.name)

    def _render(self, node: Node, size: tuple[int, int]) -> None:
        workspace = self._workspace
        scene, look = workspace.scene, workspace.display.worn_look
        state = workspace.changes, scene.data.arrays.changes, node.object.version
        key = (scene, node, size, look, *state)
        if key == self._drawn:
            return
        if self._renderer is None or self._renderer.size != size or self._drawn[3:4] != (look,):
            self.close()
            self._renderer = Renderer(size, look=look)
        frame = self._renderer.render(scene, (node.object, node.world_pose))
        if not self._number:
            self._number = self._painter.add(frame.color, opaque=True)
        self._painter.replace(self._number, frame.color, opaque=True)
        self._drawn = key

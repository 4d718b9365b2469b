"""Arrow keys that move, rotate and scale the selection by the steps of the tools.

In: keys from ImGui, in the window of the scene. Out: commands; as long as a key is held it is one
step.
"""

from __future__ import annotations

from collections.abc import Hashable

from .....base import linalg
from .....base.language import translated_choice
from ...gizmo import NUDGES, axes_towards, nudged
from ...node_commands import MoveNodes, counted, in_world
from ..translated_imgui import imgui
from ..workspace import Workspace
from .owned_keys import own, pressed

#: What Shift makes of a step.
FINE = 0.1
#: A node of at most this scale has no axis in that direction.
_FLAT = 1e-12


class Nudges:
    """Lets arrow keys act on the selection.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._drag: Hashable = None

    def press_keys(self) -> None:
        """Follow the keys, in the window of the scene while it has the keyboard."""
        workspace, io = self._workspace, imgui.get_io()
        nodes = workspace.document.selection.topmost()
        if not nodes or workspace.tools.chosen == "select" or io.key_ctrl or io.key_alt:
            return
        if workspace.display.as_rendered:
            return  # without handles
        # What Tab has marked among the tools is gone through by arrows.
        if not imgui.is_window_focused() or io.nav_visible or workspace.through.node in nodes:
            return
        own("nudges", NUDGES)
        for key in NUDGES:
            if pressed(key):
                if pressed(key, again=False):
                    self._drag = workspace.next_drag()
                self._nudge(nodes, key, FINE if io.key_shift else 1.0)

    def _nudge(self, nodes, key: str, share: float) -> None:
        workspace = self._workspace
        tool, pose = workspace.tools.chosen, nodes[-1].world_pose
        axes = axes_towards(workspace.view.rotation(), workspace.view.up)
        lengths = linalg.length(pose[:3, :3].T)
        if workspace.tools.is_local and lengths.min() > _FLAT:
            axes = pose[:3, :3] / lengths
        change = nudged(tool, key, axes, share * workspace.tools.steps[tool], pose[:3, 3])
        label = counted(translated_choice("act", tool), nodes)
        workspace.do(MoveNodes(workspace.scene, nodes, in_world(change), label), drag=self._drag)

"""The gizmo for moving, rotating and scaling the selection, by ImGuizmo.

In: the workspace, and the rectangle of the scene's picture. Out: commands; a drag is one step.
"""

from __future__ import annotations

from collections.abc import Hashable

import numpy as np
from imgui_bundle import imguizmo

from ....base import linalg
from ....base.language import translated_choice
from ....model.scene.cameras import Camera
from ..drags import dragged_pose
from ..node_commands import MoveNodes, counted, in_world
from .translated_imgui import imgui
from .workspace import Workspace

_PER_CENT = 100.0


class GizmoHandles:
    """Draws the handles of the active tool.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._drag: Hashable = None
        self._start: np.ndarray | None = None

    def draw(self, corner, size: tuple[int, int]) -> bool:
        """Draw the gizmo; return whether the mouse is on it."""
        workspace = self._workspace
        nodes = workspace.document.selection.topmost()
        if workspace.tools.chosen == "select" or not nodes or workspace.through.node in nodes:
            self._drag = None
            return False
        gizmo = imguizmo.im_guizmo
        gizmo.set_orthographic(workspace.view.orthographic)
        gizmo.allow_axis_flip(False)  # arrows point along +X, +Y, +Z from wherever one looks
        gizmo.set_drawlist(imgui.get_window_draw_list())
        gizmo.set_rect(corner.x, corner.y, *map(float, size))
        old = nodes[-1].world_pose
        made = self._manipulated(gizmo, old, size)
        if not gizmo.is_using():
            self._drag = None
        elif made is not None:
            if self._drag is None:
                self._drag, self._start = workspace.next_drag(), old.copy()
            self._move(nodes, old, made)
        return gizmo.is_over() or gizmo.is_using()

    def _move(self, nodes, old: np.ndarray, made: np.ndarray) -> None:
        workspace = self._workspace
        tool = workspace.tools.chosen
        step = workspace.tools.steps[tool] if self._snaps() else None
        new = dragged_pose(tool, self._start, made, step, is_local=workspace.tools.is_local)
        if new.tobytes() == old.tobytes():
            return
        change = linalg.multiply(new, linalg.inverse(old))
        if tool == "move":  # exactly, since multiplying by an inverse adds a small rotation
            change = linalg.translation(new[:3, 3] - old[:3, 3])
        label = counted(translated_choice("act", tool), nodes)
        workspace.do(MoveNodes(workspace.scene, nodes, in_world(change), label), drag=self._drag)

    def _camera(self) -> tuple[Camera, np.ndarray]:
        """Return the camera of the view, and its pose."""
        workspace = self._workspace
        if workspace.through.node is not None:
            return workspace.camera()
        view, bounds = workspace.view, workspace.bounds
        # Lights and cameras may be in front of the near plane, which depends on meshes.
        reach = float(linalg.length(view.position() - bounds.center)) + bounds.radius
        return view.camera(bounds._replace(radius=reach)), view.pose()

    def _snaps(self) -> bool:
        return self._workspace.tools.snaps != imgui.get_io().key_ctrl

    def _manipulated(self, gizmo, pose: np.ndarray, size: tuple[int, int]) -> np.ndarray | None:
        """Return the gizmo's new pose, in single precision; None if unchanged."""
        workspace = self._workspace
        camera, seen_from = self._camera()
        matrices = [
            gizmo.Matrix16(matrix.T.ravel().tolist())
            for matrix in (linalg.inverse(seen_from), camera.projection(size), pose)
        ]
        operation = {
            "move": gizmo.OPERATION.translate,
            "rotate": gizmo.OPERATION.rotate,
            "scale": gizmo.OPERATION.scale,
        }[workspace.tools.chosen]
        is_local = workspace.tools.is_local or workspace.tools.chosen == "scale"
        mode = gizmo.MODE.local if is_local else gizmo.MODE.world
        step = workspace.tools.steps[workspace.tools.chosen]
        step = step / _PER_CENT if workspace.tools.chosen == "scale" else step
        snap = gizmo.Matrix3([step] * 3) if self._snaps() else None
        if not gizmo.manipulate(*matrices[:2], operation, mode, matrices[2], None, snap):
            return None
        return np.array(matrices[2].values, np.float64).reshape(4, 4).T

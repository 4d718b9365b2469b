"""Optional overlays over the scene: lights and cameras, boxes, frusta, normals.

In: the shown frame, and the scene. Out: ImGui lines, drawn without depth test.
"""

from __future__ import annotations

import numpy as np

from ....base import linalg
from ....model.geometry.mesh import Mesh
from ....model.scene.cameras import Camera, far_depth
from ....model.scene.instances import InstancedMesh
from ....model.scene.nodes import Node
from ....rendering.frame import Frame
from .translated_imgui import imgui
from .workspace import Workspace

_EDGES = [(a, b) for a in range(8) for b in (a | 1, a | 2, a | 4) if a < b]
_CORNERS = np.indices((2, 2, 2)).reshape(3, -1).T
_BOX = (0.35, 0.8, 1.0, 0.8)
_FRUSTUM = (1.0, 0.9, 0.4, 0.8)
_NORMAL = (0.5, 1.0, 0.5, 0.7)
_MARK = (1.0, 0.9, 0.5, 0.9)
#: More normals would hide the mesh.
MOST_NORMALS = 4000
MARK_PIXELS = 5.0
#: An infinite frustum is drawn up to this many scene radii.
LONGEST = 4.0


class Overlays:
    """Draws over the scene.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    shown : dict of str to bool
        What is drawn, by name.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self.shown = {"marks": True, "boxes": False, "frusta": True, "normals": False}

    def draw_menu(self) -> None:
        """Lay out the menu of overlays."""
        if imgui.button("Show"):
            imgui.open_popup("show")
        if imgui.begin_popup("show"):
            for name in self.shown:
                _, self.shown[name] = imgui.checkbox(name.capitalize(), self.shown[name])
            imgui.end_popup()

    def draw(self, frame: Frame, corner) -> None:
        """Draw the chosen overlays over a frame with its top left corner at a window position."""
        lines = imgui.get_window_draw_list()
        lines.push_clip_rect(corner, (corner.x + frame.width, corner.y + frame.height), True)
        if self.shown["marks"]:
            self._draw_marks(lines, frame, corner)
        for node in self._workspace.document.selection.nodes[-64:]:
            if self.shown["boxes"] and node.bounds is not None:
                points = node.bounds[_CORNERS, np.arange(3)]
                _draw_edges(lines, frame, corner, points, _BOX)
            if self.shown["frusta"] and isinstance(node.object, Camera):
                points = self._frustum(node, frame)
                _draw_edges(lines, frame, corner, points, _FRUSTUM)
            if self.shown["normals"] and isinstance(node.object, Mesh | InstancedMesh):
                self._draw_normals(lines, frame, corner, node)
        lines.pop_clip_rect()

    def _draw_marks(self, lines, frame: Frame, corner) -> None:
        data = self._workspace.scene.data
        held = [*data.lights.values(), *data.cameras.values()]
        nodes = [node for node in held if node.shown]
        if not nodes:
            return
        places, depths = frame.project(np.array([node.world_pose[:3, 3] for node in nodes]))
        color = imgui.get_color_u32(_MARK)
        for node, place, depth in zip(nodes, places.tolist(), depths.tolist(), strict=True):
            if depth > 0:
                at = corner.x + place[0], corner.y + place[1]
                lines.add_circle(at, MARK_PIXELS, color)
                lines.add_text((at[0] + 2 * MARK_PIXELS, at[1] - MARK_PIXELS), color, node.name)

    def _frustum(self, node: Node, frame: Frame) -> np.ndarray:
        """Return the eight corners of a camera's frustum, in world space."""
        projection = node.object.projection(frame.size)
        unprojected = linalg.inverse(projection)
        corners = 2.0 * _CORNERS - 1.0
        corners[1::2, 2] = far_depth(node.object)
        points = linalg.transform_points(unprojected, corners)
        reach = LONGEST * self._workspace.bounds.radius
        near, far = points[::2], points[1::2]  # the last index is that of depth
        length = float(np.abs(far).max())
        if not length <= reach:  # infinite, or too far away for meaningful lines
            points[1::2] = near * (reach / max(float(np.abs(near).max()), 1e-12))
        return linalg.transform_points(node.world_pose, points)

    def _draw_normals(self, lines, frame: Frame, corner, node: Node) -> None:
        held = node.object
        mesh = held.mesh if isinstance(held, InstancedMesh) else held
        if mesh.normals is None or not len(mesh.positions):
            return
        step = -(-len(mesh.positions) // MOST_NORMALS)
        low, high = mesh.bounds
        length = 0.04 * float(np.max(high - low))
        starts = mesh.positions[::step, :3].astype(np.float64)
        ends = starts + length * mesh.normals[::step]
        pose = node.world_pose
        _draw_lines(
            lines,
            frame,
            corner,
            linalg.transform_points(pose, starts),
            linalg.transform_points(pose, ends),
            _NORMAL,
        )


def _draw_edges(lines, frame: Frame, corner, points: np.ndarray, color) -> None:
    first, last = np.array(_EDGES).T
    _draw_lines(lines, frame, corner, points[first], points[last], color)


def _draw_lines(lines, frame: Frame, corner, starts, ends, color) -> None:
    """Draw world lines; lines with an end behind the camera are left out."""
    (a, near), (b, far) = frame.project(starts), frame.project(ends)
    shown = (near > 0) & (far > 0) & np.isfinite(a).all(1) & np.isfinite(b).all(1)
    shift = np.array([corner.x, corner.y])
    packed = imgui.get_color_u32(color)
    for start, end in zip((a[shown] + shift).tolist(), (b[shown] + shift).tolist(), strict=True):
        lines.add_line(start, end, packed)

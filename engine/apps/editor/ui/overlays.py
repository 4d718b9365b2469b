"""Optional overlays over the scene: icons of lights, cameras, empties; boxes, colliders, normals.

In: the shown frame, and the scene. Out: ImGui lines, drawn without depth test. Selected lights show
what they light, selected cameras what they see.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from ....base import linalg
from ....model.geometry.mesh import Mesh
from ....model.scene.cameras import Camera
from ....model.scene.instances import InstancedMesh
from ....model.scene.nodes import Node
from ....rendering.frame import Frame
from ..node_shapes import MOST_EDGES, box_lines, camera_frustum, collider_lines, icon, outline
from ..picking import without_surface
from .style import scaled
from .translated_imgui import imgui
from .workspace import Workspace

Color: TypeAlias = tuple[float, float, float, float]
_BOX = (0.35, 0.8, 1.0, 0.8)
_FRUSTUM = (1.0, 0.9, 0.4, 0.8)
_COLLIDER = (0.45, 1.0, 0.55, 0.9)
_NORMAL = (0.5, 1.0, 0.5, 0.7)
_ICON, _SELECTED = (1.0, 0.92, 0.6, 1.0), (1.0, 0.63, 0.16, 1.0)
SHADOW = (0.0, 0.0, 0.0, 0.55)
#: How large an icon is, in heights of the font.
ICON_SIZE = 1.6
#: More names would cover the scene; those of selected nodes come first.
MOST_NAMES = 60
#: Of more selected nodes, the last ones have their outlines.
MOST_OUTLINES = 64
#: An infinite frustum or cone is drawn up to this many scene radii.
LONGEST = 1.5
#: What can be shown: its name in the menu, and whether it shows at first.
SHOWN = {
    "grid": ("Grid and axes", True),
    "ball": ("Ball of axes", True),
    "icons": ("Lights, cameras, empties", True),
    "names": ("Their names", True),
    "outlines": ("Cones, surfaces and frustums of the selection", True),
    "preview": ("What the selected camera sees", True),
    "colliders": ("Colliders of the selection", True),
    "boxes": ("Boxes of the selection", False),
    "normals": ("Normals of the selection", False),
}


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
        self.shown = {name: at_first for name, (_, at_first) in SHOWN.items()}
        self._made_of: tuple = ()
        self._lines: list[tuple[np.ndarray, Color]] = []
        self._names: list[tuple[str, list[float]]] = []

    def draw_menu(self) -> None:
        """Lay out the menu of overlays."""
        if imgui.button("Show"):
            imgui.open_popup("show")
        if imgui.begin_popup("show"):
            for name, (title, _) in SHOWN.items():
                _, self.shown[name] = imgui.checkbox(title, self.shown[name])
            imgui.end_popup()

    def draw(self, frame: Frame, corner) -> None:
        """Draw the chosen overlays over a frame with its top left corner at a window position."""
        selection = self._workspace.document.selection
        key = frame, selection.version, tuple(self.shown.values())
        if key != self._made_of:
            self._lines, self._names, self._made_of = [], [], key
            self._collect_icons(frame)
            for node in selection.nodes[-MOST_OUTLINES:]:
                for segments, color in self._outlines(node, frame):
                    self._collect(frame, segments, color)
        lines = imgui.get_window_draw_list()
        lines.push_clip_rect(corner, (corner.x + frame.width, corner.y + frame.height), True)
        for ends, color in self._lines:
            _draw_lines(lines, ends + np.array([corner.x, corner.y]), color)
        _draw_names(lines, corner, frame.size, self._names)
        lines.pop_clip_rect()

    def _collect(self, frame: Frame, segments: np.ndarray, color: Color) -> None:
        """Note world lines for drawing; those with an end behind the camera are left out."""
        pixels, depths = frame.project(segments.reshape(-1, 3))
        shown = (depths.reshape(-1, 2) > 0).all(axis=1)
        shown &= np.isfinite(pixels).reshape(-1, 4).all(axis=1)
        self._lines.append((pixels.reshape(-1, 2, 2)[shown], color))

    def _collect_icons(self, frame: Frame) -> None:
        """Note the icons and names of nodes without surface."""
        selection = self._workspace.document.selection
        chosen = [node for node in selection.nodes[-MOST_OUTLINES:] if _is_empty(node)]
        nodes = list(dict.fromkeys([*chosen, *without_surface(self._workspace.scene)]))
        through = self._workspace.through.node
        nodes = [node for node in nodes if node is not through]
        if not nodes:
            return
        nodes.sort(key=lambda node: node not in selection)  # their names come first
        places = np.array([node.world_pose[:3, 3] for node in nodes])
        reaches = self._reaches(frame, places).tolist()
        if self.shown["icons"]:
            for color, is_selected in ((_ICON, False), (_SELECTED, True)):
                drawn = [
                    icon(node, reach)
                    for node, reach in zip(nodes, reaches, strict=True)
                    if (node in selection) == is_selected and reach > 0.0
                ]
                if drawn:
                    self._collect(frame, np.concatenate(drawn), color)
        if self.shown["names"]:
            pixels = frame.project(places)[0].tolist()
            named = zip(nodes, pixels, reaches, strict=True)
            texts = [(node.name, pixel) for node, pixel, reach in named if reach > 0.0]
            self._names = [text for text in texts if text[0]][:MOST_NAMES]

    def _reaches(self, frame: Frame, places: np.ndarray) -> np.ndarray:
        """Return how many world units at each place are as long as an icon; 0 if it is unseen."""
        right = self._workspace.camera()[1][:3, 0]
        (here, near), (there, _) = frame.project(places), frame.project(places + right)
        pixels = np.hypot(*(there - here).T)
        seen = (near > 0.0) & np.isfinite(pixels) & (pixels > 0.0)
        size = ICON_SIZE * imgui.get_font_size()
        return np.where(seen, size / np.where(seen, pixels, 1.0), 0.0)

    def _outlines(self, node: Node, frame: Frame):
        """Yield the outlines of a selected node, with their colours."""
        reach = LONGEST * self._workspace.bounds.radius
        if self.shown["boxes"] and node.bounds is not None:
            yield box_lines(*node.bounds), _BOX
        if self.shown["outlines"]:
            if isinstance(node.object, Camera) and node is not self._workspace.through.node:
                yield camera_frustum(node, frame.size, reach), _FRUSTUM
            yield outline(node, reach / LONGEST), _FRUSTUM
        if self.shown["colliders"]:
            yield collider_lines(node), _COLLIDER
        if self.shown["normals"] and isinstance(node.object, Mesh | InstancedMesh):
            yield _normals(node), _NORMAL


def _is_empty(node: Node) -> bool:
    return node.object is None and node.shown


def _normals(node: Node) -> np.ndarray:
    """Return the normals of a node's mesh as segments in world space, (N, 2, 3)."""
    held = node.object
    mesh = held.mesh if isinstance(held, InstancedMesh) else held
    if mesh.normals is None or not len(mesh.positions):
        return np.zeros((0, 2, 3))
    step = -(-len(mesh.positions) // MOST_EDGES)
    low, high = mesh.bounds
    length = 0.04 * float(np.max(high - low))
    starts = mesh.positions[::step, :3].astype(np.float64)
    ends = starts + length * mesh.normals[::step]
    points = np.concatenate([starts, ends])
    return linalg.transform_points(node.world_pose, points).reshape(2, -1, 3).swapaxes(0, 1)


def _draw_names(
    lines, corner, room: tuple[int, int], texts: Sequence[tuple[str, list[float]]]
) -> None:
    """Draw names beside their places, on a dark ground; those that would overlap are left out."""
    color, ground = imgui.get_color_u32(_ICON), imgui.get_color_u32(SHADOW)
    taken: list[tuple[float, float, float, float]] = []
    for text, pixel in texts:
        size = imgui.calc_text_size(text)
        place = place_of_name(pixel, size, room, ICON_SIZE / 2 * imgui.get_font_size())
        if place is None:
            continue
        left, top = corner.x + place[0], corner.y + place[1]
        box = (left - 2.0, top, left + size.x + 2.0, top + size.y)
        if any(_overlap(box, other) for other in taken):
            continue
        taken.append(box)
        lines.add_rect_filled(box[:2], box[2:], ground, 3.0)
        lines.add_text((left, top), color, text)


def place_of_name(
    pixel: Sequence[float], size: Sequence[float], room: Sequence[float], aside: float
) -> tuple[float, float] | None:
    """Return where a name stands beside a pixel, whole; None if that is out of the picture."""
    (x, y), (wide, high) = pixel, size
    if not (-aside < x < room[0] + aside and -aside < y < room[1] + aside):
        return None  # nor is any of its icon to be seen
    left = x + aside if x + aside + wide <= room[0] else max(x - aside - wide, 0.0)
    return left, min(max(y - high / 2, 0.0), room[1] - high)


def _overlap(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _draw_lines(lines, ends: np.ndarray, color: Color) -> None:
    """Draw lines between pixels, (N, 2, 2), on dark ones."""
    for name, wide in ((SHADOW, scaled(3.0)), (color, scaled(1.0))):
        packed = imgui.get_color_u32(name)
        for start, end in ends.tolist():
            lines.add_line(start, end, packed, wide)

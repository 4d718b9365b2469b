"""The ways of moving nodes, drawn over the scene: circles of orbits, paths, lines of keyframes.

In: the shown frame, and the selected nodes. Out: ImGui lines, drawn without depth test.
"""

from __future__ import annotations

import math

import numpy as np

from .....base import linalg
from .....model.motion.node_motion import NodeMotion
from .....model.motion.orbits import Orbit
from .....model.motion.paths import Path
from .....model.scene.animation import Track
from .....model.scene.nodes import Node
from .....rendering.frame import Frame
from ...motion_copies import motions_in
from ..translated_imgui import imgui
from ..workspace import Workspace

_WAY = (0.9, 0.55, 1.0, 0.8)
_POINT_PIXELS = 3.0
_CIRCLE, _PATH = 64, 24  # points of a circle; of a path, for each of its own
#: Ways of more nodes would hide the scene.
MOST_NODES = 16


def draw_ways(workspace: Workspace, frame: Frame, corner) -> None:
    """Draw the ways of the selected nodes over a frame with its corner at a window position."""
    motions = motions_in(workspace.scene)
    if not any(motions):
        return
    lines = imgui.get_window_draw_list()
    lines.push_clip_rect(corner, (corner.x + frame.width, corner.y + frame.height), True)
    for node in workspace.document.selection.nodes[-MOST_NODES:]:
        for motion in motions.of(node):
            way, points = _way_of(motion, node)
            _draw_line(lines, frame, corner, way)
            _draw_points(lines, frame, corner, points)
    lines.pop_clip_rect()


def _way_of(motion: NodeMotion, node: Node) -> tuple[np.ndarray, np.ndarray]:
    """Return a line, (N, 3), and the points that define it, (K, 3), in world space."""
    none = np.zeros((0, 3))
    if isinstance(motion, Orbit):
        circle = [motion.place(motion.period * k / _CIRCLE) for k in range(_CIRCLE + 1)]
        if motion.about is not None:
            return motion.about.world_pose[:3, 3] + circle, none
        return (none, none) if motion.is_about_node else (_in_world(node, circle), none)
    if isinstance(motion, Path):
        count = _PATH * len(motion.points) if motion.smooth else 0
        shares = np.union1d(np.linspace(0.0, 1.0, count + 2), motion.shares)
        line = [motion.at(share)[0] for share in shares.tolist()]
        return _in_world(node, line), _in_world(node, motion.points)
    if isinstance(motion, Track) and motion.translations is not None:
        points = _in_world(node, motion.translations)
        return points, points
    return none, none


def _in_world(node: Node, points) -> np.ndarray:
    """Return points of the space of a node's parent in world space."""
    points = np.asarray(points, np.float64)
    if node.parent is None:
        return points
    return linalg.transform_points(node.parent.world_pose, points)


def _draw_line(lines, frame: Frame, corner, way: np.ndarray) -> None:
    """Draw a line through points; parts behind the camera are left out."""
    if len(way) < 2:
        return
    places, depths = frame.project(way)
    places = places + (corner.x, corner.y)
    shown = (depths > 0) & np.isfinite(places).all(axis=1)
    color = imgui.get_color_u32(_WAY)
    pairs = np.flatnonzero(shown[1:] & shown[:-1]).tolist()
    at = places.tolist()
    for first in pairs:
        lines.add_line(at[first], at[first + 1], color)


def _draw_points(lines, frame: Frame, corner, points: np.ndarray) -> None:
    if not len(points):
        return
    places, depths = frame.project(points)
    color = imgui.get_color_u32(_WAY)
    for (x, y), depth in zip(places.tolist(), depths.tolist(), strict=True):
        if depth > 0 and math.isfinite(x) and math.isfinite(y):
            lines.add_circle_filled((corner.x + x, corner.y + y), _POINT_PIXELS, color)

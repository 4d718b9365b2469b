"""Debug lines of culling over a picture: boxes, the tree of boxes, a frustum.

In: a scene, a camera, a frame of the same view. Out: lines on the frame, without depth test.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...base.box_corners import CORNER_ENDS, box_corners
from ...model.scene.cameras import Camera, far_depth
from ...model.scene.instances import MANY, InstancedMesh, instance_tree
from ...model.scene.scene import Scene
from ...rendering.frame import Frame

DEBUG_DRAWINGS = (None, "boxes", "tree of boxes", "frustum")
BOX = (90, 220, 255, 255)
FRUSTUM = (255, 220, 60, 255)
#: Colours of tree branches by level, from the leaves up, cyclically.
LEVELS = ((255, 120, 90, 255), (255, 190, 80, 255), (170, 230, 90, 255), (200, 140, 255, 255))
#: More boxes would be unreadable, and nested ones sooner.
MOST_BOXES, MOST_IN_TREES = 20_000, 4_000
#: Lines are clipped at this fraction of the farthest corner's distance, before they pass behind the
#: camera.
NEAREST = 1e-4
#: The edges of a box, by the bits of its corners.
_EDGES = np.array([(a, a | bit) for a in range(8) for bit in (1, 2, 4) if not a & bit])


class Lines(NamedTuple):
    """Segments (N, 2, 3) in world space, and their colour."""

    segments: np.ndarray
    color: tuple[int, int, int, int]


def box_lines(scene: Scene) -> list[Lines]:
    """Return the boxes of visible objects."""
    boxes = [box for node in scene.nodes if (box := node.bounds) is not None][:MOST_BOXES]
    return [Lines(box_edges(np.array(boxes)), BOX)] if boxes else []


def tree_lines(scene: Scene) -> list[Lines]:
    """Return the boxes of the culling trees, leaves and branches, by level.

    The scene's nodes have one tree, and so have the instances of each node with many. If there are
    too many boxes, the lowest levels are left out.
    """
    scene.data.update()
    trees = [([_finite(level) for level in scene.data.arrays.boxes_by_level()], np.eye(4))]
    for node in scene.nodes:
        if isinstance(node.object, InstancedMesh) and len(node.object) >= MANY and node.shown:
            levels = instance_tree(node.object)[0].boxes_by_level()
            trees.append(([_finite(level) for level in levels], node.world_pose))
    lines, room = [], MOST_IN_TREES
    for levels, pose in trees:
        for number, boxes in reversed(list(enumerate(levels))):
            room -= len(boxes)
            if room < 0:
                break
            color = LEVELS[(number - 1) % len(LEVELS)] if number else BOX
            edges = linalg.transform_points(pose, box_edges(boxes).reshape(-1, 3))
            lines.append(Lines(edges.reshape(-1, 2, 3), color))
    return lines[::-1]


def _finite(rows: np.ndarray) -> np.ndarray:
    """Return the finite boxes among (N, 6) as ends (N, 2, 3) float64."""
    return rows[np.isfinite(rows).all(axis=1)].reshape(-1, 2, 3).astype(np.float64)


def frustum_lines(camera: Camera, pose: np.ndarray, size: tuple[int, int]) -> list[Lines]:
    """Return the frustum of a camera at a pose."""
    view_from_clip = linalg.inverse(np.asarray(camera.projection(size), np.float64))
    signs = CORNER_ENDS * 2.0 - 1.0
    signs[signs[:, 2] > 0.0, 2] = far_depth(camera)
    corners = view_from_clip[:, 3] + sum(
        signs[:, axis, np.newaxis] * view_from_clip[:, axis] for axis in range(3)
    )
    corners = corners[:, :3] / corners[:, 3:]
    world = linalg.transform_points(pose, corners)
    return [Lines(world[_EDGES], FRUSTUM)]


def draw_lines(frame: Frame, lines: list[Lines], width: float = 1) -> None:
    """Draw lines on a frame as its camera sees them."""
    canvas = frame.canvas()
    for segments, color in lines:
        kept = _before(frame, np.asarray(segments, np.float64))
        pixels, _ = frame.project(kept.reshape(-1, 3))
        canvas.lines(pixels.reshape(-1, 4), color, width=width)


def _before(frame: Frame, segments: np.ndarray) -> np.ndarray:
    """Return the parts of segments in front of the camera."""
    depths = frame.project(segments.reshape(-1, 3))[1].reshape(-1, 2)
    least = NEAREST * float(np.abs(depths).max(initial=1e-9))
    kept = (depths > least).any(axis=1)
    segments, depths = segments[kept].copy(), depths[kept]
    for end in (0, 1):
        behind = depths[:, end] < least
        first, second = depths[behind, end], depths[behind, 1 - end]
        share = ((least - first) / (second - first))[:, np.newaxis]
        there, here = segments[behind, 1 - end], segments[behind, end]
        segments[behind, end] = here + (there - here) * share
    return segments


def box_edges(boxes: np.ndarray) -> np.ndarray:
    """Return the edges of boxes (N, 2, 3) as segments (12 N, 2, 3)."""
    return box_corners(boxes)[:, _EDGES].reshape(-1, 2, 3)

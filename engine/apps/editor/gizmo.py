"""Arithmetic for moving nodes: steps, rotations and scales about a point, and the ground.

In: numbers, points and axes in world space. Out: matrices, and functions that move nodes.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.validation import positive, vector3
from ...model.scene.nodes import with_below
from ...model.scene.scene import Scene
from ...model.scene.selection import NodeSelection
from .selection import topmost


def snapped(value: ArrayLike, step: float | None) -> NDArray[np.float64]:
    """Return numbers rounded to whole steps; unchanged without a step."""
    numbers = np.asarray(value, np.float64)
    if not step:
        return numbers.copy()
    return np.round(numbers / positive(step, "step")) * step + 0.0


def turned(axis: ArrayLike, angle: float, center: ArrayLike) -> NDArray[np.float64]:
    """Return the matrix that rotates the world about an axis through a point, (4, 4) float64."""
    return _about(linalg.rotation_axis(axis, angle), center)


def scaled(factors: ArrayLike, center: ArrayLike) -> NDArray[np.float64]:
    """Return the matrix that scales the world about a point along x, y and z, (4, 4) float64."""
    return _about(linalg.scaling(factors), center)


def on_ground(scene: Scene, up: ArrayLike = (0, 1, 0)) -> Callable[[NodeSelection], None]:
    """Return the moves that drop nodes onto what is below them, or onto 0, for `MoveNodes`.

    A node moves with its subtree against ``up``, until the lowest point of its box reaches the
    first hit of a ray from the centre of the box.
    """
    upward = linalg.normalize(vector3(up, "up"))

    def move(selection: NodeSelection) -> None:
        for node in topmost(selection.nodes):
            box = _box(scene, node)
            if box is None:
                continue
            middle, reach = (box[0] + box[1]) * 0.5, (box[1] - box[0]) * 0.5
            height = float(linalg.dot(middle, upward)) - float(linalg.dot(reach, np.abs(upward)))
            was_visible, node.visible = node.visible, False  # it must not hit itself
            hit = scene.raycast(middle, -upward)
            node.visible = was_visible
            ground = 0.0 if hit is None else float(linalg.dot(hit.position, upward))
            _shift(node, upward * (ground - height))

    return move


def _about(matrix: NDArray[np.float64], center: ArrayLike) -> NDArray[np.float64]:
    point = vector3(center, "center")
    return linalg.multiply(linalg.translation(point), matrix, linalg.translation(-point))


def _shift(node, offset: NDArray[np.float64]) -> None:
    pose = linalg.multiply(linalg.translation(offset), node.world_pose)
    if node.parent is not None:
        pose = linalg.multiply(linalg.inverse(node.parent.world_pose), pose)
    node.pose = pose


def _box(scene: Scene, node) -> NDArray[np.float64] | None:
    """Return the box around a node and its subtree, (2, 3) float64."""
    boxes = scene.select(with_below(node)).bounds
    boxes = boxes[~np.isnan(boxes[:, 0, 0])]
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]) if len(boxes) else None


def steps_of_turn(degrees: float) -> float:
    """Return a step for angles in radians."""
    return math.radians(positive(degrees, "degrees"))

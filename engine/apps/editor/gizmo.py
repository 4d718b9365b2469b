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


#: What arrow keys do: the axis (right, up, towards the eye) and the sign of moves and of turns.
NUDGES = {
    "left_arrow": ((0, -1.0), (1, -1.0)),
    "right_arrow": ((0, 1.0), (1, 1.0)),
    "up_arrow": ((2, -1.0), (0, -1.0)),
    "down_arrow": ((2, 1.0), (0, 1.0)),
    "page_up": ((1, 1.0), (2, 1.0)),
    "page_down": ((1, -1.0), (2, -1.0)),
}
_SMALLER = ("left_arrow", "down_arrow", "page_down")


def axes_towards(view: NDArray[np.float64], up: ArrayLike) -> NDArray[np.float64]:
    """Return the axes of the world that are nearest to right, up and towards the eye, as columns.

    Parameters
    ----------
    view : (3, 3) float64
        The axes of the camera, as columns.
    up : (3,) float
        An axis of the world.
    """
    upward = vector3(up, "up")
    flat = view[:, 0] * (np.abs(upward) < 0.5)  # the eye's right is level
    right = np.zeros(3)
    at = int(np.argmax(np.abs(flat)))
    right[at] = np.sign(flat[at]) or 1.0
    return np.stack([right, upward, np.cross(right, upward)], axis=1)


def nudged(
    tool: str, key: str, axes: NDArray[np.float64], step: float, center: ArrayLike
) -> NDArray[np.float64]:
    """Return the matrix by which an arrow key changes the world, (4, 4) float64.

    Parameters
    ----------
    tool : str
        ``"move"``, ``"rotate"`` or ``"scale"``; the last acts along all axes alike.
    key : str
        Of `NUDGES`.
    axes : (3, 3) float64
        Right, up and towards the eye, as columns.
    step : float
        In units, degrees or per cent.
    center : (3,) float
        What is turned and scaled about.
    """
    move, turn = NUDGES[key]
    if tool == "move":
        axis, sign = move
        return linalg.translation(axes[:, axis] * sign * step)
    if tool == "rotate":
        axis, sign = turn
        return turned(axes[:, axis], sign * steps_of_turn(step), center)
    factor = 1.0 + step / 100.0
    return scaled(np.full(3, 1.0 / factor if key in _SMALLER else factor), center)

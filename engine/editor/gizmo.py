"""The arithmetic of handles that are dragged: along an axis, in a plane, around an axis, in steps.

In: rays of the mouse in world space, before and now. Out: distances, angles, factors and what moves
nodes by them. Nothing here knows how handles look.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import linalg
from .._support.validation import positive, vector3
from ..scene.scene import Scene
from ..scene.selection import NodeSelection
from .selection import topmost

Ray = tuple[ArrayLike, ArrayLike]  # origin and direction, world space
_PARALLEL = 1e-9


def snapped(value: ArrayLike, step: float | None) -> NDArray[np.float64]:
    """Return numbers rounded to whole steps; as they are without a step."""
    numbers = np.asarray(value, np.float64)
    if not step:
        return numbers.copy()
    return np.round(numbers / positive(step, "step")) * step + 0.0


def along_axis(origin: ArrayLike, axis: ArrayLike, ray: Ray) -> float | None:
    """Return where on an axis a ray comes nearest to it, in lengths of the axis from its origin.

    None if they are parallel. The difference of two such numbers is how far a handle was dragged.
    """
    start, along = vector3(origin, "origin"), vector3(axis, "axis")
    eye, direction = vector3(ray[0], "origin"), linalg.normalize(vector3(ray[1], "direction"))
    between = eye - start
    length, mixed = float(linalg.dot(along, along)), float(linalg.dot(along, direction))
    apart = length - mixed * mixed  # length squared times the squared sine between them
    if not apart > _PARALLEL * length:
        return None
    onto_axis, onto_ray = float(linalg.dot(along, between)), float(linalg.dot(direction, between))
    return (onto_axis - mixed * onto_ray) / apart


def in_plane(origin: ArrayLike, normal: ArrayLike, ray: Ray) -> NDArray[np.float64] | None:
    """Return where a ray meets a plane, (3,) float64; None if it is parallel or points away."""
    eye, direction = vector3(ray[0], "origin"), linalg.normalize(vector3(ray[1], "direction"))
    across = linalg.normalize(vector3(normal, "normal"))
    slope = float(linalg.dot(direction, across))
    if not abs(slope) > _PARALLEL:
        return None
    distance = float(linalg.dot(vector3(origin, "origin") - eye, across)) / slope
    return eye + direction * distance if distance >= 0.0 else None


def around_axis(origin: ArrayLike, axis: ArrayLike, first: Ray, ray: Ray) -> float | None:
    """Return the angle between two rays around an axis, in radians from -pi to pi.

    It is measured in the plane through ``origin`` that is perpendicular to the axis, positive
    counter-clockwise seen from the axis's tip; None if a ray does not meet the plane.
    """
    points = [in_plane(origin, axis, each) for each in (first, ray)]
    if points[0] is None or points[1] is None:
        return None
    a, b = (point - vector3(origin, "origin") for point in points)
    across = linalg.normalize(vector3(axis, "axis"))
    sine, cosine = float(linalg.dot(linalg.cross(a, b), across)), float(linalg.dot(a, b))
    return float(linalg.atan2(sine, cosine)) if sine or cosine else 0.0


def turned(axis: ArrayLike, angle: float, center: ArrayLike) -> NDArray[np.float64]:
    """Return the matrix that turns the world around an axis through a point, (4, 4) float64."""
    return _about(linalg.rotation_axis(axis, angle), center)


def scaled(factors: ArrayLike, center: ArrayLike) -> NDArray[np.float64]:
    """Return the matrix that scales the world along x, y and z from a point, (4, 4) float64."""
    return _about(linalg.scaling(factors), center)


def on_grid(step: float) -> Callable[[NodeSelection], None]:
    """Return what puts nodes at whole steps below their parents, for `MoveNodes`."""

    def move(selection: NodeSelection) -> None:
        selection.translations = snapped(selection.translations, step)

    return move


def on_ground(scene: Scene, up: ArrayLike = (0, 1, 0)) -> Callable[[NodeSelection], None]:
    """Return what lets nodes down on what is below them, or on 0 if nothing is, for `MoveNodes`.

    A node moves against ``up``, as one with all below it, until the lowest point of its box is as
    low as what the ray from the middle of the box meets first.
    """
    upward = linalg.normalize(vector3(up, "up"))

    def move(selection: NodeSelection) -> None:
        for node in topmost(selection.nodes):
            box = _box(scene, node)
            if box is None:
                continue
            middle, reach = (box[0] + box[1]) * 0.5, (box[1] - box[0]) * 0.5
            height = float(linalg.dot(middle, upward)) - float(linalg.dot(reach, np.abs(upward)))
            was_visible, node.visible = node.visible, False  # not to meet itself
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
    """The box around a node and all below it, (2, 3) float64."""
    nodes = [node._arrays.nodes[slot] for slot in node._arrays.below(node._slot)]
    boxes = scene.select(nodes).bounds
    boxes = boxes[~np.isnan(boxes[:, 0, 0])]
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]) if len(boxes) else None


def steps_of_turn(degrees: float) -> float:
    """Return a step for angles in radians."""
    return math.radians(positive(degrees, "degrees"))

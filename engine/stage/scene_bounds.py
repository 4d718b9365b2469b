"""The extent of a scene, for clip planes and for the first view.

In: a `Scene`. Out: a `Sphere`, or points around everything visible. Non-finite vertices are
ignored; instances count as their boxes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import ArrayLike

from .._native.scene_graph import SHOWN
from ..base import linalg
from ..base.box_corners import box_corners
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh
from ..model.scene.nodes import Node
from ..model.scene.orbiting import cosine, home_axes, sine
from ..model.scene.scene import Scene
from ..model.scene.shown import placing_pose, shown_object
from .views.viewpoint import Sphere

#: Number of bands with which `turning_outline` follows a scene.
OUTLINE_BANDS = 24
OUTLINE_ANGLES = 24
_SLACK = 1e-12  # more than the rounding of boxes and distances, relative to them


def bounding_sphere(scene: Scene) -> Sphere:
    """Return a sphere around every visible mesh of ``scene``.

    Its centre is that of the bounding box, and it reaches to the farthest vertex; instances count
    as their boxes. An empty scene gets a sphere of radius one.
    """
    low, high = scene.bounds
    center = (low + high) / 2
    farthest = 0.0
    slots, reaches = _reaches(scene, center)
    for slot, reach in zip(slots.tolist(), reaches.tolist(), strict=True):
        if reach < farthest:
            break
        for points in _points_of(scene.data.arrays.nodes[slot]):
            offsets = points - center
            farthest = max(farthest, float(linalg.dot(offsets, offsets).max(initial=0.0)))
    return Sphere(tuple(center.tolist()), math.sqrt(farthest) or 1.0)


def _reaches(scene: Scene, center: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the slots of visible nodes, farthest first, and squared distances that all exceed.

    No vertex is farther from the centre than its node's (N,) float64; where that is unknown, it is
    infinite.
    """
    arrays = scene.data.arrays
    columns, count = arrays.columns, arrays.count
    slots = np.flatnonzero(columns["flags"][:count] & SHOWN)
    boxes = columns["bounds"][slots, :6].reshape(-1, 2, 3)
    with np.errstate(over="ignore", invalid="ignore"):
        sides = np.abs(boxes - center) + np.abs(boxes) * _SLACK
        reaches = linalg.dot(*[sides.max(axis=1) * (1.0 + _SLACK)] * 2)
    reaches[~np.isfinite(reaches)] = np.inf
    order = np.argsort(-reaches, kind="stable")
    return slots[order], reaches[order]


def sphere_of_points(points: np.ndarray) -> Sphere:
    """Return the sphere around the middle of points, (N, 3); around a single place, radius one."""
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    offsets = points - center
    farthest = float(linalg.dot(offsets, offsets).max())
    return Sphere(tuple(center.tolist()), math.sqrt(farthest) or 1.0)


def sphere_of_box(box: np.ndarray) -> Sphere:
    """Return the sphere around a box, (2, 3); an empty box gives radius one."""
    center, half = (box[0] + box[1]) / 2, (box[1] - box[0]) / 2
    return Sphere(tuple(center.tolist()), float(linalg.length(half)) or 1.0)


def turning_outline(scene: Scene, up: ArrayLike) -> np.ndarray:
    """Return points around everything visible in ``scene``, for any rotation about ``up``.

    Framing them keeps a turntable in the picture, more tightly than a sphere would. They lie on
    rings about the vertical axis through the scene's centre, as wide as the scene at their height.

    Parameters
    ----------
    scene : Scene
        The scene to surround.
    up : (3,) sequence of float
        The axis's direction.

    Returns
    -------
    (N, 3) ndarray of float64
        World space. An empty scene gets rings of radius one.
    """
    return _turning_outline(world_points(scene), scene.bounds, up)


def turning_outline_of_points(points: np.ndarray, up: ArrayLike) -> np.ndarray:
    """Return points around others, (N, 3), as `turning_outline` does."""
    bounds = np.stack([points.min(axis=0), points.max(axis=0)])
    return _turning_outline([points], bounds, up)


def _turning_outline(parts: Iterable[np.ndarray], bounds: np.ndarray, up: ArrayLike) -> np.ndarray:
    """Return rings around points, given in parts, about the axis through the middle of bounds."""
    right, up, back = home_axes(up)
    low, high = bounds
    center = (low + high) / 2
    rises, squares = [np.zeros(1)], [np.zeros(1)]
    for points in parts:
        offsets = points - center
        rises.append(linalg.dot(offsets, up))
        across, along = linalg.dot(offsets, right), linalg.dot(offsets, back)
        squares.append(across * across + along * along)
    heights, widths = np.concatenate(rises), np.sqrt(np.concatenate(squares))
    bottom, top = float(heights.min()), float(heights.max())
    if top == bottom and not widths.any():
        bottom, top, widths = -1.0, 1.0, np.ones_like(widths)
    step = (top - bottom) / OUTLINE_BANDS or 1.0
    with np.errstate(all="ignore"):
        shares = np.nan_to_num((heights - bottom) / step)
    bands = np.clip(shares, 0, OUTLINE_BANDS - 1).astype(np.intp)
    widest = np.zeros(OUTLINE_BANDS)
    np.maximum.at(widest, bands, widths)
    levels = bottom + step * np.arange(OUTLINE_BANDS + 1)
    # A band's ring is placed at both of its ends: the height of the widest point in the band is
    # unknown.
    rings = [(level, max(pair)) for level, pair in zip(levels, _ends(widest), strict=True)]
    angles = [2 * math.pi * k / OUTLINE_ANGLES for k in range(OUTLINE_ANGLES)]
    circle = [right * sine(angle) + back * cosine(angle) for angle in angles]
    return np.array([center + up * level + spoke * w for level, w in rings for spoke in circle])


def _ends(widest: np.ndarray) -> list[tuple[float, float]]:
    """Return the widths of the bands below and above each level."""
    return list(zip([0.0, *widest], [*widest, 0.0], strict=True))


def world_points(scene: Scene) -> Iterator[np.ndarray]:
    """Yield the finite vertices of visible meshes, (N, 3) in world space; boxes for instances."""
    scene.data.update()
    for node in scene.nodes:
        if node.shown:
            yield from _points_of(node)


def _points_of(node: Node) -> Iterator[np.ndarray]:
    """Yield the finite vertices of a node's mesh, as `world_points`; nothing without a mesh."""
    points = _outline(node)
    if points is not None:
        with np.errstate(over="ignore", invalid="ignore"):
            points = linalg.transform_points(placing_pose(node), points)
        yield points[np.isfinite(points).all(axis=1)]


def _outline(node: Node) -> np.ndarray | None:
    """Return points of the node's mesh, (N, 3) in its own space, that include its convex hull."""
    shape = shown_object(node)
    if isinstance(shape, Mesh):
        return shape.positions
    if isinstance(shape, InstancedMesh):
        box = shape.bounds_in_node()
        if box is None:  # there are no instances
            return None
        return box_corners(np.array(box, dtype=np.float64))
    return None

"""Moves scenes far from the origin, such as maps, near to it for viewing.

In: a `ViewedScene`. Out: the same, moved near the origin, where 32-bit floats of light and shadow
are precise; and the origin's position in the file's coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..io.reading.far_coordinates import origin_near
from .viewed_scene import ViewedScene

# Node poses hold any distance exactly; lights and eyes become imprecise from this many sizes on.
_FAR = 2048.0


def moved_near(viewed: ViewedScene) -> ViewedScene:
    """Move a scene that is far from the origin, in place; return it.

    Its top-level nodes become children of one new node.
    """
    scene = viewed.scene
    low, high = scene.bounds
    origin = origin_near(low, high, _FAR)
    if origin is not None:
        tops = [node for node in scene.nodes if node.parent is None]
        group = scene.add(name="origin", translation=-origin)
        for node in tops:
            node.reparent(group, keep_world_pose=False)
        x, y, z = origin.tolist()
        viewed.origin = (x, y, z)
    return viewed


def from_file(viewed: ViewedScene, position: Sequence[float]) -> tuple[float, ...]:
    """Return the scene position of a point in the file's coordinates."""
    pairs = zip(position, viewed.origin, strict=True)
    return tuple(float(place) - origin for place, origin in pairs)


def pose_from_file(viewed: ViewedScene, pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the pose in the scene of one in the file's coordinates."""
    moved = pose.copy()
    moved[:3, 3] -= viewed.origin
    return moved


def pose_in_file(viewed: ViewedScene, pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the pose in the file's coordinates of one in the scene."""
    moved = pose.copy()
    moved[:3, 3] += viewed.origin
    return moved

"""Scenes far from the origin, as maps have them, are looked at from near it.

In: a `ViewedScene`. Out: the same, all of it moved to near the origin, where the 32-bit floats of
light and shadow are fine; and where the origin is in the files' coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..io.reading.far_coordinates import origin_near
from .viewed_scene import ViewedScene

# Nodes hold the distance exactly; only from so many sizes away do lights and eyes become coarse.
_FAR = 2048.0


def moved_near(viewed: ViewedScene) -> ViewedScene:
    """Move a scene that is far from the origin, in place; return it.

    What is at its top hangs under one more node then.
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
    """Return where a position in the files' coordinates is in the scene."""
    pairs = zip(position, viewed.origin, strict=True)
    return tuple(float(place) - origin for place, origin in pairs)

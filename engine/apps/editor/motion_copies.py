"""Motions of copied nodes: copies move as their originals do.

In: nodes with their copies. Out: motions in the animator of the copies' scene.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...model.motion.node_motion import NodeMotion
from ...model.motion.orbits import Orbit
from ...model.scene.animation import (
    Animator,
    Motions,
    copied_motions,
    motions_of,
    set_motions,
)
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene


def motions_in(scene: Scene) -> Motions:
    """Return the motions of a scene; none without an animator."""
    return Motions() if scene.animator is None else motions_of(scene.animator)


def put_motions(scene: Scene, motions: Motions) -> None:
    """Give a scene motions, and an animator if it needs one."""
    if scene.animator is None and any(motions):
        scene.animator = Animator(scene)
    if scene.animator is not None:
        set_motions(scene.animator, motions)


def move_alike(made: Mapping[Node, Node]) -> None:
    """Let copies move as their originals.

    A copy circles the copy of what its original circles, or the same node if that has no copy; an
    orbit about a node of another scene is left out.

    Parameters
    ----------
    made : dict of Node to Node
        The copies, all in one scene, by their originals, all of one scene; may be empty.
    """
    if not made:
        return
    original, twin = next(iter(made.items()))
    if original.scene is None or twin.scene is None:
        return
    found = copied_motions(motions_in(original.scene), lambda node: made.get(node, node))
    found = found.kept(lambda motion: _is_of(twin.scene, motion))
    if any(found):
        put_motions(twin.scene, motions_in(twin.scene).joined(found))


def _is_of(scene: Scene | None, motion: NodeMotion) -> bool:
    if not isinstance(motion, Orbit) or not motion.is_about_node:
        return True
    return motion.about is not None and motion.about.scene is scene

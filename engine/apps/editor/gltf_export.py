"""Writes a document's scene as glTF 2.0, its motion as an animation.

In: a scene, a path. Out: a file. The scene is as before. Spins, orbits, paths and keyframes of its
animator become keys, several in a second: glTF has no other motion.
"""

from __future__ import annotations

import math

import numpy as np

from ...io.formats.gltf.gltf_writer import EXTENSIONS
from ...io.writing.scene_saving import save_scene
from ...model.motion.clips import PATHS, AnimationClip, Channel
from ...model.motion.periods import common_period
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from .motion_copies import motions_in

#: The extensions of glTF files.
GLTF_EXTENSIONS = EXTENSIONS
#: Keys a second of what moves.
KEYS_A_SECOND = 30
_CLIP = "Motion"


def export_gltf(scene: Scene, path: str) -> None:
    """Write a scene; losses are issued as `Engine3DWarning`.

    Raises
    ------
    FileAccessError
    """
    clip = clip_of_motion(scene)
    if clip is None:
        save_scene(scene, path)
        return
    animations, animator = dict(scene.animations), scene.animator
    name, number = _CLIP, 1
    while name in animations:
        number += 1
        name = f"{_CLIP} {number}"
    try:
        scene.animations = {**animations, name: clip}
        scene.animator = None  # it is in the file: no loss
        save_scene(scene, path)
    finally:
        scene.animations, scene.animator = animations, animator


def clip_of_motion(scene: Scene) -> AnimationClip | None:
    """Return the motion of a scene's animator as keys; None if nothing moves."""
    motions = motions_in(scene)
    period = common_period(motions)
    if period is None or scene.animator is None:
        return None
    found = {motion.node: None for kind in motions for motion in kind}
    moving = [node for node in found if node is not None and node.scene is scene]
    copied = scene.copy()  # which is moved instead
    twins = dict(zip(scene.nodes, copied.nodes, strict=True))
    times = np.linspace(0.0, period, max(math.ceil(period * KEYS_A_SECOND), 1) + 1)
    parts = PATHS[:3]
    rows: dict[str, list[np.ndarray]] = {part: [] for part in parts}
    for time in times.tolist():
        copied.animator.seek(time)
        selection = copied.select([twins[node] for node in moving])
        for part in parts:
            rows[part].append(getattr(selection, f"{part}s"))
    channels = [
        channel
        for part in parts
        for channel in _channels(part, moving, times, np.stack(rows[part]))
    ]
    return AnimationClip(channels, _CLIP) if channels else None


def _channels(part, nodes: list[Node], times: np.ndarray, values: np.ndarray) -> list[Channel]:
    """Return the keys of a part of nodes, (T, N, C), that changes."""
    return [
        Channel(node, part, times, np.ascontiguousarray(values[:, number]))
        for number, node in enumerate(nodes)
        if (values[:, number] != values[0, number]).any()
    ]

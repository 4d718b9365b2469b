"""The animations of a viewed model: which clips play, and the extent of their motion.

In: a `ViewedScene` whose scene has clips; a clip number, counted as in f3d, and a time. Out: the
viewed scene plays the clips, or holds their pose at the time.
"""

from __future__ import annotations

import numpy as np

from ..model.motion.clips import AnimationClip
from ..model.motion.player import AnimationPlayer
from .scene_bounds import sphere_of_box
from .viewed_scene import NotInModelError, ViewedScene

#: At this many times of a clip, the scene's extent is measured.
LOOKS = 16


def choose_clips(viewed: ViewedScene, index: int | None) -> tuple[AnimationClip, ...]:
    """Return the clip with a number, or all for -1; for None the first, if there is one.

    Raises
    ------
    NotInModelError
    """
    clips = tuple(viewed.scene.animations.values())
    if index is None:
        return clips[:1]
    if index < 0 and clips:
        return clips
    if not 0 <= index < len(clips):
        known = f"the last is {len(clips) - 1}" if clips else "there are none"
        raise NotInModelError(f"{viewed.title} has no animation {index} ({known})")
    return (clips[index],)


def stand_at(viewed: ViewedScene, index: int | None, time: float) -> None:
    """Set a scene to the pose of clips at a time; times after the end hold the end."""
    clips = choose_clips(viewed, index)
    if not clips:
        raise NotInModelError(f"{viewed.title} has no animation")
    player = AnimationPlayer(viewed.scene, clips)
    player.loop = "once"
    player.play(clips)
    player.seek(time)


def play_clips(viewed: ViewedScene, index: int | None = None) -> None:
    """Make a viewed scene play clips in a loop; without clips it stays unchanged."""
    clips = choose_clips(viewed, index)
    if not clips:
        return
    player = viewed.player or AnimationPlayer(viewed.scene)
    player.play(clips)
    viewed.player = player
    viewed.period = player.duration or viewed.period
    viewed.plays = True
    box = _reach(viewed, player)
    viewed.update = player.seek
    viewed.focus = np.array([[box[k >> a & 1][a] for a in range(3)] for k in range(8)])
    viewed.bounds = sphere_of_box(box)
    player.seek(0.0)


def _reach(viewed: ViewedScene, player: AnimationPlayer) -> np.ndarray:
    """Return the box of the scene over all times, (2, 3), estimated from samples."""
    boxes = []
    for number in range(LOOKS):
        player.seek(viewed.period * number / LOOKS)
        boxes.append(viewed.scene.bounds)
    lows, highs = zip(*boxes, strict=True)
    return np.stack([np.min(lows, axis=0), np.max(highs, axis=0)])

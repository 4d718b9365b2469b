"""The animations of a model that is looked at: which of them play, and how far that reaches.

In: a `ViewedScene` whose scene has clips; a number, as f3d counts, and a time. Out: the viewed
scene plays them, or its scene stands as they have it at the time.
"""

from __future__ import annotations

import numpy as np

from ..model.motion.clips import AnimationClip
from ..model.motion.player import AnimationPlayer
from .scene_bounds import sphere_of_box
from .viewed_scene import NotInModelError, ViewedScene

#: Times of a clip at which is looked how far things reach.
LOOKS = 16


def choose_clips(viewed: ViewedScene, index: int | None) -> tuple[AnimationClip, ...]:
    """Return the clip of a number, or all for -1; the first for None, if there are any.

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
    """Let a scene stand as clips have it at a time; after the end as at the end."""
    clips = choose_clips(viewed, index)
    if not clips:
        raise NotInModelError(f"{viewed.title} has no animation")
    player = AnimationPlayer(viewed.scene, clips)
    player.loop = "once"
    player.play(clips)
    player.seek(time)


def play_clips(viewed: ViewedScene, index: int | None = None) -> None:
    """Let a viewed scene play clips, over and over; without any it stays as it is."""
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
    """The box of the scene at all times, (2, 3), as far as some of them tell."""
    boxes = []
    for number in range(LOOKS):
        player.seek(viewed.period * number / LOOKS)
        boxes.append(viewed.scene.bounds)
    lows, highs = zip(*boxes, strict=True)
    return np.stack([np.min(lows, axis=0), np.max(highs, axis=0)])

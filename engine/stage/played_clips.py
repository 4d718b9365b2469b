"""The animations of a viewed model: which clips play, and the extent of their motion.

In: a `ViewedScene` whose scene has clips; a clip number, counted as in f3d, and a time. Out: the
viewed scene plays the clips, or holds their pose at the time, and all of the motion shows.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from .scene_bounds import sphere_of_points, world_points
from .viewed_scene import NotInModelError, ViewedScene

if TYPE_CHECKING:
    from ..model.motion.clips import AnimationClip
    from ..model.motion.player import AnimationPlayer

#: The scene's extent is measured at so many times of a clip: so many a second, within limits, and
#: fewer for scenes of very many points.
RATE = 12
LEAST_LOOKS, MOST_LOOKS = 16, 96
MOST_POINTS = 1_000_000
#: Cells per side of the grid with which the outermost points are found, and of how many points that
#: is done at once.
CELLS, MANY = 128, 60_000


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
    player = _player(viewed, clips)
    player.loop = "once"
    player.play(clips)
    player.seek(time)


def play_clips(viewed: ViewedScene, index: int | None = None) -> None:
    """Make a viewed scene play clips in a loop; without clips it keeps the motion that it has."""
    clips = choose_clips(viewed, index)
    if clips:
        player = viewed.player or _player(viewed)
        player.play(clips)
        viewed.player = player
        viewed.period = player.duration or viewed.period
        viewed.plays = True
        viewed.update = player.seek
    if viewed.update is not None:
        viewed.swept = _swept(viewed, viewed.update)
        viewed.bounds = sphere_of_points(viewed.swept)
        viewed.update(0.0)


def _player(viewed: ViewedScene, clips: tuple[AnimationClip, ...] | None = None) -> AnimationPlayer:
    from ..model.motion.player import AnimationPlayer  # most models have no clips

    return AnimationPlayer(viewed.scene, clips)


def _swept(viewed: ViewedScene, move: Callable[[float], None]) -> np.ndarray:
    """Return points that bound the scene at all times as tightly as its vertices do, (N, 3).

    At the times between those that are looked at, it may reach a little farther.
    """
    found: list[np.ndarray] = []
    looks = _looks(viewed.period, sum(map(len, world_points(viewed.scene))))
    for number in range(looks):
        move(viewed.period * number / looks)
        points = np.concatenate([*world_points(viewed.scene), np.zeros((0, 3))])
        found.append(_outermost(points) if len(points) > MANY else points)
    swept = _outermost(np.concatenate(found))
    return swept if len(swept) else viewed.scene.bounds


def _looks(period: float, points: int) -> int:
    """Return at how many times to look at a scene of so many points."""
    wanted = min(RATE * period, MOST_POINTS / max(points, 1))
    return max(LEAST_LOOKS, min(math.ceil(wanted), MOST_LOOKS))


def _outermost(points: np.ndarray) -> np.ndarray:
    """Return places around points, (N, 3): corners of the outermost cells of a grid with points.

    They are farther out than the points by a cell's side at most.
    """
    if len(points) <= CELLS:
        return points
    low, size = points.min(axis=0), np.ptp(points, axis=0)
    with np.errstate(all="ignore"):
        shares = np.nan_to_num((points - low) / size)
    cells = np.clip(shares * CELLS, 0, CELLS - 1).astype(np.intp)
    filled = np.zeros((CELLS * CELLS, CELLS), bool)
    filled[cells[:, 0] * CELLS + cells[:, 1], cells[:, 2]] = True
    columns = np.flatnonzero(filled.any(axis=1))
    ends = [filled[columns].argmax(axis=1), CELLS - 1 - filled[columns, ::-1].argmax(axis=1)]
    places = np.concatenate([np.stack([*divmod(columns, CELLS), end], axis=1) for end in ends])
    return low + size * ((places + (2 * places >= CELLS)) / CELLS)

"""Plays clips: poses the nodes of a scene at a time.

In: clips, and the time. Out: translations, rotations, scales and morph weights of nodes, and other
properties. The values depend only on the playing clips and their times, never on earlier frames,
with the same bits on every machine. All channels are sampled together.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import get_args

import numpy as np

from ...base.calls import checks_types
from ...base.numbers import real, shown
from ...base.validation import choose, finite, not_negative
from ...choices import Loop
from ...errors import InvalidArgumentError
from ..scene.clock import Clock
from ..scene.nodes import Node
from ..scene.scene import Scene
from .animated_parts import AnimatedParts
from .clips import AnimationClip
from .layers import Layer, mixed
from .properties import PropertyChannel

LOOPS = get_args(Loop)


class AnimationPlayer(Clock):
    """Plays clips of a scene.

    Parameters
    ----------
    scene : Scene
    clips : iterable of AnimationClip, optional
        By default ``scene.animations``. Nothing plays until `play` is called.

    Attributes
    ----------
    time : float
        Seconds since the clip's start, set by `advance` and `seek`.
    speed : float
        Playback speed; negative plays backwards.
    loop : {"repeat", "once", "ping-pong"}
        What happens at the end: start again, stop, or play backwards.
    paused : bool
        Whether `advance` does nothing.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(self, scene: Scene, clips: Iterable[AnimationClip] | None = None) -> None:
        super().__init__(scene)
        self._clips = _check_clips(scene.animations.values() if clips is None else clips, scene)
        self.speed = 1.0
        self.loop = "repeat"
        self._layers: list[Layer] = []  # the last one plays, the earlier ones fade out
        self._parts = AnimatedParts(scene, self._clips)

    @property
    def clips(self) -> tuple[AnimationClip, ...]:
        return self._clips

    @property
    def playing(self) -> tuple[AnimationClip, ...]:
        """The playing clips, without those that are fading out."""
        return self._layers[-1].clips if self._layers else ()

    @property
    def duration(self) -> float:
        """Duration in seconds of the longest playing clip; 0 if none plays."""
        return max((clip.duration for clip in self.playing), default=0.0)

    @property
    def speed(self) -> float:
        return self._speed

    @speed.setter
    def speed(self, value: float) -> None:
        self._speed = finite(value, "speed")

    @property
    def loop(self) -> Loop:
        return self._loop

    @loop.setter
    def loop(self, value: Loop) -> None:
        self._loop = choose(value, LOOPS, "loop")

    @checks_types
    def play(
        self,
        clip: str | int | AnimationClip | Iterable[AnimationClip] | None = None,
        *,
        fade: float = 0.0,
        offsets: float | Iterable[float] = 0.0,
    ) -> None:
        """Play a clip from its start, or continue after `pause`.

        Parameters
        ----------
        clip : str, int, AnimationClip or several of these, optional
            A name, an index or the clip itself. Several play at once; where they animate the same
            part, the last one wins. By default, the previous clip continues, or the first one
            starts.
        fade : float
            Seconds of the cross-fade from the previous clip.
        offsets : float or iterable of float
            Seconds by which a clip, or each of several, is ahead of `time`.

        Raises
        ------
        InvalidArgumentError
            There is no such clip.
        """
        self.paused = False
        if clip is None and self._layers:
            return
        fade = not_negative(fade, "fade")
        clips = self._find(0 if clip is None else clip)
        layer = Layer(clips, _check_offsets(offsets, len(clips)), self._parts, fade)
        if fade == 0.0:
            self.stop()
        shares = [before.share(self.time) for before in self._layers]
        first = max((k for k, share in enumerate(shares) if share >= 1.0), default=0)
        self._put_back(self._layers[:first])
        self._layers = self._layers[first:]
        for before in self._layers:
            before.since += self.time
        self._layers.append(layer)
        self.time = 0.0
        self._move()

    def pause(self) -> None:
        """Stop everything where it is, until `play`."""
        self.paused = True

    def stop(self) -> None:
        """Stop playing, and restore the nodes' original values."""
        self._put_back(self._layers)
        self._layers = []

    def _find(
        self, clip: str | int | AnimationClip | Iterable[AnimationClip]
    ) -> tuple[AnimationClip, ...]:
        if isinstance(clip, Iterable) and not isinstance(clip, str):
            found = tuple(self._find_one(one) for one in clip)
            if not found:
                raise InvalidArgumentError("play() needs a clip")
            return found
        return (self._find_one(clip),)

    def _find_one(self, clip: str | int | AnimationClip) -> AnimationClip:
        if isinstance(clip, AnimationClip) and clip in self._clips:
            return clip
        if isinstance(clip, str):
            named = [self._scene.animations.get(clip)]
            named += [each for each in self._clips if each.name == clip]
            found = [each for each in named if each is not None and each in self._clips]
            if found:
                return found[0]
        elif isinstance(clip, int) and 0 <= clip < len(self._clips):
            return self._clips[clip]
        names = ", ".join(repr(each.name) for each in self._clips)
        raise InvalidArgumentError(f"there is no clip {shown(clip)}; there are {names or 'none'}")

    def _move(self) -> None:
        if self._layers:
            values = mixed(self._layers, self.time, self._loop)
            self._parts.write(self._scene, values, self._masks(self._layers))

    def _put_back(self, layers: list[Layer]) -> None:
        self._parts.write(self._scene, self._parts.rest, self._masks(layers))

    def _masks(self, layers: list[Layer]) -> dict[str, np.ndarray]:
        """Return the rows that layers animate, as masks."""
        masks = self._parts.none()
        for layer in layers:
            for path, moved in layer.masks.items():
                masks[path] |= moved
        return masks


def _check_clips(value: Iterable[AnimationClip], scene: Scene) -> tuple[AnimationClip, ...]:
    if not isinstance(value, Iterable):
        raise InvalidArgumentError(f"clips must be several AnimationClip, not {value!r}")
    clips = tuple(value)
    for clip in clips:
        if not isinstance(clip, AnimationClip):
            kind = type(clip).__name__
            raise InvalidArgumentError(f"clips must be several AnimationClip, not {kind}")
        moved = (c.target if isinstance(c, PropertyChannel) else c.node for c in clip.channels)
        scene.select({node: None for node in moved if isinstance(node, Node)})
    return clips


def _check_offsets(value: float | Iterable[float], count: int) -> np.ndarray:
    given = value if isinstance(value, Iterable) and not isinstance(value, str) else [value] * count
    offsets = np.array([real(each) for each in given])
    if len(offsets) != count or not np.isfinite(offsets).all():
        raise InvalidArgumentError(f"offsets must be {count} finite numbers, not {value!r}")
    return offsets

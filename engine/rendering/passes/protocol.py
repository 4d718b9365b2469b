"""The interface of passes; a pass is one step of a picture, such as shadow maps or bloom.

In: a picture, drawn by the earlier passes. Out: the arrays that the pass writes. all_passes.py
lists the passes in order, and allocates the arrays that each declares.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import NativeRenderer, NativeStats
from ...choices import FrameCull
from ...model.environments.environment import Environment
from ...model.scene.staged_scene import AnyScene
from .._frame_memory import FrameMemory
from .._frame_options import FrameOptions
from .._output_pool import Shapes
from .._told import Told
from .._view import View
from ..draw_list.draw_list import DrawList
from ..options import RenderOptions


class Shot(NamedTuple):
    """What a picture is drawn of, and how large."""

    view: View
    size: tuple[int, int]
    rows: int  # pixels of the height that sizes of lines and points are relative to
    headlight: Sequence[float]  # the direction to a light, for scenes without one
    frozen: NDArray[np.float64] | None = None  # the frustum to cull by, if another
    beyond: Environment | None = None  # takes the place of a plain background
    # Of a part of a picture: the whole's size, and how many pixels are side by side in one of it.
    whole: tuple[int, int, float] | None = None


class ShownMirror(NamedTuple):
    """A mirror and its picture, as the core takes them.

    Attributes
    ----------
    plane : tuple of 4 float
    slack : float
    left, top : int
        Where its picture lies in the frame's samples.
    scale : int
        Pixels of its picture that are side by side in a sample.
    radiance : (rows, columns, 3) float32
    """

    plane: tuple[float, ...]
    slack: float
    left: int
    top: int
    scale: int
    radiance: NDArray[np.float32]

    def in_pixels(self, axis: int) -> ShownMirror:
        """Return it for a frame of pixels instead of the samples along each axis of theirs."""
        left, top = self.left // axis, self.top // axis
        return self._replace(left=left, top=top, scale=self.scale * axis)


class MirrorPainter(Protocol):
    """Draws what a mirror reflects, with passes of its own."""

    @property
    def memory(self) -> FrameMemory: ...

    def radiance(
        self, scene: AnyScene, options: RenderOptions, shot: Shot
    ) -> NDArray[np.float32]: ...


class Tools(NamedTuple):
    """The tools that the passes of one renderer share; 0 threads are all."""

    native: NativeRenderer
    draw_list: DrawList
    memory: FrameMemory
    backend: int
    threads: int
    is_srgb: bool
    samples: tuple[int, int]  # per pixel: along an axis, and multisamples of each
    told: Told
    another: Callable[[], MirrorPainter]  # with one sample per pixel


@dataclass(slots=True)
class Picture:
    """A picture in progress; the draw list is up to date with its scene."""

    scene: AnyScene
    options: RenderOptions
    frame_options: FrameOptions
    shot: Shot
    shadow_cull: FrameCull  # which faces cast no shadow
    targets: dict[str, np.ndarray] = field(init=False)  # the frame's and other outputs
    arrays: dict[str, np.ndarray] = field(init=False)  # other arrays that passes declare
    # metric depths shown white and black in mode "depth"
    depth_range: tuple[float, float] = (0.0, 1.0)
    shadow_maps: tuple[int, int] = (0, 0)  # how many there are, and how many were drawn
    mirrors: list[ShownMirror] = field(default_factory=list)  # in the picture's samples
    drawn: NativeStats = field(init=False)

    @property
    def view(self) -> View:
        return self.shot.view

    @property
    def size(self) -> tuple[int, int]:
        return self.shot.size


class Pass:
    """One step of the pictures of one renderer.

    Attributes
    ----------
    reads : tuple of str
        Its inputs: names of outputs, which are drawn even if the frame lacks them; names with the
        prefix ``surface_``, for arrays at pixel centres drawn before the colours; results of
        earlier passes; and ``scene``, which nobody may change meanwhile.
    writes : tuple of str
    name, advice : str
        Its name in errors, and advice for using less memory.
    """

    reads: tuple[str, ...] = ()
    writes: tuple[str, ...] = ()
    name = advice = ""

    def __init__(self, tools: Tools) -> None:
        self.tools = tools

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        """Return whether a picture needs the pass: by default, if something it writes is wanted.

        Parameters
        ----------
        options : RenderOptions
        wanted : set of str
            The frame's outputs, and the inputs of the picture's later passes.
        """
        return not wanted.isdisjoint(self.writes)

    def arrays(self, width: int, height: int) -> Shapes:
        """Return the arrays that it needs, besides its inputs."""
        return {}

    def forget(self) -> None:
        """Free unused arrays of its own."""

    def draw(self, picture: Picture) -> None:
        """Draw the pass's results."""
        raise NotImplementedError

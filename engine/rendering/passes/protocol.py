"""The protocol of passes; a pass is one step of a picture, such as shadow maps, colours or glow.

In: a picture as far as earlier passes have it. Out: what the pass writes. all_passes.py lists them
in their order, and gives each the arrays that it declares.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import NativeRenderer, NativeStats
from ...choices import FrameCull
from ...model.scene.staged_scene import AnyScene
from .._frame_memory import FrameMemory
from .._frame_options import FrameOptions
from .._output_pool import Shapes
from .._view import View
from ..draw_list.draw_list import DrawList
from ..options import RenderOptions


class Tools(NamedTuple):
    """The tools that the passes of one renderer share; 0 threads are all."""

    native: NativeRenderer
    draw_list: DrawList
    memory: FrameMemory
    backend: int
    threads: int
    is_srgb: bool
    samples: tuple[int, int]  # of a pixel: along an axis, and multisampled in each


@dataclass(slots=True)
class Picture:
    """A picture that is being drawn; the draw list is up to date with its scene."""

    scene: AnyScene
    options: RenderOptions
    frame_options: FrameOptions
    view: View
    size: tuple[int, int]
    frozen_clip_from_world: NDArray[np.float64] | None  # the frustum that holds what is drawn
    shadow_cull: FrameCull  # which faces cast no shadow
    targets: dict[str, np.ndarray] = field(init=False)  # outputs: the frame's, and others
    arrays: dict[str, np.ndarray] = field(init=False)  # all else that passes declare
    depth_range: tuple[float, float] = (0.0, 1.0)  # white and black in mode "depth"
    shadow_maps: tuple[int, int] = (0, 0)  # how many there are, and how many were drawn
    drawn: NativeStats = field(init=False)


class Pass:
    """One step of the pictures of one renderer.

    Attributes
    ----------
    reads : tuple of str
        What it takes: names of outputs, which are drawn for it if nobody asked for them; such names
        after ``surface_``, of arrays at the middle of each pixel, which are there before the
        colours; what earlier passes write; and ``scene``, which others must leave alone meanwhile.
    writes : tuple of str
    name, advice : str
        What an error calls it, and what takes less memory.
    """

    reads: tuple[str, ...] = ()
    writes: tuple[str, ...] = ()
    name = advice = ""

    def __init__(self, tools: Tools) -> None:
        self.tools = tools

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        """Whether a picture has the pass: by default, if what it writes is wanted.

        Parameters
        ----------
        options : RenderOptions
        wanted : set of str
            The frame's outputs, and what later passes of the picture read.
        """
        return not wanted.isdisjoint(self.writes)

    def arrays(self, width: int, height: int) -> Shapes:
        """Return the arrays that it needs, besides those that it reads."""
        return {}

    def draw(self, picture: Picture) -> None:
        """Write what the pass writes."""
        raise NotImplementedError

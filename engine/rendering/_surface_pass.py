"""What shows, drawn before the picture: depths, positions, normals and IDs that other passes read.

In: the draw list, options and view of a picture. Out: arrays of the outputs asked for, at the
middle of each pixel. The renderer's own core draws them, with its backend and threads, so that the
scalar reference stays apart from the kernels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._native.rasterizer import NativeRenderer
from ._draw_list import DrawList
from ._frame_options import FrameOptions
from ._output_pool import OutputPool, shapes_of
from ._view import View

_ONE_SAMPLE = 1, 0


class SurfacePass:
    """Draws outputs of the surfaces that a picture keeps: the nearest that aren't blended (R16)."""

    def __init__(self) -> None:
        self._pool = OutputPool()

    def draw(
        self,
        native: NativeRenderer,
        draw_list: DrawList,
        options: FrameOptions,
        view: View,
        size: tuple[int, int],
        outputs: tuple[str, ...],
        *,
        frozen_clip_from_world: NDArray[np.float64] | None = None,
    ) -> dict[str, np.ndarray]:
        """Draw outputs into arrays of the pass, which may be used again once nobody holds them.

        Parameters
        ----------
        native : NativeRenderer
        draw_list : DrawList
            Up to date, with the normals that the outputs need: pictures in mode "lit" have them.
        options : FrameOptions
            Of the picture: its faces, marks, normals and culling count.
        view : View
        size : (int, int)
            Width and height of the picture in pixels.
        outputs : tuple of str
            Names of outputs, without ``"color"``.
        frozen_clip_from_world : (4, 4) float64, optional
            Of the camera whose frustum holds what is drawn.

        Returns
        -------
        arrays : dict of str to array
            By the name of the output: (height, width) or (height, width, channels).
        """
        arrays = self._pool.take(shapes_of(outputs, *size))
        native.render(
            draw_list.native,
            arrays,
            options.surfaces,
            *size,
            *_ONE_SAMPLE,
            view.clip_from_world,
            view.view_from_world,
            view.eye,
            id(view.camera),
            0.0,
            1.0,
            frozen_clip_from_world,
        )
        return arrays

    def forget(self) -> None:
        """Free what is not in use."""
        self._pool.forget()

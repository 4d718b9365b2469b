"""What ``plotter.engine3d`` is.

In: a plotter of PyVista, filled. Out: frames, files, arrays, windows. PyVista finds this by the
entry point of its group ``pyvista.plotter_components`` and makes one for each plotter.
"""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from typing import Any

import numpy as np
import pyvista
from numpy.typing import NDArray

from ...apps.viewer.show import show
from ...base.numbers import shown
from ...base.validation import flag, whole_number
from ...errors import InvalidArgumentError
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ._plotter_scenes import scene_of
from ._saving import save_pixels
from ._window_pictures import Picture, is_smooth, picture_of

_LARGEST_SCALE = 64


@pyvista.register_plotter_component("engine3d")
class PlotterComponent:
    """Draws a plotter on the processor, without OpenGL.

    Parameters
    ----------
    plotter : pyvista.Plotter
    """

    def __init__(self, plotter: Any) -> None:
        self._plotter = plotter

    def render(
        self,
        *,
        transparent_background: bool | None = None,
        window_size: Sequence[int] | None = None,
        scale: int | None = None,
    ) -> Frame:
        """Draw the plotter.

        Parameters
        ----------
        transparent_background, window_size, scale
            As those of `pyvista.Plotter.screenshot`.

        Returns
        -------
        frame : Frame
            With ``color``, and with ``depth``: the distance along the view axis of the subplot that
            a pixel belongs to.

        Raises
        ------
        InvalidArgumentError
            The plotter is closed, an argument is wrong, or nothing of the plotter can be drawn.

        Examples
        --------
        >>> plotter.engine3d.render().save("a.png")
        """
        found = self._picture(window_size, scale, wants_depth=True)
        height, width = found.rgba.shape[:2]
        rgba = found.rgba
        if not self._is_transparent(transparent_background):
            rgba[..., 3] = 255
        return Frame((width, height), {"color": rgba, "depth": found.depth})

    def screenshot(
        self,
        filename: str | os.PathLike[str] | io.BytesIO | None = None,
        transparent_background: bool | None = None,
        return_img: bool = True,
        window_size: Sequence[int] | None = None,
        scale: int | None = None,
    ) -> NDArray[np.uint8] | None:
        """Draw the plotter as `pyvista.Plotter.screenshot` does, with the same parameters.

        Parameters
        ----------
        filename : str, path-like or io.BytesIO, optional
            Where to save the picture; without a suffix, as PNG.
        transparent_background : bool, optional
            By default as the plotter's theme says.
        return_img : bool
        window_size : (int, int), optional
            Width and height in pixels, instead of the plotter's.
        scale : int, optional
            Makes the picture that many times as wide and high, and texts as large.

        Returns
        -------
        pixels : (H, W, 3) or (H, W, 4) uint8, or None
            Top row first; with alpha if the background is transparent.

        Raises
        ------
        InvalidArgumentError, FileAccessError
        """
        found = self._picture(window_size, scale)
        is_transparent = self._is_transparent(transparent_background)
        pixels = found.rgba if is_transparent else found.rgba[..., :3].copy()
        if filename is not None and filename is not False:
            save_pixels(pixels, filename)
        return pixels if return_img else None

    def scene(self) -> Scene:
        """Return the first subplot as a scene of engine3d, which keeps PyVista's coordinates.

        Its camera stands where the plotter's does; lines and points have a width of their own only
        in pictures of the whole scene. Texts, bars and bounds are left out.
        """
        self._prepare()
        return scene_of(self._plotter.renderer)

    def show(self, **options: Any) -> None:
        """Show the scene in a window; parameters and errors as those of `engine3d.show`."""
        show(self.scene(), **options)

    def _prepare(self) -> None:
        if self._plotter.render_window is None:
            raise InvalidArgumentError(
                "this plotter is closed: draw it before its show() or close()"
            )
        plotter = self._plotter
        if not plotter._first_time:
            return
        # PyVista itself has drawn nothing yet, and must find its plotter so.
        cameras = [renderer.camera for renderer in plotter.renderers]
        were_set = [camera.is_set for camera in cameras]
        plotter._on_first_render_request()
        plotter._first_time = True
        for camera, was_set in zip(cameras, were_set, strict=True):
            camera.is_set = was_set

    def _picture(
        self,
        window_size: Sequence[int] | None,
        scale: int | None,
        wants_depth: bool = False,
    ) -> Picture:
        plotter = self._plotter
        times = plotter.image_scale if scale is None else scale
        times = whole_number(times, "scale", 1, _LARGEST_SCALE)
        if window_size is not None:
            window_size = _checked_size(window_size)
        self._prepare()
        with plotter.window_size_context(window_size):
            return picture_of(
                plotter.render_window,
                times,
                is_smooth=is_smooth(plotter.render_window),
                wants_depth=wants_depth,
            )

    def _is_transparent(self, given: bool | None) -> bool:
        if given is None:
            return bool(self._plotter.theme.transparent_background)
        return flag(given, "transparent_background")


def _checked_size(given: Any) -> list[int]:
    try:
        sides = [int(side) for side in given]
    except (TypeError, ValueError):
        sides = []
    if len(sides) != 2 or min(sides) < 1:
        raise InvalidArgumentError(
            f"window_size must be a width and a height in pixels, not {shown(given)}"
        )
    return sides

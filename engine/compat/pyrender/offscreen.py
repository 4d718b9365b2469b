"""Offscreen rendering into arrays."""

from __future__ import annotations

import threading

from ._held import held
from .constants import RenderFlags
from .renderer import Renderer


class OffscreenRenderer:
    """Renders scenes into arrays.

    Any number of them may live side by side, in any thread and process.

    Parameters
    ----------
    viewport_width, viewport_height : int
        Pixels; may be assigned later.
    point_size : float
        Of points, in pixels.
    """

    def __init__(self, viewport_width, viewport_height, point_size=1.0):
        self.viewport_width = viewport_width
        self.viewport_height = viewport_height
        self.point_size = point_size
        self._lock = threading.Lock()
        self._renderer: Renderer | None = Renderer(self.viewport_width, self.viewport_height)

    viewport_width = held("viewport_width", int, "Width of pictures, in pixels.")
    viewport_height = held("viewport_height", int, "Height of pictures, in pixels.")
    point_size = held("point_size", float, "Of points, in pixels.")

    def render(self, scene, flags=RenderFlags.NONE, seg_node_map=None):
        """Draw a scene from its main camera.

        Parameters
        ----------
        scene : Scene
        flags : int
            Of `RenderFlags`.
        seg_node_map : dict of Node to int or (3,) int, optional
            With ``SEG``: the colour of each node that is drawn, 0 to 255.

        Returns
        -------
        color : (H, W, 3) or, with ``RGBA``, (H, W, 4) uint8
            Not with ``DEPTH_ONLY``, of which the depth alone is returned.
        depth : (H, W) float32
            Along the view axis, at the centres of the pixels (see `settings.depth_place`); 0 where
            nothing is.

        Colours are read-only, and depths are not, as pyrender's are.

        Raises
        ------
        ValueError
            The scene has no camera.
        NotImplementedError
            Shadows of point lights were asked for.
        """
        with self._lock:
            if self._renderer is None:
                raise RuntimeError("the renderer was deleted")
            self._renderer.viewport_width = self.viewport_width
            self._renderer.viewport_height = self.viewport_height
            self._renderer.point_size = self.point_size
            return self._renderer.render(scene, flags | RenderFlags.OFFSCREEN, seg_node_map)

    def delete(self) -> None:
        """Free the cached drawing data; arrays and other renderers stay valid."""
        self._renderer = None


__all__ = ["OffscreenRenderer"]

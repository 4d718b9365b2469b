"""The renderer: draws scenes into a viewport."""

from __future__ import annotations

import numpy as np

from ._drawing import Drawing
from ._held import held
from .constants import RenderFlags
from .shader_program import ADVICE


class GLError(Exception):
    """An OpenGL error, which is never raised here; it exists for programs that catch it."""


class Renderer:
    """Draws scenes.

    Parameters
    ----------
    viewport_width, viewport_height : int
        Pixels.
    point_size : float
        Of points, in pixels.
    """

    def __init__(self, viewport_width, viewport_height, point_size=1.0):
        self.dpscale = 1
        self.viewport_width = viewport_width
        self.viewport_height = viewport_height
        self.point_size = point_size
        self._drawing: Drawing | None = None

    point_size = held("point_size", float, "Of points, in pixels.")

    def render(self, scene, flags, seg_node_map=None):
        """Draw a scene; see `OffscreenRenderer.render`."""
        if self._drawing is None:
            self._drawing = Drawing()
        size = int(self.viewport_width), int(self.viewport_height)
        color, depth = self._drawing.draw(scene, flags, seg_node_map, *size, self.point_size)
        if flags & RenderFlags.DEPTH_ONLY:
            return depth
        color.flags.writeable = False
        return color, depth

    @property
    def _program_cache(self) -> None:
        """The place of pyrender's shader cache; programs may assign their own."""
        return None

    @_program_cache.setter
    def _program_cache(self, value) -> None:
        raise NotImplementedError(ADVICE)

    def read_color_buf(self) -> np.ndarray:
        """Raise: there is no screen to read from."""
        raise NotImplementedError("there is no screen to read from: take what render() returns")

    read_depth_buf = read_color_buf

    def render_text(self, *args, **kwargs) -> None:
        """Raise: captions are not drawn."""
        raise NotImplementedError("captions are not drawn: use engine3d.Canvas on the picture")

    def delete(self) -> None:
        """Free the cached drawing data."""
        self._drawing = None


__all__ = ["Renderer"]

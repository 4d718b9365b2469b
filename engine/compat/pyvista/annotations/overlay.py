"""What lies on the picture of a view: pixels, and coordinates of VTK's 2-D actors.

In: a renderer, its view, and the samples of its rectangle. Out: changed samples. Places are pixels
from the view's left bottom, y up, as in VTK.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....rendering.canvas import Canvas
from .._renderer_view import View
from .._samples import Samples


class Overlay:
    """The rectangle of a view, to draw on.

    Attributes
    ----------
    renderer : vtkRenderer
    view : View
    width, height : int
    scale : float
        Pixels of the picture to a pixel of the window: that much larger are texts.
    """

    def __init__(self, renderer: Any, view: View, samples: Samples, scale: float = 1.0) -> None:
        self.renderer, self.view, self.scale = renderer, view, scale
        self.width, self.height = view.width, view.height
        self._samples = samples

    def point(self, coordinate: Any) -> tuple[float, float]:
        """Return where a ``vtkCoordinate`` is."""
        x, y = coordinate.GetComputedDoubleViewportValue(self.renderer)
        return float(x) * self.scale, float(y) * self.scale

    def blend(self, rgba: NDArray[np.uint8], left: float, bottom: float) -> None:
        """Lay pixels over the picture; ``left`` and ``bottom`` are rounded to whole pixels."""
        height, width = rgba.shape[:2]
        x = int(np.floor(left + 0.5))
        y = self.height - int(np.floor(bottom + 0.5)) - height
        if x >= self.width or y >= self.height or x + width <= 0 or y + height <= 0:
            return
        cut = rgba[max(-y, 0) : self.height - y, max(-x, 0) : self.width - x]
        cover = cut[..., 3:] / np.float32(255.0)
        color = cut[..., :3] / np.float32(255.0) * cover
        self._samples.part(x, y, width, height).blend(color, cover)

    def rectangle(
        self,
        left: float,
        bottom: float,
        width: float,
        height: float,
        color: NDArray[np.float64],
        opacity: float = 1.0,
    ) -> None:
        """Fill a rectangle."""
        x0, x1 = (int(np.floor(edge + 0.5)) for edge in (left, left + width))
        y0, y1 = (int(np.floor(edge + 0.5)) for edge in (bottom, bottom + height))
        if x1 <= x0 or y1 <= y0:
            return
        rgba = np.empty((y1 - y0, x1 - x0, 4), np.uint8)
        rgba[:] = codes(color, opacity)
        self.blend(rgba, x0, y0)

    def lines(
        self,
        ends: NDArray[np.float64],
        color: NDArray[np.float64],
        width: float = 1.0,
        opacity: float = 1.0,
    ) -> None:
        """Draw segments, (N, 4): x, y of both ends."""
        canvas = Canvas((self.width, self.height))
        canvas.clear((0, 0, 0, 0))
        flipped = np.array(ends, np.float64)
        flipped[:, 1::2] = self.height - flipped[:, 1::2]
        canvas.lines(flipped, tuple(int(v) for v in codes(color, 1.0)), width=max(width, 1.0))
        self._over(canvas, opacity)

    def triangles(
        self, corners: NDArray[np.float64], color: NDArray[np.float64], opacity: float = 1.0
    ) -> None:
        """Fill triangles, (N, 3, 2)."""
        canvas = Canvas((self.width, self.height))
        canvas.clear((0, 0, 0, 0))
        flipped = np.array(corners, np.float64)
        flipped[..., 1] = self.height - flipped[..., 1]
        canvas.triangles(flipped.reshape(-1, 6), tuple(int(v) for v in codes(color, 1.0)))
        self._over(canvas, opacity)

    def _over(self, canvas: Canvas, opacity: float) -> None:
        cover = canvas.pixels[..., 3:] / np.float32(255.0) * np.float32(opacity)
        self._samples.blend(canvas.pixels[..., :3] / np.float32(255.0) * cover, cover)


def codes(color: NDArray[np.float64], opacity: float) -> NDArray[np.uint8]:
    """Return a colour, 0 to 1, as RGBA codes."""
    return np.clip(255.0 * np.array([*color, opacity]) + 0.5, 0, 255).astype(np.uint8)

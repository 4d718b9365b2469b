"""The samples of a picture, and what becomes of them.

In: what renderers draw, each into its rectangle of all samples. Out: pixels. As in VTK, a pixel is
the mean of its samples' light, for screens whose light is the 2.2th power of a code
(vtkOpenGLRenderWindow.cxx): edges of dark things on white look thinner than in a plain mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_GAMMA = 2.2
_LIGHT = np.array([(code / 255.0) ** _GAMMA for code in range(256)])
_LIMITS = np.array([((code + 0.5) / 255.0) ** _GAMMA for code in range(255)])

#: Where the samples of a pixel are, y down: OpenGL's drivers have Direct3D's pattern, upside down.
PATTERNS = {
    1: ((0.5, 0.5),),
    4: ((0.375, 0.875), (0.875, 0.625), (0.125, 0.375), (0.625, 0.125)),
}


class Samples:
    """Samples of a picture.

    Parameters
    ----------
    size : (int, int)
    count : {1, 4}
        Of a pixel.

    Attributes
    ----------
    rgba : (count, H, W, 4) uint8
        Straight alpha; what nothing covers keeps the colour of the background, with alpha 0.
    """

    def __init__(self, size: tuple[int, int], count: int) -> None:
        self.rgba = np.zeros((count, size[1], size[0], 4), np.uint8)

    @property
    def pattern(self) -> tuple[tuple[float, float], ...]:
        """Where the samples of a pixel are."""
        return PATTERNS[len(self.rgba)]

    def part(self, left: int, top: int, width: int, height: int) -> Samples:
        """Return a rectangle, which shares its samples."""
        found = object.__new__(Samples)
        found.rgba = self.rgba[:, max(top, 0) : top + height, max(left, 0) : left + width]
        return found

    def fill(self, colors: NDArray[np.float64], alpha: float) -> None:
        """Overwrite all; ``colors`` is (3,) or (H, 1, 3), 0 to 1."""
        self.rgba[..., :3] = np.clip(255.0 * colors + 0.5, 0.0, 255.0).astype(np.uint8)
        self.rgba[..., 3] = int(255.0 * alpha + 0.5)

    def put(self, sample: int, rgba: NDArray[np.uint8]) -> None:
        """Overwrite one sample of each pixel where ``rgba`` (H, W, 4) has an alpha."""
        np.copyto(self.rgba[sample], rgba, where=rgba[..., 3:] > 0)

    def blend(self, color: NDArray[np.float32], cover: NDArray[np.float32]) -> None:
        """Lay colours over all samples.

        Parameters
        ----------
        color : (H, W, 3) float
            Times ``cover``, 0 to 1.
        cover : (H, W, 1) float
        """
        rows, columns = np.nonzero(cover[..., 0] > 0.0)
        over = np.concatenate([color[rows, columns], cover[rows, columns]], -1) * 255.0 + 0.5
        for one in self.rgba:
            under = one[rows, columns] * (1.0 - cover[rows, columns])
            one[rows, columns] = np.clip(over + under, 0.0, 255.0).astype(np.uint8)

    def pixels(self) -> NDArray[np.uint8]:
        """Return the pixels, (H, W, 4) uint8."""
        first = self.rgba[0]
        out = first.copy()
        if len(self.rgba) == 1:
            return out
        mixed = (self.rgba[1:] != first).any((0, 3))
        rows, columns = np.nonzero(mixed)
        samples = self.rgba[:, rows, columns]
        light = _LIGHT[samples[..., :3]].mean(0)
        out[rows, columns, :3] = np.searchsorted(_LIMITS, light)
        alpha = samples[..., 3].astype(np.uint16).sum(0)
        out[rows, columns, 3] = (alpha + len(samples) // 2) // len(samples)
        return out

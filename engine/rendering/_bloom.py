"""Bloom: what is brighter than a screen can show glows (docs/exactness, R124).

In: the options of a frame, and what was drawn. Out: the frame's colour, changed. The light that
glows is the radiance of the same frame; where nobody asked for that, it has an array here, which
is used again for the next frame of the size.
"""

from __future__ import annotations

import numpy as np

from .._native import rasterizer as _native
from .options import RenderOptions


class Bloom:
    """The glow of one renderer's pictures.

    Parameters
    ----------
    backend, threads : int
        That draw it; threads 0: all.
    srgb : bool
        Whether pictures are encoded as sRGB.
    """

    def __init__(self, backend: int, threads: int, srgb: bool) -> None:
        self._backend, self._threads, self._srgb = backend, threads, srgb
        self._radiance = np.empty((0, 0, 3), np.float32)
        self._scratch = np.empty(0, np.float32)

    def targets(self, outputs: dict, options: RenderOptions) -> dict:
        """Return the arrays to draw into: a frame's, and one of radiance if it glows."""
        if not glows(options) or "color" not in outputs or "radiance" in outputs:
            return outputs
        shape = (*outputs["color"].shape[:2], 3)
        if self._radiance.shape != shape:
            self._radiance = np.empty(shape, np.float32)
        return {**outputs, "radiance": self._radiance}

    def add(self, targets: dict, options: RenderOptions) -> None:
        """Lay the glow of what was drawn over its colour."""
        if not glows(options) or "color" not in targets:
            return
        height, width = targets["color"].shape[:2]
        needed = _native.bloom_scratch(width, height, self._threads)
        if len(self._scratch) < needed:
            self._scratch = np.empty(needed, np.float32)
        _native.add_bloom(
            targets["radiance"],
            targets["color"],
            options.bloom,
            self._srgb,
            self._backend,
            self._threads,
            self._scratch,
        )

    def forget(self) -> None:
        """Free the arrays."""
        self._radiance = np.empty((0, 0, 3), np.float32)
        self._scratch = np.empty(0, np.float32)


def glows(options: RenderOptions) -> bool:
    """Whether pictures of these options have bloom."""
    return options.bloom > 0 and options.mode in ("lit", "unlit")

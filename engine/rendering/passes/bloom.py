"""Bloom: a glow around light too bright for the screen (docs/exactness, R124).

In: the radiance of a frame. Out: the frame's colour, changed.
"""

from __future__ import annotations

import numpy as np

from ..._native import rasterizer as _native
from .._output_pool import Shapes
from ..options import RenderOptions
from .protocol import Pass, Picture


class Bloom(Pass):
    """Adds the glow of bright surfaces to the colour."""

    reads = ("radiance", "color")
    writes = ("color",)
    name, advice = "bloom", "bloom=0"

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        return options.bloom > 0 and options.mode in ("lit", "unlit") and "color" in wanted

    def arrays(self, width: int, height: int) -> Shapes:
        count = _native.bloom_scratch(width, height, self.tools.threads)
        return {"bloom": ((count,), np.dtype(np.float32))}

    def draw(self, picture: Picture) -> None:
        _native.add_bloom(
            picture.targets["radiance"],
            picture.targets["color"],
            picture.options.bloom,
            self.tools.is_srgb,
            self.tools.backend,
            self.tools.threads,
            picture.arrays["bloom"],
        )

"""Refraction: the picture that thick and rough glass shows bent and blurred.

In: the scene without what is blended, with edges as smooth as the picture's. Out: that picture with
its blurred levels, and its depths, which the core reads behind glass (docs/exactness, section 25).
It is drawn only if something in the picture refracts.
"""

from __future__ import annotations

import math

import numpy as np

from ..._native import rasterizer as _native
from .._frame_memory import Use
from .._output_pool import OutputPool, Shapes, shapes_of
from ..options import RenderOptions, lights_faces
from .output_passes import ONE_SAMPLE, draw_outputs
from .protocol import Pass, Picture, Tools

_OUTPUTS = "color", "radiance", "depth"


class Refraction(Pass):
    """Draws what is behind glass.

    Its arrays are allocated by the pictures that need them, since most scenes have no such glass.
    """

    reads = ("shadow_maps", "exact_shadows", "ambient_visibility")
    writes = ("behind",)
    name, advice = "refraction", "refraction=False"

    def __init__(self, tools: Tools) -> None:
        super().__init__(tools)
        self._pool = OutputPool()
        axis, multiple = tools.samples  # as many samples, of which each surface is shaded once
        self._samples = 1, multiple or (axis * axis if axis > 1 else 0)

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        bends = options.refraction and options.wireframe != "only"
        return bends and options.hidden_surfaces == "zbuffer" and lights_faces(options, wanted)

    def draw(self, picture: Picture) -> None:
        if not self.tools.draw_list.native.refracts():
            return
        arrays = self._take(picture.size)
        levels, options = arrays.pop("behind"), picture.frame_options
        samples = ONE_SAMPLE if options.is_transparent else self._samples
        draw_outputs(self, picture, arrays, options.opaque, samples, has_light=True)
        _native.find_behind(
            arrays["radiance"],
            arrays["color"],
            self.tools.is_srgb,
            options.is_transparent,
            _native.TONE_MAPPINGS[picture.options.tone_mapping],
            self.tools.backend,
            self.tools.threads,
            levels,
        )
        picture.arrays |= {"behind": levels, "behind_depth": arrays["depth"]}

    def _take(self, size: tuple[int, int]) -> dict[str, np.ndarray]:
        levels: Shapes = {"behind": ((_native.behind_floats(*size),), np.dtype(np.float32))}
        shapes = shapes_of(_OUTPUTS, *size) | levels
        used = sum(dtype.itemsize * math.prod(shape) for shape, dtype in shapes.values())
        self.tools.memory.add(Use(used, self.name, self.advice))
        return self._pool.take(shapes)

    def forget(self) -> None:
        self._pool.forget()

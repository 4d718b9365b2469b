"""The passes that draw outputs, each in one call of the core without the GIL.

The same core draws both, with its backend and threads, so that the scalar reference stays separate
from the kernels.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import NativeOptions, NativeStats
from ..frame import OUTPUTS
from .protocol import Pass, Picture

#: Prefix of outputs that hold surfaces only.
SURFACE = "surface_"
_ONE_SAMPLE = 1, 0


class SurfacePass(Pass):
    """Draws, before the picture, outputs that other passes read, at each pixel's centre.

    They show the nearest surfaces that aren't blended (R16).
    """

    writes = tuple(SURFACE + name for name in OUTPUTS if name != "color")

    def draw(self, picture: Picture) -> None:
        targets = {
            name.removeprefix(SURFACE): array
            for name, array in picture.arrays.items()
            if name.startswith(SURFACE)
        }
        _render(self, picture, targets, picture.frame_options.surfaces, _ONE_SAMPLE)


class ColorPass(Pass):
    """Draws the picture: the frame's outputs, and others that later passes read."""

    reads = ("shadow_maps", "exact_shadows", "ambient_visibility", "mirrors")
    writes = tuple(OUTPUTS)

    def draw(self, picture: Picture) -> None:
        options = picture.frame_options
        picture.drawn = _render(
            *(self, picture, picture.targets, options.native, self.tools.samples),
            picture.view.rays if options.has_backdrop else None,
            picture.arrays.get("ambient_visibility"),
            picture.mirrors or None,
        )
        picture.drawn.shadow_maps, picture.drawn.shadow_maps_drawn = picture.shadow_maps


def _render(
    one: Pass,
    picture: Picture,
    targets: dict[str, np.ndarray],
    options: NativeOptions,
    samples: tuple[int, int],
    rays: NDArray[np.float32] | None = None,
    visibility: NDArray[np.float32] | None = None,
    mirrors: list[tuple[Any, ...]] | None = None,
) -> NativeStats:
    view = picture.view
    return one.tools.native.render(
        one.tools.draw_list.native,
        targets,
        options,
        *picture.size,
        *samples,
        view.clip_from_world,
        view.view_from_world,
        view.eye,
        id(view.camera),
        *picture.depth_range,
        picture.shot.frozen,
        rays,
        visibility,
        mirrors,
    )

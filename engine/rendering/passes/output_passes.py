"""The passes that draw outputs, each in one call of the core without the GIL.

The same core draws both, with its backend and threads, so that the scalar reference stays separate
from the kernels.
"""

from __future__ import annotations

import numpy as np

from ..._native.rasterizer import NativeOptions, NativeStats
from ..frame import OUTPUTS
from .protocol import Pass, Picture

#: Prefix of outputs that hold surfaces only.
SURFACE = "surface_"
#: Samples per pixel of what other passes read.
ONE_SAMPLE = 1, 0


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
        draw_outputs(self, picture, targets, picture.frame_options.surfaces, ONE_SAMPLE)


class ColorPass(Pass):
    """Draws the picture: the frame's outputs, and others that later passes read."""

    reads = ("shadow_maps", "exact_shadows", "ambient_visibility", "mirrors", "behind")
    writes = tuple(OUTPUTS)

    def draw(self, picture: Picture) -> None:
        native = picture.frame_options.native
        picture.drawn = draw_outputs(
            self, picture, picture.targets, native, self.tools.samples, has_light=True
        )
        picture.drawn.shadow_maps, picture.drawn.shadow_maps_drawn = picture.shadow_maps


def draw_outputs(
    one: Pass,
    picture: Picture,
    targets: dict[str, np.ndarray],
    options: NativeOptions,
    samples: tuple[int, int],
    *,
    has_light: bool = False,
) -> NativeStats:
    """Draw outputs in one call of the core; ``has_light``: with what earlier passes found."""
    view, axis = picture.view, one.tools.samples[0] // samples[0]
    mirrors = [mirror.in_pixels(axis) for mirror in picture.mirrors] if has_light else []
    read = picture.arrays if has_light else {}
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
        view.rays if has_light and picture.frame_options.has_backdrop else None,
        read.get("ambient_visibility"),
        mirrors or None,
        read.get("behind"),
        read.get("behind_depth"),
        picture.shot.whole,
    )

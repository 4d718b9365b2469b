"""Ambient occlusion: the fraction of ambient light that reaches each pixel.

In: the picture's depths and normals, one sample per pixel, and its view. Out: a factor for each
pixel, by which the core multiplies ambient light (docs/exactness, section 21).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import find_occlusion, occlusion_scratch
from ...base import linalg
from .._output_pool import Shapes
from .._view import View
from ..options import RenderOptions, lights_faces
from .protocol import Pass, Picture

#: The default radius, as a fraction of the diagonal of the scene's box.
RADIUS_SHARE = 0.1


class PixelRays(NamedTuple):
    """The rays of pixels: R125 in docs/exactness."""

    across: tuple[float, float]
    down: tuple[float, float]
    is_perspective: bool


def pixel_rays(view: View, width: int, height: int) -> PixelRays | None:
    """Return the rays of a picture's pixels; None if the projection has no such rays."""
    matrix = view.projection
    is_perspective = view.eye[3] != 0.0
    scale = -matrix[3, 2] if is_perspective else matrix[3, 3]
    if not scale:
        return None
    matrix = matrix / scale
    middle = matrix[:2, 2] if is_perspective else -matrix[:2, 3]
    sizes = matrix[0, 0] * width, -matrix[1, 1] * height
    with np.errstate(all="ignore"):
        across = 2.0 / sizes[0], (1.0 / width - 1.0 + middle[0]) / matrix[0, 0]
        down = 2.0 / sizes[1], (1.0 - 1.0 / height + middle[1]) / matrix[1, 1]
        steps = np.float32(across[0]), np.float32(down[0])
    usable = np.isfinite((*across, *down)).all() and all(steps) and np.isfinite(steps).all()
    return PixelRays(tuple(across), tuple(down), is_perspective) if usable else None


def radius_of(options: RenderOptions, bounds: NDArray[np.float64]) -> float:
    """Return the occlusion radius in world units; ``bounds`` are the scene's."""
    if options.ambient_occlusion_radius is not None:
        return options.ambient_occlusion_radius
    return RADIUS_SHARE * float(linalg.length(bounds[1] - bounds[0]))


def view_scale(view: View) -> float:
    """Return the view-space length of a world unit, for cameras with scaled poses."""
    return float(linalg.length(view.view_from_world[2, :3]))


class AmbientOcclusion(Pass):
    """Computes each pixel's ambient visibility from metric depth and normals, 0 for background."""

    reads = ("surface_depth", "surface_normal", "scene")
    writes = ("ambient_visibility",)
    name, advice = "ambient occlusion", "ambient_occlusion=False"

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        shows_faces = options.ambient_occlusion and options.wireframe != "only"
        return shows_faces and lights_faces(options, wanted)

    def arrays(self, width: int, height: int) -> Shapes:
        floats = np.dtype(np.float32)
        scratch = (occlusion_scratch(width, height),), floats
        return {"ambient_visibility": ((height, width), floats), "occlusion": scratch}

    def draw(self, picture: Picture) -> None:
        visibility = picture.arrays["ambient_visibility"]
        rays = pixel_rays(picture.view, *picture.size)
        radius = radius_of(picture.options, picture.scene.bounds) * view_scale(picture.view)
        if rays is None or not 0.0 < radius < math.inf:
            visibility.fill(1.0)
            return
        find_occlusion(
            picture.arrays["surface_depth"],
            picture.arrays["surface_normal"],
            *rays,
            radius,
            self.tools.backend,
            self.tools.threads,
            picture.arrays["occlusion"],
            visibility,
        )

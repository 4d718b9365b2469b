"""Ambient occlusion: what of the light from all around reaches each pixel of a picture.

In: depths of what the picture shows, at one sample a pixel, and its view. Out: a share of light for
each pixel, which the core multiplies ambient light by (docs/exactness, section 21).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import linalg
from .._native.rasterizer import find_occlusion
from ._output_pool import OutputPool
from ._view import View
from .options import RenderOptions, shows_light

#: How far things count where nothing is said, as a share of the diagonal of the scene's box.
RADIUS_SHARE = 0.1


class PixelRays(NamedTuple):
    """Where pixels look: R125 in docs/exactness."""

    across: tuple[float, float]
    down: tuple[float, float]
    is_perspective: bool


def pixel_rays(view: View, width: int, height: int) -> PixelRays | None:
    """Return where the pixels of a picture look; None for a projection that has no such rays."""
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


def shows_occlusion(options: RenderOptions, outputs: tuple[str, ...]) -> bool:
    """Whether a picture with these outputs shows ambient occlusion."""
    if not options.ambient_occlusion or options.mode != "lit" or not shows_light(outputs):
        return False
    return options.wireframe != "only"


def radius_of(options: RenderOptions, bounds: NDArray[np.float64]) -> float:
    """Return how far away things count, in world units; ``bounds`` are the scene's."""
    if options.ambient_occlusion_radius is not None:
        return options.ambient_occlusion_radius
    return RADIUS_SHARE * float(linalg.length(bounds[1] - bounds[0]))


def view_scale(view: View) -> float:
    """How long a length of the world is in view space, where the camera's pose is scaled."""
    return float(linalg.length(view.view_from_world[2, :3]))


class AmbientOcclusion:
    """Finds the ambient visibility of one renderer's pictures."""

    def __init__(self, backend: int, threads: int) -> None:
        self._backend, self._threads = backend, threads
        self._pool = OutputPool()

    def find(self, depth: NDArray[np.float32], view: View, radius: float) -> NDArray[np.float32]:
        """Return the visibility of each pixel.

        Parameters
        ----------
        depth : (height, width) float32
            Metric, 0 where nothing shows.
        view : View
            Of the picture that has these pixels.
        radius : float
            World units: how far away things are in the way.

        Returns
        -------
        visibility : (height, width) float32
        """
        height, width = depth.shape
        form = (depth.shape, depth.dtype)
        arrays = self._pool.take({"scratch": form, "visibility": form})
        rays = pixel_rays(view, width, height)
        if rays is None or not 0.0 < radius * view_scale(view) < math.inf:
            arrays["visibility"].fill(1.0)
            return arrays["visibility"]
        find_occlusion(
            depth,
            *rays,
            radius * view_scale(view),
            self._backend,
            self._threads,
            arrays["scratch"],
            arrays["visibility"],
        )
        return arrays["visibility"]

    def forget(self) -> None:
        """Free what is not in use."""
        self._pool.forget()

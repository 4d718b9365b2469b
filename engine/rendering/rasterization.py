"""Low-level rasterization: triangles in clip space in, visibility out; no camera and no scene.

For tests, and for programs with their own pipeline. docs/exactness, sections 2 to 6, defines the
resulting pixels, depths and barycentrics exactly.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._native import rasterizer as _native
from ..base.calls import hinted, shows_annotations
from ..base.image_size import check_size
from ..base.numbers import as_array, floats
from ..base.thread_count import resolve_threads
from ..base.validation import choose
from ..choices import Backend, Cull
from ..errors import InvalidArgumentError
from .backend_selection import resolve_backend


@shows_annotations
class RasterizeResult(NamedTuple):
    """The result of `rasterize`, top row first.

    Attributes
    ----------
    face_id : (H, W) int32
        Row of ``faces``; -1 where nothing was drawn.
    depth : (H, W) float32
        z_ndc, smaller is nearer; +inf where nothing was drawn.
    barycentric : (H, W, 3) float32
        Perspective-correct weights of the face's three vertices; 0 where nothing was drawn.
    """

    face_id: NDArray[np.int32]
    depth: NDArray[np.float32]
    barycentric: NDArray[np.float32]


@hinted
def rasterize(
    clip: ArrayLike,
    faces: ArrayLike,
    size: tuple[int, int],
    *,
    cull: Cull = "none",
    backend: Backend = "auto",
    threads: int = 0,
) -> RasterizeResult:
    """Draw triangles given in clip space.

    Parameters
    ----------
    clip : (V, 4) float
        Homogeneous positions, visible where ``-w <= x, y, z <= w``, as in OpenGL. Rounded to
        float32. Triangles with a non-finite vertex are dropped.
    faces : (F, 3) int
        Rows of ``clip``; counter-clockwise on the screen is the front.
    size : (int, int)
        Width and height in pixels, 1 to 16384.
    cull : {"none", "back", "front"}
    backend, threads
        As for `Renderer`.

    Returns
    -------
    result : RasterizeResult

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError
    """
    width, height = check_size(size)
    positions = _float_rows(clip)
    indices = _index_rows(faces, len(positions))
    culling = _native.CULLS[choose(cull, _native.CULLS, "cull")]
    number = resolve_backend(backend)
    result = RasterizeResult(
        np.empty((height, width), np.int32),
        np.empty((height, width), np.float32),
        np.empty((height, width, 3), np.float32),
    )
    _native.rasterize(positions, indices, culling, number, resolve_threads(threads), *result)
    return result


def _float_rows(clip: ArrayLike) -> np.ndarray:
    if not (isinstance(clip, np.ndarray) and clip.dtype == np.float32):
        clip = floats(clip, "clip")
    with np.errstate(over="ignore"):  # float32 overflow is infinite, and its triangles are dropped
        positions = np.ascontiguousarray(clip, np.float32)
    if positions.ndim != 2 or positions.shape[1] != 4:
        raise InvalidArgumentError(f"clip must be (V, 4), not {positions.shape}")
    return positions


def _index_rows(faces: ArrayLike, count: int) -> np.ndarray:
    indices = as_array(faces, "faces")
    if indices.size == 0:
        return np.empty((0, 3), np.int32)
    if indices.ndim != 2 or indices.shape[1] != 3 or indices.dtype.kind not in "iu":
        raise InvalidArgumentError(
            f"faces must be (F, 3) integers, not {indices.shape} {indices.dtype}"
        )
    low, high = indices.min(), indices.max()
    if low < 0 or high >= count:
        raise InvalidArgumentError(
            f"faces must be in 0..{count - 1} for {count} vertices: found {low}..{high}"
        )
    return np.ascontiguousarray(indices, np.int32)

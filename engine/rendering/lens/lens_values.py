"""The values that a lens's pixels show: found by their rays, or those of the nearest pixel.

In: what the rays meet, and the arrays of the pinhole pictures. Out: arrays as frames have them.
Nothing is filtered (docs/exactness, R208).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._lens_view import LensView
from .._output_pool import shapes_of
from .lens_options import IDENTITIES
from .lens_plan import LensPlan


class Found(NamedTuple):
    """What the rays of pixels meet.

    Attributes
    ----------
    source : (H, W) int32
        The pixel of the faces whose values it takes; -1 for none.
    ids : (H, W, 3) int32
        Object, instance, face; -1 for none.
    distance : (H, W) float64
        Along the ray, in the scene's unit; 0 for none.
    barycentric : (H, W, 3) float32 or None
    exact : (H, W) uint8
        1 where ``barycentric`` has values, if there is one.
    """

    source: NDArray[np.int32]
    ids: NDArray[np.int32]
    distance: NDArray[np.float64]
    barycentric: NDArray[np.float32] | None
    exact: NDArray[np.uint8]

    @classmethod
    def empty(cls, shape: tuple[int, ...], weights: bool) -> Found:
        """Return arrays for a picture of (H, W) pixels."""
        return cls(
            np.empty(shape, np.int32),
            np.empty((*shape, 3), np.int32),
            np.empty(shape, np.float64),
            np.empty((*shape, 3), np.float32) if weights else None,
            np.empty(shape, np.uint8),
        )


def blank(name: str, size: tuple[int, int]) -> NDArray[Any]:
    """Return an array for an output, with arbitrary contents."""
    shape, dtype = shapes_of((name,), *size)[name]
    return np.empty(shape, dtype)


def value_of(
    name: str,
    found: Found,
    plan: LensPlan,
    view: LensView,
    arrays: dict[str, NDArray[Any]],
    out: NDArray[Any],
) -> None:
    """Write an output of a lens's picture."""
    if name in IDENTITIES:
        out[...] = found.ids[..., IDENTITIES.index(name)]
    elif name == "depth":
        out[...] = found.distance
        if view.camera.depth_along == "axis":
            out[...] = np.where(found.distance > 0.0, found.distance * -plan.rays[..., 2], 0.0)
    elif name == "range":
        out[...] = found.distance
    elif name in ("position", "world_position"):
        out[...] = _positions(name, found, plan, view)
    else:
        np.take(arrays[name], np.maximum(found.source, 0), axis=0, out=out, mode="clip")
        out[found.source < 0] = -1 if name == "material_id" else 0
        if name == "barycentric" and found.barycentric is not None:
            np.copyto(out, found.barycentric, where=found.exact[..., np.newaxis] != 0)


def _positions(name: str, found: Found, plan: LensPlan, view: LensView) -> NDArray[np.float64]:
    met = (found.ids[..., :1] >= 0) & np.isfinite(plan.rays)
    places = np.where(met, plan.rays, 0.0) * found.distance[..., np.newaxis]
    if name == "world_position":
        pose, seen = view.pose, places
        places = np.empty(seen.shape)
        for row in range(3):
            x, y, z, away = pose[row].tolist()
            places[..., row] = seen[..., 0] * x + seen[..., 1] * y + seen[..., 2] * z + away
    return np.where(met, places, 0.0)


def coloured_values(
    mode: str,
    values: NDArray[np.float32],
    found: Found,
    depth_range: tuple[float, float],
    color: NDArray[np.uint8],
) -> None:
    """Colour depths or normals by R209, where the lens sees a surface."""
    met = found.ids[..., 0] >= 0
    if mode == "depth":
        near, far = (np.float32(end) for end in depth_range)
        share = (values[met] - near) * (np.float32(1.0) / (far - near))
        shown = (np.float32(1.0) - np.clip(share, 0.0, 1.0))[:, np.newaxis]
    else:
        shown = values[met] * np.float32(0.5) + np.float32(0.5)
    color[met, :3] = np.rint(np.float32(255.0) * np.clip(shown, 0.0, 1.0)).astype(np.uint8)
    color[met, 3] = 255

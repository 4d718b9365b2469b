"""The values that a lens's pixels show: found by their rays, or those of the nearest pixel.

In: what the rays meet, and the arrays of the pinhole pictures. Out: arrays as frames have them.
Nothing is filtered (docs/exactness, R208).
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .._lens_view import LensView
from .._output_pool import shapes_of
from .lens_options import IDENTITIES, OF_VALUES, TURNED
from .lens_plan import LensPlan

#: Outputs that rays find, and those that follow from the distance along them.
_BY_RAYS = (*IDENTITIES, "depth", "range")
_PLACES = ("position", "world_position")


#: Arrays by their names: what the rays of pixels meet, as in e3d_lens.h.
Found: TypeAlias = dict[str, NDArray[Any]]


def empty(outputs: dict[str, NDArray[Any]], mode: str, size: tuple[int, int]) -> Found:
    """Return what is to be found for a picture, with arbitrary contents.

    Parameters
    ----------
    outputs : dict of arrays
        The picture's; what rays find is written into them.
    mode : str
        What its colours show.
    size : (int, int)
    """
    shape = size[1], size[0]
    coloured = {OF_VALUES[mode]} if "color" in outputs and mode in OF_VALUES else set()
    wanted = {*outputs, *coloured}
    found: Found = {}
    for name in wanted.intersection(_BY_RAYS):
        found[name] = outputs[name] if name in outputs else blank(name, size)
    if wanted.difference(_BY_RAYS, _PLACES, ("color",)):
        found["source"] = np.empty(shape, np.int32)
    if wanted.intersection(_PLACES):
        found["distance"] = np.empty(shape, np.float64)
    if (coloured or "distance" in found) and "object_id" not in found:
        found["object_id"] = np.empty(shape, np.int32)
    if "barycentric" in outputs:
        found["barycentric"] = np.empty((*shape, 3), np.float32)
        found["exact"] = np.empty(shape, np.uint8)
    return found


def blank(name: str, size: tuple[int, int]) -> NDArray[Any]:
    """Return an array for an output, with arbitrary contents."""
    shape, dtype = shapes_of((name,), *size)[name]
    return np.empty(shape, dtype)


def value_of(
    name: str,
    found: Found,
    plan: LensPlan,
    view: LensView,
    faces: dict[str, NDArray[Any]],
    threads: int,
    out: NDArray[Any],
) -> None:
    """Write an output of a lens's picture, given what the faces show."""
    if name in _BY_RAYS:
        return  # it is found in place
    if name in _PLACES:
        out[...] = _positions(name, found, plan, view)
    else:
        values = faces[name]
        to = out.view(np.uint8).reshape(*out.shape[:2], -1)
        raw = values.view(np.uint8).reshape(len(values), -1)
        none = 255 if name == "material_id" else 0  # -1
        plan.native.take(found["source"], raw, name in TURNED, none, threads, to)
        if name == "barycentric":
            exact = found["exact"][..., np.newaxis] != 0
            np.copyto(out, found["barycentric"], where=exact)


def _positions(name: str, found: Found, plan: LensPlan, view: LensView) -> NDArray[np.float64]:
    met = (found["object_id"] >= 0)[..., np.newaxis] & np.isfinite(plan.rays)
    places = np.where(met, plan.rays, 0.0) * found["distance"][..., np.newaxis]
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
    met = found["object_id"] >= 0
    if mode == "depth":
        near, far = (np.float32(end) for end in depth_range)
        share = (values[met] - near) * (np.float32(1.0) / (far - near))
        shown = (np.float32(1.0) - np.clip(share, 0.0, 1.0))[:, np.newaxis]
    else:
        shown = values[met] * np.float32(0.5) + np.float32(0.5)
    color[met, :3] = np.rint(np.float32(255.0) * np.clip(shown, 0.0, 1.0)).astype(np.uint8)
    color[met, 3] = 255

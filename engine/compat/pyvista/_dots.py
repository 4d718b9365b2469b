"""Points as large as in VTK: squares, discs, or half balls towards the camera.

In: points in view space. Out: a `Part` that stands at each of them.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...base.linalg import cos, sin
from ._parts import Paint, Part
from ._properties import Property
from ._view import View

_SIDES = 24
_FEW_SIDES = 8
_SMALL = 5.0  # pixels: smaller balls have fewer sides


def dots(
    view: View,
    centers: NDArray[np.float64],
    paint: Paint,
    look: Property,
    normals: NDArray[np.float64] | None,
) -> Part:
    """Return the marks of points.

    Parameters
    ----------
    centers : (N, 3) float64
        In view space.
    paint : Paint
        Of the points.
    normals : (N, 3) float64 or None
        For light; None: they face the camera.
    """
    seen = np.isfinite(centers).all(1) & (centers[:, 2] < -view.clipping_range[0])
    if not seen.all():
        rows = np.flatnonzero(seen)
        centers, paint = centers[rows], paint.taken(rows)
        normals = None if normals is None else normals[rows]
    baked = paint.baked()
    half = 0.5 * look.point_size * view.pixel_sizes(centers)
    if look.has_balls:
        places, faces = _half_ball(_SIDES if look.point_size > _SMALL else _FEW_SIDES)
        away = places
    else:
        places, faces = _disc() if look.round_points else _square()
        away = np.tile([0.0, 0.0, 1.0], (len(places), 1))
        if normals is not None:
            return _apart(centers, half, places, faces, normals, baked, look)
    return Part(
        places=places,
        faces=faces,
        look=look,
        normals=away,
        paint=Paint(is_clear=paint.is_clear),
        spots=np.concatenate([centers, half[:, None]], 1),
        spot_colors=baked.rgba,
    )


def _apart(
    centers: NDArray[np.float64],
    half: NDArray[np.float64],
    places: NDArray[np.float64],
    faces: NDArray[np.int32],
    normals: NDArray[np.float64],
    paint: Paint,
    look: Property,
) -> Part:
    """Return marks with a normal each."""
    count = len(places)
    whole = centers[:, None] + half[:, None, None] * places
    firsts = np.arange(len(centers), dtype=np.int32) * np.int32(count)
    return Part(
        places=whole.reshape(-1, 3),
        faces=(firsts[:, None, None] + faces).reshape(-1, 3),
        look=look,
        normals=np.repeat(normals, count, 0),
        paint=paint.taken(np.repeat(np.arange(len(centers)), count)),
    )


def _square() -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    places = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    return places, np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def _disc() -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    places, faces = _rings((1.0,), _SIDES)
    return places * (1.0, 1.0, 0.0), faces


def _half_ball(sides: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    return _rings((1.0,) if sides == _FEW_SIDES else (0.35, 0.65, 0.87, 0.97, 1.0), sides)


def _rings(
    radii: tuple[float, ...], sides: int
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the middle and rings of a half ball that looks along +Z."""
    angles = [2.0 * math.pi * k / sides for k in range(sides)]
    places = [(0.0, 0.0, 1.0)]
    for radius in radii:
        height = math.sqrt(max(1.0 - radius * radius, 0.0))
        # So wide that a ring covers what its circle does.
        wide = radius * (math.pi / sides / sin(math.pi / sides)) ** 0.5
        places += [(wide * cos(angle), wide * sin(angle), height) for angle in angles]
    k = np.arange(sides, dtype=np.int32)
    after = (k + 1) % sides
    faces = [np.stack([0 * k, 1 + k, 1 + after], -1)]
    for ring in range(len(radii) - 1):
        inner, outer = 1 + ring * sides, 1 + (ring + 1) * sides
        faces.append(np.stack([inner + k, outer + k, outer + after], -1))
        faces.append(np.stack([inner + k, outer + after, inner + after], -1))
    return np.array(places), np.concatenate(faces).astype(np.int32)

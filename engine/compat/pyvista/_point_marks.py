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
from ._renderer_view import View

#: Sides and radii of the rings of half balls, by the largest size in pixels, and of how many.
_BALLS = (
    (5.0, 8, (1.0,)),
    (14.0, 12, (0.55, 0.87, 1.0)),
    (np.inf, 24, (0.35, 0.65, 0.87, 0.97, 1.0)),
)
_MANY = 20000  # of so many balls, none has the most sides
_SIDES = 24


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
    if look.has_balls:
        return _spread(view, centers, *_half_ball(look.point_size, len(centers)), baked, look)
    if normals is not None:
        places, faces = _disc() if look.round_points else _square()
        half = 0.5 * look.point_size * view.pixel_sizes(centers)
        return _apart(centers, half, places, faces, normals, baked, look)
    none = np.zeros((0, 3), np.int32)
    return Part(places=centers, faces=none, look=look, paint=baked, is_points=True)


def spread_points(part: Part, view: View) -> Part:
    """Return points that the core draws as triangles, so that they may be clear, or of any size."""
    places, faces = _disc() if part.look.round_points else _square()
    return _spread(view, part.places, places, faces, part.paint, part.look)


def _spread(
    view: View,
    centers: NDArray[np.float64],
    places: NDArray[np.float64],
    faces: NDArray[np.int32],
    paint: Paint,
    look: Property,
) -> Part:
    """Return a mark that stands at each point."""
    half = 0.5 * look.point_size * view.pixel_sizes(centers)
    is_flat = not places[:, 2].any()
    return Part(
        places=places,
        faces=faces,
        look=look,
        normals=np.tile([0.0, 0.0, 1.0], (len(places), 1)) if is_flat else places,
        paint=Paint(is_clear=paint.is_clear),
        spots=np.concatenate([centers, half[:, None]], 1),
        spot_colors=paint.rgba,
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


def _half_ball(size: float, count: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    kinds = _BALLS[:-1] if count > _MANY else _BALLS
    _, sides, radii = next((one for one in kinds if size <= one[0]), kinds[-1])
    return _rings(radii, sides)


def _rings(radii: tuple[float, ...], sides: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
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

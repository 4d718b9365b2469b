"""Lines as wide as in VTK: a rectangle for each segment, or a bent one that looks like a tube.

In: segments in view space. Out: a `Part` of triangles that face the camera.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._parts import Paint, Part
from ._properties import Property
from ._renderer_view import View

_COLUMNS = np.array([-1.0, -0.92, -0.7, -0.38, 0.0, 0.38, 0.7, 0.92, 1.0])
_STEEPEST = 0.5  # VTK draws no tube thicker than twice its width


def strokes(
    view: View,
    ends: NDArray[np.float64],
    paint: Paint,
    look: Property,
    normals: NDArray[np.float64] | None = None,
) -> Part:
    """Return the rectangles of segments.

    Parameters
    ----------
    ends : (S, 2, 3) float64
        In view space.
    paint : Paint
        Of the 2 S ends, segment by segment.
    normals : (S, 2, 3) float64 or None
        For light; None: each stroke faces the camera as far as it can.
    """
    kept, ends, shares = _before_camera(view, ends)
    rows = (2 * kept[:, None] + np.arange(2)).reshape(-1)
    paint = _between(paint.taken(rows), shares)
    pixels = view.pixels(ends.reshape(-1, 3)).reshape(-1, 2, 3)
    along = pixels[:, 1, :2] - pixels[:, 0, :2]
    length = np.hypot(along[:, 0], along[:, 1])
    seen = length > 1e-9
    if not seen.all():
        ends, along, length, kept = ends[seen], along[seen], length[seen], kept[seen]
        paint = paint.taken(np.flatnonzero(np.repeat(seen, 2)))
    # Across the stroke, in view space, where y is up.
    side = (
        np.stack([along[:, 1], along[:, 0], 0.0 * length], -1) / np.maximum(length, 1e-300)[:, None]
    )
    half = 0.5 * look.line_width * view.pixel_sizes(ends.reshape(-1, 3)).reshape(-1, 2)
    columns = _COLUMNS if look.has_tubes else np.array([-1.0, 1.0])
    across = side[:, None, None] * (half[:, :, None] * columns)[..., None]
    places = ends[:, :, None] + across
    direction = ends[:, 1] - ends[:, 0]
    if look.has_tubes:
        away, rise = _tube(side, direction, columns)
        places = _nearer(view, places, half[:, :, None] * rise[:, None])
        lit = np.broadcast_to(away[:, None], places.shape)
    elif normals is not None:
        lit = np.broadcast_to(normals[kept][:, :, None], places.shape)
    else:
        lit = np.broadcast_to(_facing(direction)[:, None, None], places.shape)
    width = len(columns)
    return Part(
        places=places.reshape(-1, 3),
        faces=_faces(len(ends), width),
        look=look,
        normals=lit.reshape(-1, 3).astype(np.float64),
        paint=paint.taken(np.repeat(np.arange(2 * len(ends)), width)),
    )


def _faces(count: int, width: int) -> NDArray[np.int32]:
    """Return the triangles of strips with 2 rows of ``width`` vertices."""
    k = np.arange(width - 1, dtype=np.int32)
    one = np.stack([k, k + width, k + 1, k + 1, k + width, k + 1 + width], -1).reshape(-1, 3)
    firsts = np.arange(count, dtype=np.int32) * np.int32(2 * width)
    return (firsts[:, None, None] + one).reshape(-1, 3)


def _facing(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what VTK takes for the normals of lines: across them, towards the viewer."""
    x, y, z = direction.T
    return np.stack([-x * z, -y * z, x * x + y * y], -1)


def _tube(
    side: NDArray[np.float64], direction: NDArray[np.float64], columns: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return normals (S, C, 3) across tubes, and how far they rise (S, C), in half widths."""
    length = np.sqrt((direction * direction).sum(1, keepdims=True))
    x, y, z = (direction / np.maximum(length, 1e-300)).T
    # Across the line and its side.
    out = np.stack([-z * side[:, 1], z * side[:, 0], x * side[:, 1] - y * side[:, 0]], -1)
    out /= np.maximum(np.sqrt((out * out).sum(1, keepdims=True)), 1e-300)
    out *= np.where(out[:, 2:] < 0.0, -1.0, 1.0)
    height = np.sqrt(np.maximum(1.0 - columns * columns, 0.0))
    normals = side[:, None] * columns[:, None] + out[:, None] * height[:, None]
    return normals, height / np.clip(out[:, 2:], _STEEPEST, 1.0)


def _nearer(
    view: View, places: NDArray[np.float64], by: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return places nearer to the camera along the rays through them."""
    if view.is_parallel:
        out = places.copy()
        out[..., 2] += by
        return out
    scale = (places[..., 2] + by) / np.minimum(places[..., 2], -1e-300)
    return places * np.clip(scale, 0.0, None)[..., None]


def _before_camera(
    view: View, ends: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
    """Cut segments at the near plane.

    Returns
    -------
    kept : (K,) int
        Which are left.
    ends : (K, 2, 3) float64
    shares : (K, 2) float64
        How far the first end moved to the second, and the second from the first.
    """
    near = -view.clipping_range[0]
    z = ends[..., 2]
    finite = np.isfinite(ends).all((1, 2))
    kept = np.flatnonzero(finite & (z < near).any(1))
    ends, z = ends[kept], z[kept]
    shares = np.tile([0.0, 1.0], (len(kept), 1))
    for k in range(2):
        out = z[:, k] > near
        step = (near - z[out, k]) / (z[out, 1 - k] - z[out, k])
        shares[out, k] = step if k == 0 else 1.0 - step
    a, b = ends[:, :1], ends[:, 1:]
    return kept, a + (b - a) * shares[..., None], shares


def _between(paint: Paint, shares: NDArray[np.float64]) -> Paint:
    """Return the colours where segments were cut."""
    if not len(shares) or ((shares[:, 0] == 0.0) & (shares[:, 1] == 1.0)).all():
        return paint

    def mixed(values: NDArray) -> NDArray:
        pairs = values.reshape(-1, 2, values.shape[1]).astype(np.float64)
        a, b = pairs[:, :1], pairs[:, 1:]
        out = (a + (b - a) * shares[..., None]).reshape(-1, values.shape[1])
        return np.rint(out).astype(np.uint8) if values.dtype == np.uint8 else out.astype(np.float32)

    return Paint(
        None if paint.rgba is None else mixed(paint.rgba),
        None if paint.uvs is None else mixed(paint.uvs),
        paint.image,
        paint.is_clear,
        paint.is_color,
    )

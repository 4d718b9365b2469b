"""Views of mirrors: a picture's view, reflected about a plane (docs/exactness, R213).

In: a view, a plane of mirrors. Out: the part of the picture that shows it, and the view that draws
what it reflects there, sample by sample. Source of the near plane that lies in the mirror: Lengyel
2005 (oblique view frustum).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.box_corners import box_corners
from .._view import View
from .mirror_planes import MirrorPlane

_STEP = 64  # samples: parts of pictures begin and end at multiples
_NEAREST = 2.0**-30  # of the greatest w: nearer corners are beside the picture


class Part(NamedTuple):
    """A rectangle of a picture's samples.

    Attributes
    ----------
    left, top, width, height : int
    area : float
        Samples of the picture within the outline of what it shows.
    """

    left: int
    top: int
    width: int
    height: int
    area: float


def part_of(plane: MirrorPlane, view: View, size: tuple[int, int]) -> Part | None:
    """Return the part of a picture's samples, ``size``, that may show a mirror; None if none."""
    corners = np.stack(plane.rectangles)
    x, y, z, w = (linalg.dot(corners, row[:3]) + row[3] for row in view.clip_from_world)
    if (z + w < 0.0).all():  # as the mirror that the view is of
        return None
    columns, rows = _outline(np.stack([x, y, w]))
    if not len(columns):
        return None
    columns, rows = (columns + 1.0) * 0.5 * size[0], (1.0 - rows) * 0.5 * size[1]
    (left, right), (top, bottom) = _steps(columns, size[0]), _steps(rows, size[1])
    if not (left < right and top < bottom):
        return None
    area = float(np.ptp(columns.clip(0, size[0])) * np.ptp(rows.clip(0, size[1])))
    return Part(left, top, right - left, bottom - top, area)


def _outline(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the ends of rectangles' sides in a picture, as far as they are before the eye.

    Parameters
    ----------
    corners : (3, N, 4) float64
        x, y and w of the rectangles' corners in clip space.
    """
    others = np.roll(corners, -1, axis=2)
    least = _NEAREST * max(float(np.abs(corners[2]).max()), 2.0**-100)
    starts, ends = corners[2] >= least, others[2] >= least
    with np.errstate(all="ignore"):
        crossing = np.clip((least - corners[2]) / (others[2] - corners[2]), 0.0, 1.0)
    points = []
    for share in (np.where(starts, 0.0, crossing), np.where(ends, 1.0, crossing)):
        at = (corners + (others - corners) * share)[:, starts | ends]
        points.append(at[:2] / np.maximum(at[2], least))
    return np.concatenate(points, axis=1)


def _steps(places: NDArray[np.float64], size: int) -> tuple[int, int]:
    """Return where a range of samples begins and ends, with a sample more on either side."""
    low, high = float(places.min()) - 1.0, float(places.max()) + 1.0
    if not (low < size and high > 0.0):
        return 0, 0
    low, high = max(low, 0.0), min(high, float(size))
    return int(low // _STEP) * _STEP, min(int(-(-high // _STEP)) * _STEP, size)


class Reflection(View):
    """The view of what a mirror shows in a part of a picture.

    Parameters
    ----------
    view : View
        The picture's.
    plane : MirrorPlane
    part : Part
    size : (int, int)
        The picture's samples.
    scale : int
        Pixels of the reflection that are side by side in a sample.
    bounds : (2, 3) float64
        The box around the scene.

    Attributes
    ----------
    part, scale
    size : (int, int)
        Pixels of the reflection.
    is_usable : bool
        Whether anything can be seen.
    """

    def __init__(
        self,
        view: View,
        plane: MirrorPlane,
        part: Part,
        size: tuple[int, int],
        scale: int,
        bounds: NDArray[np.float64],
    ) -> None:
        reflect = _reflection(plane)
        camera = view.camera
        crop = _crop(part, size)
        self.part, self.scale = part, scale
        self.size = part.width * scale, part.height * scale
        self._lens = (camera, camera.version, *self.size)
        self._pose_bytes = b""
        self.camera = camera
        self.projection = linalg.multiply(crop, view.projection)
        self.view_from_world = linalg.multiply(view.view_from_world, reflect)
        clip = linalg.multiply(crop, view.clip_from_world, reflect)
        towards = linalg.transform_directions(reflect, np.array(view.towards_viewer))
        self.towards_viewer = tuple(towards.tolist())
        turn = linalg.transform_points if view.eye[3] else linalg.transform_directions
        self.eye = (*turn(reflect, np.array(view.eye[:3])).tolist(), view.eye[3])
        # The mirror itself, which lies up to its slack before the plane, isn't shown.
        above = np.array([*plane.normal, -(plane.offset + 2.0 * plane.slack)])
        if view.eye[3]:
            steepest = _steepest(clip, plane.normal)
        else:
            highest = float(plane.height(box_corners(bounds)).max())
            steepest = highest / float(clip[3, 3])
        self.is_usable = bool(0.0 < steepest < np.inf) and bool(np.isfinite(clip).all())
        clip[2] = above * (2.0 / steepest if self.is_usable else 1.0) - clip[3]
        self.clip_from_world = clip


def _reflection(plane: MirrorPlane) -> NDArray[np.float64]:
    matrix = np.eye(4)
    for row in range(3):
        matrix[row, :3] -= 2.0 * plane.normal[row] * plane.normal
        matrix[row, 3] = 2.0 * plane.normal[row] * plane.offset
    return matrix


def _crop(part: Part, size: tuple[int, int]) -> NDArray[np.float64]:
    """Return the matrix from clip space of a picture to that of a part of it."""
    matrix = np.eye(4)
    matrix[0, 0], matrix[1, 1] = size[0] / part.width, size[1] / part.height
    matrix[0, 3] = (size[0] - 2.0 * part.left) / part.width - 1.0
    matrix[1, 3] = 1.0 - (size[1] - 2.0 * part.top) / part.height
    return matrix


def _steepest(clip: NDArray[np.float64], normal: NDArray[np.float64]) -> float:
    """Return how much rays through a picture's corners rise along a normal, at most, by w."""
    x, y, w = clip[0, :3], clip[1, :3], clip[3, :3]
    right, up, ahead = linalg.cross(y, w), linalg.cross(w, x), linalg.cross(x, y)
    rises = [float(linalg.dot(part, normal)) for part in (right, up, ahead)]
    volume = float(linalg.dot(ahead, w))
    if not volume:
        return 0.0
    return max((rises[2] + i * rises[0] + j * rises[1]) / volume for i in (-1, 1) for j in (-1, 1))

"""Cameras that fit a box or a scene into the picture, as large as possible.

In: the subject, the image's aspect and a view direction. Out: a camera and its pose. The frustum's
planes touch the subject, and the near and far planes enclose it tightly, which keeps depth precise.
The same inputs give the same bits on every machine.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..base import linalg
from ..base.angles import field_of_view
from ..base.numbers import floats, shown
from ..base.validation import positive
from ..errors import InvalidArgumentError
from ..model.scene.cameras import PerspectiveCamera
from ..model.scene.scene import Scene
from .support_functions import SupportFunction, support_of_box, support_of_scene

#: The default field of view of the longer side of a picture, in radians.
LENS = math.radians(38.0)
DIRECTION = (-0.35, -0.25, -1.0)
UP = (0.0, 1.0, 0.0)
# The planes keep this fraction of their distance as a margin, so that rounding cuts nothing off.
_SLACK = 1e-4
_SECANTS = 2
_FAR_AWAY = 2.0**40
_NEAREST = 1e-3  # of the far plane's distance: a nearer plane would cost depth too many bits


def frame_bounds(
    bounds: ArrayLike,
    *,
    aspect: float = 1.0,
    yfov: float | None = None,
    direction: ArrayLike = DIRECTION,
    up: ArrayLike = UP,
    margin: float = 1.05,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera and its pose that show a whole box, as large as possible.

    Parameters
    ----------
    bounds : (2, 3) float
        Smallest and largest corner in world space, such as ``mesh.bounds`` or ``scene.bounds``.
    aspect : float
        Width over height of the image.
    yfov : float, optional
        Vertical field of view in radians; by default the longer side has 38 degrees.
    direction : (3,) float
        The view direction; by default from the front, slightly from the right and above.
    up : (3,) float
        The direction that points up in the image.
    margin : float
        Factor on the visible extent; 1 is a tight fit.

    Returns
    -------
    camera : PerspectiveCamera
        Its near and far planes enclose the box tightly, which keeps depth precise.
    pose : (4, 4) float64
        world-from-camera.

    Raises
    ------
    InvalidArgumentError
    """
    return _frame(None, bounds, aspect, yfov, direction, up, margin)


def frame_scene(
    scene: Scene,
    *,
    aspect: float = 1.0,
    yfov: float | None = None,
    direction: ArrayLike = DIRECTION,
    up: ArrayLike = UP,
    margin: float = 1.05,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera and its pose that show a whole scene, as large as possible.

    It fits the vertices of visible objects, so round models fill the picture better than their
    bounding boxes would. Scenes without a camera are drawn with this one.

    Parameters
    ----------
    scene : Scene
    aspect, yfov, direction, up, margin
        As for `frame_bounds`.

    Returns
    -------
    camera : PerspectiveCamera
    pose : (4, 4) float64
        world-from-camera.

    Raises
    ------
    InvalidArgumentError
    """
    if not isinstance(scene, Scene):
        raise InvalidArgumentError(f"scene must be a Scene, not {type(scene).__name__}")
    return _frame(support_of_scene(scene), scene.bounds, aspect, yfov, direction, up, margin)


def lens_for(aspect: float) -> float:
    """Return the default vertical field of view of a picture, in radians.

    Parameters
    ----------
    aspect : float
        Width over height.
    """
    return LENS if aspect <= 1.0 else 2.0 * linalg.atan2(linalg.tan(0.5 * LENS), aspect)


@np.errstate(all="ignore")
def _frame(
    support: SupportFunction | None,
    bounds: ArrayLike,
    aspect: float,
    yfov: float | None,
    direction: ArrayLike,
    up: ArrayLike,
    margin: float,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    smallest, largest = _corners(bounds)
    aspect = positive(aspect, "aspect")
    yfov = lens_for(aspect) if yfov is None else yfov
    y_slope = linalg.tan(0.5 * field_of_view(yfov))
    x_slope = y_slope * aspect
    margin = positive(margin, "margin")
    center, half = (smallest + largest) * 0.5, (largest - smallest) * 0.5
    if not half.any():
        support, half = None, np.ones(3)
    if support is None:
        support = support_of_box((center - half, center + half))
    backward = -linalg.normalize(_direction(direction))
    # Only its axes are used: for a target so distant that adding the step would be lost, use the
    # origin.
    target = center if (np.abs(center) < _FAR_AWAY).all() else np.zeros(3)
    pose = linalg.look_at(target + backward, target, up)
    slopes = x_slope / margin, y_slope / margin
    x, y, distance, edges = fit_frustum(support, pose[:3, :3].T, center, *slopes)
    pose[:3, 3] = center + pose[:3, 0] * x + pose[:3, 1] * y + backward * distance
    room = max(margin - 1.0, 0.0) * 0.5 * (edges.near + edges.far)
    zfar = (distance + edges.far + room) * (1.0 + _SLACK)
    znear = max((distance - edges.near - room) * (1.0 - _SLACK), _NEAREST * zfar)
    if not 0.0 < znear < zfar < np.inf:
        raise InvalidArgumentError(
            "the scene's coordinates are too large for a camera to be placed"
        )
    return PerspectiveCamera(yfov, znear=znear, zfar=zfar), pose


def fit_frustum(
    support: SupportFunction, axes: np.ndarray, center: np.ndarray, x_slope: float, y_slope: float
) -> tuple[float, float, float, FrustumReach]:
    """Return where a camera must stand to show all of a subject as large as possible.

    Parameters
    ----------
    support, axes, center, x_slope, y_slope
        As for `frustum_reach`.

    Returns
    -------
    x, y, distance : float
        The eye's coordinates along the axes, relative to ``center``.
    edges : FrustumReach
        The extent of the subject.
    """
    edges = frustum_reach(support, axes, center, x_slope, y_slope)
    distance = max(edges.distances)
    if distance - edges.near < _NEAREST * (distance + edges.far):
        distance = edges.near + 0.5 * (edges.near + edges.far)  # a line seen end on
    x, y = _middle(support, axes, center, edges, distance)
    return x, y, distance, edges


def _middle(
    support: SupportFunction,
    axes: np.ndarray,
    center: np.ndarray,
    edges: FrustumReach,
    distance: float,
) -> tuple[float, float]:
    """Return the lateral position of the eye that leaves equal room on both sides.

    If the other direction needs a greater distance, narrower planes touch here, and the eye is in
    the middle between them. The secant method finds the slope at which they meet at the eye.
    """
    slopes = list(edges.slopes)
    for way in range(2):  # first guess: the ratio of the distances to the farthest point
        if distance + edges.far > 0:  # not a single point
            share = (edges.distances[way] + edges.far) / (distance + edges.far)
            slopes[way] *= min(1.0, share)
    narrow = edges
    for _ in range(_SECANTS):
        if slopes == list(narrow.slopes):
            break
        before, narrow = narrow, frustum_reach(support, axes, center, *slopes)
        for way in range(2):
            gap, gap_before = narrow.gap(way, distance), before.gap(way, distance)
            if gap != gap_before:
                step = gap * (narrow.slopes[way] - before.slopes[way]) / (gap - gap_before)
                slopes[way] = min(max(narrow.slopes[way] - step, 0.0), edges.slopes[way])
    x_room, y_room = (slope * distance for slope in edges.slopes)
    x = min(max(narrow.x, edges.right - x_room), x_room - edges.left)
    y = min(max(narrow.y, edges.top - y_room), y_room - edges.bottom)
    return x, y


class FrustumReach(NamedTuple):
    """The extent of a subject across the planes of a frustum, relative to a centre.

    A camera at (x, y, distance) along its own axes sees a point (across, upward, near) between
    planes that open by ``slope`` if ``|across - x| <= slope * (distance - near)``: a bound for the
    left and one for the right plane, both met where they cross; and likewise upward.

    Attributes
    ----------
    right, left, top, bottom : float
        The maxima of ``±across + slope * near`` and ``±upward + slope * near``.
    near, far : float
        The maximum of ``near``, and its negated minimum.
    x_slope, y_slope : float
    """

    right: float
    left: float
    top: float
    bottom: float
    near: float
    far: float
    x_slope: float
    y_slope: float

    @property
    def x(self) -> float:
        """The camera's lateral position from which both sides are visible, as near as possible."""
        return 0.5 * (self.right - self.left)

    @property
    def y(self) -> float:
        return 0.5 * (self.top - self.bottom)

    @property
    def slopes(self) -> tuple[float, float]:
        return self.x_slope, self.y_slope

    def gap(self, way: int, distance: float) -> float:
        """Return by how much the sides are too far apart for an eye at a distance (1: upward)."""
        first, second = self[2 * way : 2 * way + 2]
        return 0.5 * (first + second) - self.slopes[way] * distance

    @property
    def distances(self) -> tuple[float, float]:
        """The distances at which both sides just fit, at ``x``; and top and bottom, at ``y``."""
        width, height = self.right + self.left, self.top + self.bottom
        return 0.5 * width / self.x_slope, 0.5 * height / self.y_slope


def frustum_reach(
    support: SupportFunction, axes: np.ndarray, center: np.ndarray, x_slope: float, y_slope: float
) -> FrustumReach:
    """Return how far a subject extends across the planes of a camera.

    Parameters
    ----------
    support : callable
        See support_functions.py.
    axes : (3, 3) float64
        Rows: the camera's right, up and back, in world space.
    center : (3,) float64
        The origin of the measurement.
    x_slope, y_slope : float
        Slopes of the side planes, and of the upper and lower planes.
    """
    right, up, back = axes
    directions = np.array(
        [
            right + back * x_slope,
            back * x_slope - right,
            up + back * y_slope,
            back * y_slope - up,
            back,
            -back,
        ]
    )
    to_right, left, top, bottom, near, far = support(directions) - linalg.dot(directions, center)
    return FrustumReach(to_right, left, top, bottom, near, far, x_slope, y_slope)


def _corners(bounds: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    array = floats(bounds, "bounds")
    if array.shape != (2, 3) or not np.isfinite(array).all():
        raise InvalidArgumentError("bounds must be two finite corners, (2, 3)")
    if (array[0] > array[1]).any():
        raise InvalidArgumentError("bounds: the first corner must be the smaller one")
    return array[0], array[1]


def _direction(value: ArrayLike) -> np.ndarray:
    array = floats(value, "direction")
    if array.shape != (3,) or not np.isfinite(array).all() or not array.any():
        raise InvalidArgumentError(f"direction must be a vector of 3 numbers, not {shown(value)}")
    return array

"""Cameras that show a whole box or a whole scene, as large as possible.

In: what is to be shown, the image's aspect and the way to look. Out: a camera and its pose. The eye
stands where the planes of the frustum touch what is shown, and the near and far planes enclose it
closely, which keeps depth precise. The same inputs give the same bits on every machine.
"""

from __future__ import annotations

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

_DIRECTION = (-0.35, -0.25, -1.0)
_UP = (0.0, 1.0, 0.0)
# The planes stand off by this share of their distance: what touches them is not cut by rounding.
_SLACK = 1e-4
_SECANTS = 2
_FAR_AWAY = 2.0**40
_NEAREST = 1e-3  # of the far plane's distance: nearer, and depth would lose too many bits


def frame_bounds(
    bounds: ArrayLike,
    *,
    aspect: float = 1.0,
    yfov: float = 0.9,
    direction: ArrayLike = _DIRECTION,
    up: ArrayLike = _UP,
    margin: float = 1.05,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera and its pose that show a whole box, as large as possible.

    Parameters
    ----------
    bounds : (2, 3) float
        Smallest and largest corner in world space, such as ``mesh.bounds`` or ``scene.bounds``.
    aspect : float
        Width over height of the image.
    yfov : float
        Vertical field of view in radians.
    direction : (3,) float
        The way the camera looks; by default from the front, a little from the right and above.
    up : (3,) float
        The direction that points up in the image.
    margin : float
        How much more than the box is shown; 1 is a tight fit.

    Returns
    -------
    camera : PerspectiveCamera
        Its near and far planes enclose the box closely, which keeps depth precise.
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
    yfov: float = 0.9,
    direction: ArrayLike = _DIRECTION,
    up: ArrayLike = _UP,
    margin: float = 1.05,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera and its pose that show a whole scene, as large as possible.

    It goes by the vertices of what is visible, so round models fill more of the picture than their
    bounding boxes would. This is the camera of scenes that have none.

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


@np.errstate(all="ignore")
def _frame(
    support: SupportFunction | None,
    bounds: ArrayLike,
    aspect: float,
    yfov: float,
    direction: ArrayLike,
    up: ArrayLike,
    margin: float,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    smallest, largest = _corners(bounds)
    y_slope = linalg.tan(0.5 * field_of_view(yfov))
    x_slope = y_slope * positive(aspect, "aspect")
    margin = positive(margin, "margin")
    center, half = (smallest + largest) * 0.5, (largest - smallest) * 0.5
    if not half.any():
        support, half = None, np.ones(3)
    if support is None:
        support = support_of_box((center - half, center + half))
    backward = -linalg.normalize(_direction(direction))
    # Only its axes are used: a target so far away that the step from it is lost is the origin.
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
    """Return where a camera stands to show all of something as large as possible.

    Parameters
    ----------
    support, axes, center, x_slope, y_slope
        As for `frustum_reach`.

    Returns
    -------
    x, y, distance : float
        The eye's coordinates along the axes, from ``center``.
    edges : FrustumReach
        How far what is shown reaches.
    """
    edges = frustum_reach(support, axes, center, x_slope, y_slope)
    distance = max(edges.distances)
    if distance - edges.near < _NEAREST * (distance + edges.far):
        distance = edges.near + 0.5 * (edges.near + edges.far)  # a line that is seen end on
    x, y = _middle(support, axes, center, edges, distance)
    return x, y, distance, edges


def _middle(
    support: SupportFunction,
    axes: np.ndarray,
    center: np.ndarray,
    edges: FrustumReach,
    distance: float,
) -> tuple[float, float]:
    """Return where the eye stands across its line of sight, with equal room on both sides.

    From farther away than one of the ways needs, narrower planes touch there, and between them is
    the middle. The slope from which they meet at the eye is found by the secant method.
    """
    slopes = list(edges.slopes)
    for way in range(2):  # the first guess: in the ratio of the distances to the farthest point
        if distance + edges.far > 0:  # no single point
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
    """The extent of something across the planes of a frustum, from a center.

    A camera at (x, y, distance) along its own axes sees a point (across, upward, near) between
    planes that open by ``slope`` if ``|across - x| <= slope * (distance - near)``: a bound for the
    left and one for the right plane, both met where they cross; and likewise upward.

    Attributes
    ----------
    right, left, top, bottom : float
        The largest ``±across + slope * near`` and ``±upward + slope * near``.
    near, far : float
        The largest and the smallest ``near``, the latter negated.
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
        """The camera's position from which both sides are seen, as near as possible."""
        return 0.5 * (self.right - self.left)

    @property
    def y(self) -> float:
        return 0.5 * (self.top - self.bottom)

    @property
    def slopes(self) -> tuple[float, float]:
        return self.x_slope, self.y_slope

    def gap(self, way: int, distance: float) -> float:
        """By how much too far apart both sides are for an eye at a distance; way 1 is upward."""
        first, second = self[2 * way : 2 * way + 2]
        return 0.5 * (first + second) - self.slopes[way] * distance

    @property
    def distances(self) -> tuple[float, float]:
        """From where both sides just show, at ``x``; and top and bottom, at ``y``."""
        width, height = self.right + self.left, self.top + self.bottom
        return 0.5 * width / self.x_slope, 0.5 * height / self.y_slope


def frustum_reach(
    support: SupportFunction, axes: np.ndarray, center: np.ndarray, x_slope: float, y_slope: float
) -> FrustumReach:
    """Return how far something reaches across the planes of a camera.

    Parameters
    ----------
    support : callable
        See support_functions.py.
    axes : (3, 3) float64
        Rows: the camera's right, up and back, in world space.
    center : (3,) float64
        What is measured from.
    x_slope, y_slope : float
        By how much the side planes, the upper and the lower plane open with the distance.
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

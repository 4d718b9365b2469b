"""A camera placed around a target: what the orbit controller turns and the command line sets.

In: a target, a distance, two angles and an up direction (world space, radians).
Out: a camera with clip planes that enclose the scene, and its 4x4 pose (``world_from_view``).
Always holds: the elevation stays within a quarter turn of the horizon, the distance above zero.
The pose comes from the angles: see `engine3d.model.scene.orbiting`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from ...errors import InvalidArgumentError
from ...model.scene.cameras import OrthographicCamera, PerspectiveCamera
from ...model.scene.nodes import Node
from ...model.scene.orbiting import home_axes, orbit_axes
from ...rendering.framing import fit_frustum, frustum_reach
from ...rendering.support_functions import SupportFunction, support_of_points
from .free_region import NOTHING, Taken, sheared

#: What ``up`` may be, as the command line spells it.
UP_DIRECTIONS = {
    "+X": (1.0, 0.0, 0.0),
    "-X": (-1.0, 0.0, 0.0),
    "+Y": (0.0, 1.0, 0.0),
    "-Y": (0.0, -1.0, 0.0),
    "+Z": (0.0, 0.0, 1.0),
    "-Z": (0.0, 0.0, -1.0),
}
DEFAULT_YFOV = math.radians(35.0)
#: Three-quarter view from the right and a little above: shows three sides of most models.
DEFAULT_AZIMUTH = math.radians(30.0)
DEFAULT_ELEVATION = math.radians(18.0)
QUARTER_TURN = math.pi / 2
#: Space left round what is framed.
FRAMING_MARGIN = 1.06
#: What is less than this share of the picture's height is a dot.
SMALLEST = 0.01
#: A camera whose up direction is farther from ours than this cosine rolls.
ROLLS = 1.0 - 1e-9
#: Seen steeper than this from above or below, a step upward hardly shows.
STEEPEST = 1e-6


class Sphere(NamedTuple):
    """A bounding sphere: ``center`` (3,) and ``radius`` > 0, in world space."""

    center: tuple[float, float, float]
    radius: float


@dataclass
class Viewpoint:
    """A perspective or orthographic camera that looks at a target.

    Attributes
    ----------
    target : (3,) ndarray of float64
        The point looked at, in world space.
    distance : float
        From the camera to the target.
    azimuth, elevation : float
        Radians. Azimuth turns about ``up``; elevation is the angle above the horizon.
    up : (3,) tuple of float
        The world's up direction.
    yfov : float
        Vertical field of view in radians. An orthographic view shows, at the target, what a
        perspective one would.
    orthographic : bool
        Whether the projection is parallel.
    """

    target: np.ndarray
    distance: float
    azimuth: float = DEFAULT_AZIMUTH
    elevation: float = DEFAULT_ELEVATION
    up: tuple[float, float, float] = UP_DIRECTIONS["+Y"]
    yfov: float = DEFAULT_YFOV
    orthographic: bool = False

    def copy(self) -> Viewpoint:
        """Return an independent copy."""
        return replace(self, target=self.target.copy())

    def rotation(self) -> np.ndarray:
        """Return the camera's axes in world space: (3, 3), columns right, up and back."""
        return orbit_axes(self.up, self.azimuth, self.elevation)

    def position(self) -> np.ndarray:
        """Return where the camera stands, (3,), in world space."""
        return self.target + self.rotation()[:, 2] * self.distance

    def eye(self) -> np.ndarray:
        """Return the camera's place and 1; if orthographic, the direction to it and 0."""
        back = self.rotation()[:, 2]
        return np.array([*back, 0.0]) if self.orthographic else np.array([*self.position(), 1.0])

    def pose(self) -> np.ndarray:
        """Return the camera's pose, ``world_from_view``, (4, 4) float64."""
        pose = np.eye(4)
        pose[:3, :3] = self.rotation()
        pose[:3, 3] = self.position()
        return pose

    def camera(
        self, bounds: Sphere, nearest: float = math.inf, free: float = 0.0
    ) -> PerspectiveCamera | OrthographicCamera:
        """Return a camera whose clip planes enclose ``bounds`` as seen from here.

        From inside, the near plane is at ``nearest`` or nearer, but not nearer than ``free``.
        """
        znear, zfar = clip_planes(self.position(), bounds, nearest, free)
        if self.orthographic:
            ymag = self.distance * math.tan(self.yfov / 2)
            return OrthographicCamera(ymag, znear=-zfar, zfar=zfar)  # what is behind shows too
        return PerspectiveCamera(self.yfov, znear=znear, zfar=zfar)

    def frame(self, points: np.ndarray, aspect: float = 1.0) -> None:
        """Look at the middle of ``points`` from as near as all of them show.

        The target moves along the up direction only, to where the camera comes nearest: so it stays
        on the axis through the middle, and turning about the axis does not move the scene sideways.

        Parameters
        ----------
        points : (N, 3) ndarray of float64
            What must be visible, in world space.
        aspect : float
            Width over height of the picture.
        """
        low, high = points.min(axis=0), points.max(axis=0)
        middle = (low + high) / 2
        up = home_axes(self.up)[1]
        axes = self.rotation().T
        support, slopes = support_of_points(points), self._slopes(aspect)
        edges = frustum_reach(support, axes, middle, *slopes)
        # A step of the target upward, as it moves on the screen and towards the camera.
        rise, approach = _dot(up, axes[1]), _dot(up, axes[2])
        half = _dot(high - low, np.abs(up)) / 2
        height = max(-half, min(half, edges.y / rise)) if rise > STEEPEST else 0.0
        y = height * rise
        side = max(edges.right, edges.left) / slopes[0]
        distance = max(side, (edges.top - y) / slopes[1], (edges.bottom + y) / slopes[1])
        right, left, top, bottom = self._sides(support, middle)
        parallel = max(right / slopes[0], left / slopes[0], (top - y) / slopes[1])
        parallel = max(parallel, (bottom + y) / slopes[1])
        self.target = middle + up * height
        self.distance = FRAMING_MARGIN * max(distance - height * approach, parallel) or 1.0

    def frame_beside(self, points: np.ndarray, aspect: float, taken: Taken) -> None:
        """Like `frame`, in the free part; the target stays on the axis that views turn about."""
        if taken == NOTHING:
            self.frame(points, aspect)
            return
        slope, (width, height) = math.tan(self.yfov / 2), taken.around_middle
        narrow = replace(self, yfov=2.0 * math.atan(slope * height))
        narrow.frame(points, aspect * width / height)
        self.target, self.distance = narrow.target, narrow.distance
        rise = float(linalg.dot(np.array(self.up), self.rotation()[:, 1]))
        self.target -= np.array(self.up) * (taken.bottom * slope * self.distance * rise)

    def fit(
        self, support: SupportFunction, center: np.ndarray, aspect: float, taken: Taken = NOTHING
    ) -> None:
        """Show something as large as possible, as it stands and from this direction.

        Parameters
        ----------
        support : callable
            What to show; see `engine3d.rendering.support_functions`.
        center : (3,) ndarray of float64
            About the middle of it.
        aspect : float
            Width over height of the picture.
        taken : Taken
            What of the picture is for other things.
        """
        axes, slopes = self.rotation().T, self._slopes(aspect)
        shift, slopes = taken.shift(slopes), taken.narrowed(slopes)
        if self.orthographic:
            right, left, top, bottom = self._sides(support, center)
            x, y = (right - left) / 2, (top - bottom) / 2
            distance = max((right + left) / slopes[0], (top + bottom) / slopes[1]) / 2
        else:
            seen = sheared(support, axes, center, shift)
            x, y, distance, _ = fit_frustum(seen, axes, center, *slopes)
        self.distance = FRAMING_MARGIN * distance or 1.0
        x, y = x + shift[0] * self.distance, y + shift[1] * self.distance
        self.target = center + axes[0] * x + axes[1] * y

    def stretch(self, aspect: float) -> float:
        """Return how many times farther away the corner of a picture's plane is than its middle."""
        across, upward = self._slopes(aspect)
        return math.sqrt(1.0 + across * across + upward * upward)

    def _slopes(self, aspect: float) -> tuple[float, float]:
        slope = math.tan(self.yfov / 2)
        return slope * aspect, slope

    def _sides(
        self, support: SupportFunction, center: np.ndarray
    ) -> tuple[float, float, float, float]:
        """Return the extents to the right, left, top and bottom of ``center``."""
        right, up, _ = self.rotation().T
        directions = np.array([right, -right, up, -up])
        return tuple((support(directions) - linalg.dot(directions, center)).tolist())

    def sees(self, sphere: Sphere, aspect: float) -> bool:
        """Return whether a sphere reaches into the picture, and is more than a dot there."""
        right, up, back = linalg.dot(self.rotation().T, np.subtract(sphere.center, self.position()))
        slopes, ahead = self._slopes(aspect), -float(back)
        if self.orthographic:
            ahead = self.distance
        if ahead + sphere.radius <= 0.0:
            return False
        for aside, slope in ((abs(float(right)), slopes[0]), (abs(float(up)), slopes[1])):
            # The distance of the sphere's middle outside the frustum's side.
            if aside - ahead * slope > sphere.radius * math.sqrt(1.0 + slope * slope):
                return False
        return sphere.radius > SMALLEST * slopes[1] * max(ahead, sphere.radius)

    def look_from(self, position: ArrayLike, focal_point: ArrayLike) -> None:
        """Stand at ``position`` and look at ``focal_point`` (both (3,), world space)."""
        position = np.asarray(position, dtype=np.float64)
        with np.errstate(over="ignore"):
            offset = position - np.asarray(focal_point, dtype=np.float64)
            distance = float(linalg.length(offset))
        if not distance < math.inf:
            raise InvalidArgumentError("the camera's position and focal point are too far apart")
        if distance == 0.0:
            raise InvalidArgumentError("the camera's position and focal point are the same")
        right, up, front = home_axes(self.up)
        self.target = position - offset
        self.distance = distance
        self.elevation = math.asin(max(-1.0, min(1.0, _dot(offset, up) / distance)))
        self.azimuth = math.atan2(_dot(offset, right), _dot(offset, front))


def look_through(view: Viewpoint, node: Node, bounds: Sphere) -> None:
    """Stand where a node's camera stands, look where it looks, and turn about what is there.

    Up stays up where the camera does not roll; else its own up direction counts from now on.
    """
    pose, camera = node.world_pose, node.object
    eye, ahead = pose[:3, 3], -linalg.normalize(pose[:3, 2])
    reach = _dot(np.subtract(bounds.center, eye), ahead)
    if isinstance(camera, PerspectiveCamera):
        view.yfov = camera.yfov
    target = eye + ahead * max(reach, 0.1 * bounds.radius)
    view.look_from(eye, target)
    own = linalg.normalize(pose[:3, 1])
    if _dot(view.rotation()[:, 1], own) < ROLLS:
        view.up = tuple(own.tolist())
        view.look_from(eye, target)
    view.orthographic = isinstance(camera, OrthographicCamera)
    if isinstance(camera, OrthographicCamera):
        view.distance = camera.ymag / math.tan(view.yfov / 2)


def clip_planes(
    position: ArrayLike, bounds: Sphere, nearest: float = math.inf, free: float = 0.0
) -> tuple[float, float]:
    """Return the near and far distances that enclose ``bounds`` as seen from ``position``."""
    offset = np.asarray(position, dtype=np.float64) - np.array(bounds.center)
    distance = float(linalg.length(offset))
    zfar = (distance + bounds.radius) * 1.01
    znear = max((distance - bounds.radius) * 0.99, min(zfar * 5e-4, nearest), min(free, zfar * 0.5))
    return znear, zfar


def with_clip_planes(
    camera: PerspectiveCamera | OrthographicCamera, near: float | None, far: float | None
) -> PerspectiveCamera | OrthographicCamera:
    """Return a camera with other clip planes where they are given, at distances from it.

    Raises
    ------
    InvalidArgumentError
        The far one would not be behind the near one.
    """
    if near is None and far is None:
        return camera
    near, far = camera.znear if near is None else near, camera.zfar if far is None else far
    if near >= far:
        raise InvalidArgumentError(
            f"the near plane ({near:g}) must be nearer than the far one ({far:g})"
        )
    if isinstance(camera, OrthographicCamera):
        return OrthographicCamera(camera.ymag, znear=near, zfar=far)
    return PerspectiveCamera(camera.yfov, znear=near, zfar=far)


def _dot(a: np.ndarray, b: np.ndarray) -> float:
    return float(linalg.dot(a, b))

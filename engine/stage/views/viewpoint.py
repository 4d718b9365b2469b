"""A camera placed around a target, for the orbit controller and the command line.

In: a target, a distance, two angles and an up direction (world space, radians).
Out: a camera with clip planes that enclose the scene, and its 4x4 pose (``world_from_view``).
Invariants: the elevation is within a quarter turn of the horizon, the distance above zero. The pose
is computed from the angles: see `engine3d.model.scene.orbiting`.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from ...errors import InvalidArgumentError
from ...model.scene.cameras import IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from ...model.scene.lenses.lens_camera import LensCamera
from ...model.scene.nodes import Node
from ...model.scene.orbiting import home_axes, orbit_axes
from ...rendering.framing import LENS, fit_frustum, frustum_reach
from ...rendering.support_functions import SupportFunction, support_of_points
from .free_region import NOTHING, Taken, sheared

#: The cameras of views.
ViewCamera: TypeAlias = PerspectiveCamera | OrthographicCamera | LensCamera | IntrinsicsCamera
Lens = TypeVar("Lens", PerspectiveCamera, OrthographicCamera, ViewCamera)
#: Values of ``up``, as on the command line.
UP_DIRECTIONS = {
    "+X": (1.0, 0.0, 0.0),
    "-X": (-1.0, 0.0, 0.0),
    "+Y": (0.0, 1.0, 0.0),
    "-Y": (0.0, -1.0, 0.0),
    "+Z": (0.0, 0.0, 1.0),
    "-Z": (0.0, 0.0, -1.0),
}
#: The vertical field of view in scenes to walk in.
WALKING_YFOV = math.radians(35.0)
#: Three-quarter view from the right and slightly above: shows three sides of most models.
DEFAULT_AZIMUTH = math.radians(30.0)
DEFAULT_ELEVATION = math.radians(18.0)
QUARTER_TURN = math.pi / 2
#: Margin factor around framed scenes.
FRAMING_MARGIN = 1.06
#: Objects smaller than this fraction of the picture's height count as dots.
SMALLEST = 0.01
#: A camera rolls if its up direction deviates from the world's by more than this cosine.
ROLLS = 1.0 - 1e-9
#: Steeper than this from above or below, an upward step is hardly visible.
STEEPEST = 1e-6
_DIAGONAL = math.sqrt(3.0)  # of a cube, over its edge


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
        Vertical field of view in radians. An orthographic view shows the same extent at the target
        as a perspective one.
    orthographic : bool
        Whether the projection is parallel.
    lens : LensCamera, IntrinsicsCamera or None
        What to look through instead; `yfov` still decides where the camera stands.
    """

    target: np.ndarray
    distance: float
    azimuth: float = DEFAULT_AZIMUTH
    elevation: float = DEFAULT_ELEVATION
    up: tuple[float, float, float] = UP_DIRECTIONS["+Y"]
    yfov: float = LENS
    orthographic: bool = False
    lens: LensCamera | IntrinsicsCamera | None = None

    def copy(self) -> Viewpoint:
        """Return an independent copy."""
        return replace(self, target=self.target.copy())

    def rotation(self) -> np.ndarray:
        """Return the camera's axes in world space: (3, 3), columns right, up and back."""
        angles = self.azimuth + 0.0, self.elevation + 0.0  # never -0.0, which a cache takes for 0.0
        return _axes(tuple(side + 0.0 for side in self.up), *angles).copy()

    def position(self) -> np.ndarray:
        """Return the camera's position, (3,), in world space."""
        return self.target + self.rotation()[:, 2] * self.distance

    def eye(self) -> np.ndarray:
        """Return the camera's position and 1; if orthographic, the direction to it and 0."""
        back = self.rotation()[:, 2]
        return np.array([*back, 0.0]) if self.orthographic else np.array([*self.position(), 1.0])

    def pose(self) -> np.ndarray:
        """Return the camera's pose, ``world_from_view``, (4, 4) float64."""
        pose = np.eye(4)
        pose[:3, :3] = self.rotation()
        pose[:3, 3] = self.position()
        return pose

    def camera(self, bounds: Sphere, nearest: float = math.inf, free: float = 0.0) -> ViewCamera:
        """Return a camera whose clip planes enclose ``bounds`` as seen from here.

        Inside the scene, the near plane is at most at ``nearest``, but no nearer than ``free``.
        """
        znear, zfar = clip_planes(self.position(), bounds, nearest, free)
        if self.lens is not None:  # along the axes of a cube, what is near is nearer
            return with_clip_planes(self.lens, znear / _DIAGONAL, zfar)
        if self.orthographic:
            ymag = self.distance * math.tan(self.yfov / 2)
            # points behind the camera show too
            return OrthographicCamera(ymag, znear=-zfar, zfar=zfar)
        return PerspectiveCamera(self.yfov, znear=znear, zfar=zfar)

    def frame(self, points: np.ndarray, aspect: float = 1.0) -> None:
        """Look at the middle of ``points`` from the smallest distance that shows them all.

        The target moves only along the up direction, to where the camera can be nearest: so it
        stays on the axis through the middle, and turning about the axis does not move the scene
        sideways.

        Parameters
        ----------
        points : (N, 3) ndarray of float64
            Points that must be visible, in world space.
        aspect : float
            Width over height of the picture.
        """
        low, high = points.min(axis=0), points.max(axis=0)
        middle = (low + high) / 2
        up = home_axes(self.up)[1]
        axes = self.rotation().T
        support, slopes = support_of_points(points), self._slopes(aspect)
        edges = frustum_reach(support, axes, middle, *slopes)
        # The effect of moving the target upward: on the screen, and towards the camera.
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
        """Frame points in the free part of the picture; the target stays on the turning axis."""
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
        """Show a subject as large as possible, in its current pose from this direction.

        Parameters
        ----------
        support : callable
            The subject; see `engine3d.rendering.support_functions`.
        center : (3,) ndarray of float64
            Its approximate centre.
        aspect : float
            Width over height of the picture.
        taken : Taken
            The part of the picture that is not free.
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
        """Return the distance of a picture plane's corner relative to that of its centre."""
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
        """Return whether a sphere is in the picture and larger than a dot."""
        right, up, back = linalg.dot(self.rotation().T, np.subtract(sphere.center, self.position()))
        slopes, ahead = self._slopes(aspect), -float(back)
        if self.orthographic:
            ahead = self.distance
        if ahead + sphere.radius <= 0.0:
            return False
        for aside, slope in ((abs(float(right)), slopes[0]), (abs(float(up)), slopes[1])):
            # Compares the distance of the sphere's centre from the frustum's side.
            if aside - ahead * slope > sphere.radius * math.sqrt(1.0 + slope * slope):
                return False
        return sphere.radius > SMALLEST * slopes[1] * max(ahead, sphere.radius)

    def look_from(self, position: ArrayLike, focal_point: ArrayLike) -> None:
        """Move to ``position`` and look at ``focal_point`` (both (3,), world space)."""
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
    """Take the pose of a node's camera, and orbit around the subject in front of it.

    The up direction is kept if the camera does not roll; otherwise the camera's replaces it.
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
    view.lens = camera if isinstance(camera, LensCamera | IntrinsicsCamera) else None
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


def with_clip_planes(camera: Lens, near: float | None, far: float | None) -> Lens:
    """Return a camera with given clip planes, at distances from it; None keeps its own.

    Raises
    ------
    InvalidArgumentError
        The far plane would not be behind the near plane.
    """
    if near is None and far is None:
        return camera
    near, far = camera.znear if near is None else near, camera.zfar if far is None else far
    if near >= far:
        raise InvalidArgumentError(
            f"the near plane ({near:g}) must be nearer than the far one ({far:g})"
        )
    other = copy.copy(camera)
    other.znear, other.zfar = near, far
    return other


def _dot(a: np.ndarray, b: np.ndarray) -> float:
    return float(linalg.dot(a, b))


@lru_cache(maxsize=16)
def _axes(up: tuple[float, ...], azimuth: float, elevation: float) -> np.ndarray:
    """Remember the axes: a frame of a window asks for them again and again."""
    return orbit_axes(up, azimuth, elevation)

"""A camera placed around a target: what the orbit controller turns and the command line sets.

In: a target, a distance, two angles and an up direction (world space, radians).
Out: a camera with clip planes that enclose the scene, and its 4x4 pose (``world_from_view``).
Always holds: the elevation stays within a quarter turn of the horizon, the distance above zero.
The pose comes from the angles, not from a ``look_at``, so that straight up and down are no special
cases; sines are rounded to 14 decimals, which makes right angles exact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from .. import linalg
from ..cameras import OrthographicCamera, PerspectiveCamera
from ..errors import InvalidArgumentError
from ..instances import InstancedMesh
from ..mesh import Mesh

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
#: The near plane's distance as a share of that of the scene's middle.
NEAR_SHARE = 0.05
#: How finely `turning_outline` follows a scene.
OUTLINE_BANDS = 24
OUTLINE_ANGLES = 24
#: Each narrows the place of a minimum by a third: to a thousandth of where it began.
MINIMUM_STEPS = 18


@dataclass(frozen=True)
class Sphere:
    """A bounding sphere: ``center`` (3,) and ``radius`` > 0, in world space."""

    center: tuple[float, float, float]
    radius: float


def home_axes(up) -> np.ndarray:
    """Return the axes that azimuth and elevation are measured from.

    Parameters
    ----------
    up : (3,) sequence of float
        The up direction in world space, of any length but zero.

    Returns
    -------
    (3, 3) ndarray of float64
        Rows: right, up, and back, which is where the camera stands at azimuth zero. For +Y that is
        X, Y, Z; for +Z it is X, Z, -Y.
    """
    up = _unit(up)
    side = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.9 else np.array([0.0, 0.0, -up[0]])
    right = _unit(side - up * _dot(side, up))
    return np.array([right, up, _cross(right, up)])


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
        right, up, front = home_axes(self.up)
        sin_a, cos_a = _sine(self.azimuth), _cosine(self.azimuth)
        sin_e, cos_e = _sine(self.elevation), _cosine(self.elevation)
        outward = right * sin_a + front * cos_a
        camera_right = right * cos_a - front * sin_a
        camera_up = up * cos_e - outward * sin_e
        camera_back = outward * cos_e + up * sin_e
        return np.stack([camera_right, camera_up, camera_back], axis=1)

    def position(self) -> np.ndarray:
        """Return where the camera stands, (3,), in world space."""
        return self.target + self.rotation()[:, 2] * self.distance

    def pose(self) -> np.ndarray:
        """Return the camera's pose, ``world_from_view``, (4, 4) float64."""
        pose = np.eye(4)
        pose[:3, :3] = self.rotation()
        pose[:3, 3] = self.position()
        return pose

    def camera(self, bounds: Sphere):
        """Return a camera whose clip planes enclose ``bounds`` as seen from here."""
        znear, zfar = clip_planes(self.position(), bounds)
        if self.orthographic:
            ymag = self.distance * math.tan(self.yfov / 2)
            return OrthographicCamera(
                ymag, znear=-zfar / NEAR_SHARE / 2, zfar=zfar / NEAR_SHARE / 2
            )
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
        coordinates = self._camera_coordinates(points - middle)
        rise = self._camera_coordinates(up)

        def distance(height: float) -> float:
            return self._distance_that_shows(coordinates - rise * height, aspect)

        half = float(linalg.dot(high - low, np.abs(up))) / 2
        height = _minimum(distance, -half, half)
        self.target = middle + up * height
        self.distance = FRAMING_MARGIN * distance(height) or 1.0

    def _camera_coordinates(self, vectors: np.ndarray) -> np.ndarray:
        """Return world vectors (..., 3) along the camera's axes: right, up, back."""
        return np.stack([linalg.dot(vectors, axis) for axis in self.rotation().T], axis=-1)

    def _distance_that_shows(self, coordinates: np.ndarray, aspect: float) -> float:
        """Return the least distance that shows points (N, 3), in camera axes round the target."""
        slope = math.tan(self.yfov / 2)
        right, up = np.abs(coordinates[:, 0]), np.abs(coordinates[:, 1])
        nearer = np.maximum(coordinates[:, 2], 0.0)
        return float((np.maximum(right / aspect, up) / slope + nearer).max())

    def look_from(self, position, focal_point) -> None:
        """Stand at ``position`` and look at ``focal_point`` (both (3,), world space)."""
        position = np.asarray(position, dtype=np.float64)
        offset = position - np.asarray(focal_point, dtype=np.float64)
        distance = math.sqrt(_dot(offset, offset))
        if not distance > 0.0 or not math.isfinite(distance):
            raise InvalidArgumentError("the camera's position and focal point are the same")
        right, up, front = home_axes(self.up)
        self.target = position - offset
        self.distance = distance
        self.elevation = math.asin(max(-1.0, min(1.0, _dot(offset, up) / distance)))
        self.azimuth = math.atan2(_dot(offset, right), _dot(offset, front))


def clip_planes(position, bounds: Sphere) -> tuple[float, float]:
    """Return the near and far distances that enclose ``bounds`` as seen from ``position``.

    The near plane is nearer than it need be: wireframe edges are pulled towards the viewer by a
    constant in normalised depth, which the tightest planes would make too short a way.
    """
    offset = np.asarray(position, dtype=np.float64) - np.array(bounds.center)
    distance = math.sqrt(_dot(offset, offset))
    zfar = (distance + bounds.radius) * 1.01
    znear = max(min((distance - bounds.radius) * 0.99, distance * NEAR_SHARE), zfar * 5e-4)
    return znear, zfar


def bounding_sphere(scene) -> Sphere:
    """Return a sphere round every visible mesh of ``scene``.

    It is centred on the bounding box and reaches to the farthest vertex; instances count as their
    boxes. A scene without extent gets a sphere of radius one.
    """
    low, high = scene.bounds
    center = (low + high) / 2
    farthest = 0.0
    for points in _world_points(scene):
        offsets = points - center
        farthest = max(farthest, float(linalg.dot(offsets, offsets).max(initial=0.0)))
    return Sphere(tuple(center.tolist()), math.sqrt(farthest) or 1.0)


def turning_outline(scene, up) -> np.ndarray:
    """Return points round everything visible in ``scene``, however it turns about ``up``.

    Framing them keeps a turntable in the picture, closer than a sphere would. They lie on rings
    about the vertical axis through the middle of the scene, as wide as it is at their height.

    Parameters
    ----------
    scene : Scene
        What to go round.
    up : (3,) sequence of float
        The axis's direction.

    Returns
    -------
    (N, 3) ndarray of float64
        World space. A scene without extent gets rings of radius one.
    """
    right, up, back = home_axes(up)
    low, high = scene.bounds
    center = (low + high) / 2
    heights, squares = [np.zeros(1)], [np.zeros(1)]
    for points in _world_points(scene):
        offsets = points - center
        heights.append(linalg.dot(offsets, up))
        across, along = linalg.dot(offsets, right), linalg.dot(offsets, back)
        squares.append(across * across + along * along)
    heights, widths = np.concatenate(heights), np.sqrt(np.concatenate(squares))
    bottom, top = heights.min(), heights.max()
    if top == bottom and not widths.any():
        bottom, top, widths = -1.0, 1.0, np.ones_like(widths)
    step = (top - bottom) / OUTLINE_BANDS or 1.0
    bands = np.minimum(((heights - bottom) / step).astype(np.intp), OUTLINE_BANDS - 1)
    widest = np.zeros(OUTLINE_BANDS)
    np.maximum.at(widest, bands, widths)
    levels = bottom + step * np.arange(OUTLINE_BANDS + 1)
    # A band's ring stands at both of its ends: where in the band the scene is that wide is unknown.
    rings = [(level, max(pair)) for level, pair in zip(levels, _ends(widest), strict=True)]
    angles = [2 * math.pi * k / OUTLINE_ANGLES for k in range(OUTLINE_ANGLES)]
    circle = [right * _sine(angle) + back * _cosine(angle) for angle in angles]
    return np.array([center + up * level + spoke * w for level, w in rings for spoke in circle])


def _ends(widest: np.ndarray) -> list[tuple[float, float]]:
    """Return the widths of the bands below and above each level."""
    return list(zip([0.0, *widest], [*widest, 0.0], strict=True))


def _world_points(scene) -> Iterator[np.ndarray]:
    """Yield the finite vertices of each visible mesh, (N, 3) in world space; instances as boxes."""
    for node in scene.nodes:
        points = _outline(node) if node.shown else None
        if points is not None:
            points = linalg.transform_points(node.world_pose, points)
            yield points[np.isfinite(points).all(axis=1)]


def _outline(node) -> np.ndarray | None:
    """Return points of the node's mesh, (N, 3) in its own space, that its hull goes through."""
    shape = node.object
    if isinstance(shape, Mesh):
        return shape.positions
    if isinstance(shape, InstancedMesh):
        box = shape.bounds_in_node()
        corners = [[box[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
        return np.array(corners, dtype=np.float64)
    return None


def _minimum(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a convex function is least between two numbers, by thirds."""
    for _ in range(MINIMUM_STEPS):
        third = (high - low) / 3
        if function(low + third) <= function(high - third):
            high -= third
        else:
            low += third
    return (low + high) / 2


def _sine(angle: float) -> float:
    return round(math.sin(angle), 14)


def _cosine(angle: float) -> float:
    return round(math.cos(angle), 14)


def _dot(a, b) -> float:
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def _cross(a, b) -> np.ndarray:
    return np.array(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def _unit(vector) -> np.ndarray:
    vector = np.asarray(vector, dtype=np.float64)
    length = math.sqrt(_dot(vector, vector))
    if not length > 0.0 or not math.isfinite(length):
        raise InvalidArgumentError("an up direction must not be zero")
    return vector / length

"""Cameras of panels, and matrices between sheet pixels and the world.

In: a view, what the model reaches, the panel's rectangle and the scale. Out: a camera with its
pose, in the scene; matrices in the file's coordinates. Every sheet has the same bits everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...errors import warn
from ...model.measuring.cutting import Plane
from ...model.scene.cameras import Camera, OrthographicCamera
from ...rendering.support_functions import SupportFunction, support_of_box
from ...stage.views.viewpoint import Sphere
from .layout import Padding, Reach, Rectangle
from .views import Section, ViewSpec

#: Distance of the eye from the middle in radii, and of the far plane beyond it: the ground shadow
#: must fit.
_AWAY = 4.0
#: Maximum distance of a section plane from the model's box, in radii of the model.
_BESIDE = 0.01


class Extent(NamedTuple):
    """The extent of a model along the axes of a camera, relative to its middle.

    Attributes
    ----------
    axes : (3, 3) ndarray of float64
        Columns right, up and back, in the scene.
    middle : (3,) ndarray of float64
        In the scene: halfway between left and right, top and bottom, near and far.
    size : (3,) tuple of float
        Along right, up and back.
    """

    axes: np.ndarray
    middle: np.ndarray
    size: tuple[float, float, float]

    @property
    def reach(self) -> Reach:
        return Reach(self.size[0], self.size[1])


def find_extent(support: SupportFunction, center: np.ndarray, axes: np.ndarray) -> Extent:
    """Return the extent of a subject along the axes of a camera."""
    rows = np.ascontiguousarray(axes.T)
    directions = np.concatenate([rows, -rows])
    reach = support(directions) - linalg.dot(directions, center)
    high, low = reach[:3], -reach[3:]
    middle, half = center.copy(), (high + low) * 0.5
    for row, step in zip(rows, half, strict=True):
        middle += row * step
    size = np.maximum(high - low, 0.0)
    # A size within rounding errors counts as 0.
    size[size < 1e-12 * float(size.max())] = 0.0
    return Extent(axes, middle, (float(size[0]), float(size[1]), float(size[2])))


def find_extents(
    specs: Iterable[ViewSpec], support: SupportFunction | None, bounds: np.ndarray, up: np.ndarray
) -> list[Extent]:
    """Return the extents of a model in views; those of cameras as from the front.

    Parameters
    ----------
    specs : iterable of ViewSpec
    support : SupportFunction or None
        Of the model; by default of its box.
    bounds : (2, 3) ndarray of float64
    up : (3,) ndarray of float64
    """
    support = support_of_box((bounds[0], bounds[1])) if support is None else support
    center = (bounds[0] + bounds[1]) * 0.5
    front = ViewSpec("", angles=(0.0, 0.0))
    sights = (spec if spec.camera is None else front for spec in specs)
    return [find_extent(support, center, sight.axes(up)) for sight in sights]


def fitting_scale(extent: Extent, rectangle: Rectangle, padding: Padding) -> float:
    """Return the pixels per unit at which a view fills the panel without padding."""
    room = (
        max(rectangle.width - padding.left - padding.right, 8),
        max(rectangle.height - padding.top - padding.bottom, 8),
    )
    scales = [pixels / size for pixels, size in zip(room, extent.size[:2], strict=True) if size]
    return min(scales, default=float(min(room)))


def warn_of_misses(specs: Iterable[ViewSpec], bounds: np.ndarray, origin: Sequence[float]) -> None:
    """Name the sections whose planes miss the model; the arguments are those of `section_plane`."""
    for section in (spec.section for spec in specs if spec.kind == "section"):
        low, high = (float(corner[section.axis]) + origin[section.axis] for corner in bounds)
        place, name = section.coordinate(low, high), "xyz"[section.axis]
        if not low <= place <= high:
            warn(f"section {name}={place:.6g} cuts nothing: {name} is {low:.6g} to {high:.6g}")


def section_plane(
    section: Section, bounds: np.ndarray, radius: float, origin: Sequence[float]
) -> Plane:
    """Return the plane of a section, in the scene.

    A plane that misses the model is moved next to it: that cuts off the same, all or nothing, while
    a distant plane would exceed the camera's depth range and precision.

    Parameters
    ----------
    section : Section
    bounds : (2, 3) ndarray of float64
        Of the model, in the scene.
    radius : float
        Of the sphere round the model.
    origin : (float, float, float)
        Of the scene, in the file's coordinates.
    """
    axis = section.axis
    low, high = (float(corner[axis]) + origin[axis] for corner in bounds)
    beside = radius * _BESIDE
    coordinate = min(max(section.coordinate(low, high), low - beside), high + beside)
    return Plane(axis, coordinate - origin[axis], section.from_above)


def place_camera(
    extent: Extent, sphere: Sphere, rectangle: Rectangle, padding: Padding, scale: float
) -> tuple[OrthographicCamera, np.ndarray]:
    """Return a panel's camera and pose, with the model centred within the padding.

    Parameters
    ----------
    extent : Extent
    sphere : Sphere
        Round the model.
    rectangle : Rectangle
    padding : Padding
    scale : float
        Pixels per world unit.
    """
    right, up, back = extent.axes.T
    across = (padding.left - padding.right) * (0.5 / scale)
    down = (padding.top - padding.bottom) * (0.5 / scale)
    pose = np.eye(4)
    pose[:3, :3] = extent.axes
    away = _AWAY * max(sphere.radius, extent.size[2])
    pose[:3, 3] = extent.middle - right * across + up * down + back * away
    half_width, half_height = rectangle.width * (0.5 / scale), rectangle.height * (0.5 / scale)
    camera = OrthographicCamera(half_height, xmag=half_width, znear=0.0, zfar=2.0 * away)
    return camera, pose


def cut(
    camera: OrthographicCamera, pose: np.ndarray, axis: int, coordinate: float
) -> tuple[OrthographicCamera, np.ndarray]:
    """Return a camera with a plane of the scene as near plane, which clips nearer parts.

    Parameters
    ----------
    camera, pose
        Of a view along an axis of the scene.
    axis : int
    coordinate : float
        Of the plane, in the scene.
    """
    at_plane = pose.copy()
    at_plane[axis, 3] = coordinate
    cutting = OrthographicCamera(camera.ymag, xmag=camera.xmag, znear=0.0, zfar=camera.zfar)
    return cutting, at_plane


def cut_obliquely(
    camera: OrthographicCamera,
    pose: np.ndarray,
    rectangle: Rectangle,
    plane: Plane,
    bounds: np.ndarray,
) -> Camera:
    """Return a camera at the same pose with an oblique near plane.

    Along each line of sight, the distance from the plane grows with the depth. So that distance can
    replace depth in clip space: hidden surfaces stay the same (Lengyel, "Oblique View Frustum Depth
    Projection and Clipping", 2005).

    Parameters
    ----------
    camera, pose
        Of a parallel projection from the side from which the plane is seen.
    rectangle : Rectangle
        The panel's pixels.
    plane : Plane
    bounds : (2, 3) ndarray of float64
        What must be before the far plane.
    """
    far = bounds[0 if plane.from_above else 1, plane.axis]
    reach = abs(float(far) - plane.coordinate) * 1.01 or 1.0
    sign = -1.0 if plane.from_above else 1.0
    row = np.zeros(4)  # -1 on the plane, and 1 at the farthest bounds behind it
    row[plane.axis], row[3] = sign * 2.0 / reach, -sign * plane.coordinate * 2.0 / reach - 1.0
    projection = np.array(camera.projection((rectangle.width, rectangle.height)), np.float64)
    projection[2, :3] = linalg.dot(pose[:3, :3].T, row[:3])
    projection[2, 3] = float(linalg.dot(pose[:3, 3], row[:3])) + row[3]
    return Camera(projection)


class Matrices(NamedTuple):
    """(4, 4) float64 matrices of a panel; the world is the file's coordinates.

    Attributes
    ----------
    view_from_world, clip_from_world
    pixel_from_world
        Of a parallel projection to x, y and depth, with w = 1; of a perspective one to x times w,
        y times w, 1, and w, the depth. Pixels are the sheet's.
    world_from_pixel
        Its inverse.
    """

    view_from_world: np.ndarray
    clip_from_world: np.ndarray
    pixel_from_world: np.ndarray
    world_from_pixel: np.ndarray


def find_matrices(
    camera: Camera, pose: np.ndarray, rectangle: Rectangle, origin: tuple[float, float, float]
) -> Matrices:
    """Return the matrices of a panel.

    Parameters
    ----------
    camera, pose
        In the scene.
    rectangle : Rectangle
        The panel's pixels.
    origin : (float, float, float)
        Where the scene's origin is in the file's coordinates.
    """
    projection = np.array(camera.projection((rectangle.width, rectangle.height)), np.float64)
    shift = linalg.translation(np.negative(origin))
    view = linalg.multiply(linalg.inverse(pose), shift)
    is_parallel = is_parallel_projection(projection)
    scaled = projection if is_parallel else projection * (-1.0 / float(projection[3, 2]))
    half_width, half_height = 0.5 * rectangle.width, 0.5 * rectangle.height
    rows = np.zeros((4, 4))
    rows[0] = (scaled[0] + scaled[3]) * half_width + scaled[3] * float(rectangle.x)
    rows[1] = (scaled[3] - scaled[1]) * half_height + scaled[3] * float(rectangle.y)
    rows[2] = (0.0, 0.0, -1.0, 0.0) if is_parallel else (0.0, 0.0, 0.0, 1.0)
    rows[3] = scaled[3]
    pixel = linalg.multiply(rows, view)
    return Matrices(view, linalg.multiply(projection, view), pixel, linalg.inverse(pixel))


def is_parallel_projection(projection: np.ndarray) -> bool:
    """Return whether a (4, 4) clip_from_view is a parallel projection."""
    return bool((projection[3] == (0.0, 0.0, 0.0, 1.0)).all())

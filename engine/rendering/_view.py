"""The view of a frame: the matrices for the core, and depths along the view axis.

In: a camera, its pose (world-from-camera) and the image's size. Out: a `View`. C computes the
matrices (csrc/scene/view.c), in float64 and a fixed order of operations: the same bits everywhere.
"""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._native.scene_graph import camera_view, points_to_pixels
from ..base import linalg
from ..base.linalg import single
from ..base.linalg.vectors import as_vectors
from ..base.thread_count import resolve_threads
from ..errors import InvalidArgumentError
from ..model.scene.cameras import Camera, far_depth


class View:
    """The matrices of one camera at one pose.

    Attributes
    ----------
    camera : Camera
    projection, clip_from_world, view_from_world : (4, 4) float64
    towards_viewer : tuple of 3 float
        World-space unit vector.
    eye : tuple of 4 float
        The camera's world position and 1; without perspective the direction to the viewer and 0.
    """

    def __init__(
        self,
        camera: Camera,
        pose: np.ndarray,
        width: int,
        height: int,
        previous: View | None = None,
    ) -> None:
        self._lens = (camera, camera.version, width, height)
        if previous is not None and previous._lens == self._lens:
            projection = previous.projection  # only the pose changed
        else:
            projection = np.ascontiguousarray(camera.projection((width, height)), np.float64)
        self.projection: NDArray[np.float64] = projection
        self.camera = camera
        self._pose_bytes = pose.tobytes()
        look = camera_view(projection, pose)
        if look is None:
            raise InvalidArgumentError("the camera's pose has no inverse: it is singular")
        self.view_from_world, self.clip_from_world, self.towards_viewer, self.eye = look

    @functools.cached_property
    def rays(self) -> NDArray[np.float32]:
        """The rays of the picture's pixels in world space, as the core takes them: three vectors.

        Pixel (x, y) looks along ``rays[0] + (x + 0.5) * rays[1] + (y + 0.5) * rays[2]``.
        """
        view_from_clip = linalg.inverse(self.projection)
        if self.eye[3] == 0.0:
            rows = [np.negative(self.towards_viewer), np.zeros(3), np.zeros(3)]
        else:
            world_from_view = linalg.inverse(self.view_from_world)[:3, :3]
            right, up, _, far = view_from_clip[:3].T
            middle = view_from_clip[:3, 2] * far_depth(self.camera) + far  # on the far plane
            corner, across, down = middle - right + up, right * 2.0, up * -2.0
            _, _, width, height = self._lens
            scaled = np.stack([corner, across / width, down / height])
            scaled /= float(linalg.length(middle))
            rows = [linalg.dot(world_from_view, row) for row in scaled]
        return np.ascontiguousarray(np.stack(rows), np.float32)

    def pixels_at(self, depth: float) -> float:
        """Return how many pixels a world unit spans at a metric depth, up and down or across."""
        _, _, width, height = self._lens
        x, y = abs(float(self.projection[0, 0])), abs(float(self.projection[1, 1]))
        back = self.view_from_world[2, :3].tolist()
        most = max(x * width, y * height) / 2.0 * single.length(back)
        if self.eye[3] == 0.0:
            return most
        return most / depth if depth > 0.0 else math.inf

    def is_of(self, camera: Camera, pose: np.ndarray, width: int, height: int) -> bool:
        """Return whether the view still has this camera, pose and image."""
        return self._lens == (camera, camera.version, width, height) and (
            self._pose_bytes == pose.tobytes()
        )

    def project(
        self, points: ArrayLike, width: int, height: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Project points into the picture; see `Frame.project`."""
        points = as_vectors("points", points)
        x, y, _, w = (_rise(row, points) for row in self.clip_from_world)
        with np.errstate(all="ignore"):
            w = np.where(w > 0.0, w, np.nan)
            pixels = np.stack(
                [(x / w + 1.0) * (0.5 * width), (1.0 - y / w) * (0.5 * height)], axis=-1
            )
        return pixels, -_rise(self.view_from_world[2], points)

    def places(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the pixel positions (N, 2) of points of view space (N, 3), as `project` has them.

        NaN for points not in front of the camera. Rule: R183.
        """
        _, _, width, height = self._lens
        x, y, _, w = self.projection
        rows = np.stack([(x + w) * (0.5 * width), (w - y) * (0.5 * height), w])
        pixels = np.empty((len(points), 2))
        points_to_pixels(rows, points, pixels, resolve_threads())
        return pixels

    def directions(self, pixels: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the view-space directions (N, 3) in which a perspective camera's pixels look.

        Their lengths are arbitrary. It is the inverse of `places`.
        """
        _, _, width, height = self._lens
        view_from_clip = linalg.inverse(self.projection)
        x, y = pixels[:, :1] * (2.0 / width) - 1.0, 1.0 - pixels[:, 1:] * (2.0 / height)
        right, up, forward, middle = view_from_clip[:3].T
        middle = middle + forward * far_depth(self.camera)
        return (right * x + up * y) + middle

    def world_rays(
        self, pixels: ArrayLike, width: int, height: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the rays of places of the picture; see `Frame.rays`."""
        places = as_vectors("pixels", pixels, 2)
        across = 2.0 * places[..., :1] / width - 1.0
        upward = 1.0 - 2.0 * places[..., 1:] / height
        columns = linalg.inverse(self.clip_from_world).T
        end = far_depth(self.camera)
        near, within = (
            across * columns[0] + upward * columns[1] + (columns[2] * z + columns[3])
            for z in (-1.0, (end - 1.0) * 0.5)
        )
        near, within = near[..., :3] / near[..., 3:], within[..., :3] / within[..., 3:]
        directions = linalg.normalize(within - near)
        if self.eye[3]:
            near = np.broadcast_to(np.array(self.eye[:3]), directions.shape).copy()
        return near, directions

    def depth_range(self, bounds: np.ndarray) -> tuple[float, float]:
        """Return the range of metric depths of a world box, clipped to the camera's range."""
        sides = list(zip(*bounds.tolist(), strict=True))
        *row, rise = self.view_from_world[2].tolist()
        middle = -(single.dot(row, [(low + high) * 0.5 for low, high in sides]) + rise)
        reach = single.dot(map(abs, row), [(high - low) * 0.5 for low, high in sides])
        near, far = middle - reach, middle + reach
        nearest, farthest = self.camera.znear, self.camera.zfar
        if nearest is not None and farthest is not None:
            near, far = max(near, nearest), min(far, farthest)
        if not near < far or np.float32(near) == np.float32(far):
            near, far = middle - 0.5, middle + 0.5  # flat, or outside: any range will do
        return near, far


def _rise(row: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a row of a matrix times points with w = 1."""
    return linalg.dot(points, row[:3]) + row[3]

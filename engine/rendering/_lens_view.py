"""The view of a lens camera: where points are in its picture, and what pixels look at.

In: a camera, its pose. Out: a `View` whose matrices are those of the pinhole camera that agrees at
the middle; `project` and `ray` are the lens's own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..base import linalg
from ..base.box_corners import box_corners
from ..base.linalg.vectors import as_vectors
from ..model.scene.cameras import Camera
from ..model.scene.lenses.lens_camera import LensCamera
from ._view import View


class LensView(View):
    """The view of a lens camera at one pose."""

    camera: LensCamera

    @property
    def pose(self) -> NDArray[np.float64]:
        """The camera's pose, world-from-camera, (4, 4) float64."""
        return np.frombuffer(self._pose_bytes).reshape(4, 4).copy()

    def places(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the pixel positions (N, 2) of points of view space (N, 3); NaN if unseen."""
        _, _, width, height = self._lens
        return self.camera.project(points, (width, height))

    def directions(self, pixels: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the view-space directions (N, 3) in which pixels (N, 2) look; NaN for none."""
        _, _, width, height = self._lens
        return self.camera.rays(pixels, (width, height))

    def world_rays(
        self, pixels: ArrayLike, width: int, height: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the rays of places of the picture; see `Frame.rays`."""
        directions = self.camera.rays(pixels, (width, height))
        directions = linalg.normalize(linalg.transform_directions(self.pose, directions))
        return np.broadcast_to(self.pose[:3, 3], directions.shape).copy(), directions

    def ray(self, x: float, y: float) -> NDArray[np.float64] | None:
        """Return the world direction in which a place of the picture looks; None for nowhere."""
        _, _, width, height = self._lens
        direction = self.camera.rays((x, y), (width, height))
        if not np.isfinite(direction).all():
            return None
        return linalg.normalize(linalg.transform_directions(self.pose, direction))

    def project(
        self, points: ArrayLike, width: int, height: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Project points into the picture; see `Frame.project`."""
        points = linalg.transform_points(self.view_from_world, as_vectors("points", points))
        depth = linalg.length(points) if self.camera.depth_along == "ray" else -points[..., 2]
        return self.camera.project(points, (width, height)), depth

    def depth_range(self, bounds: np.ndarray) -> tuple[float, float]:
        """Return the range of depths of a world box, as the frame measures them."""
        if self.camera.depth_along == "axis":
            return super().depth_range(bounds)
        eye = np.array(self.eye[:3])
        gap = np.maximum(np.maximum(bounds[0] - eye, eye - bounds[1]), 0.0)
        far = float(linalg.length(box_corners(bounds) - eye).max())
        near = float(linalg.length(gap))
        return (near, far) if near < far else (near - 0.5, near + 0.5)


def view_of(
    camera: Camera, pose: np.ndarray, width: int, height: int, previous: View | None = None
) -> View:
    """Return the view of any camera."""
    kind = LensView if isinstance(camera, LensCamera) else View
    return kind(camera, pose, width, height, previous)

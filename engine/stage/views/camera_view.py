"""The view of a camera that a program gives, as stages read it.

In: a camera and its pose. Out: what a `Viewpoint` tells a stage; it cannot be moved.
"""

from __future__ import annotations

import copy
import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...model.scene.cameras import Camera
from ...model.scene.orbiting import home_axes
from .viewpoint import Viewpoint


class CameraView:
    """A camera at a pose.

    Parameters
    ----------
    camera : Camera
    pose : (4, 4) float
        world-from-camera.
    up : (3,) sequence of float
        The world's up direction.
    size : (int, int)
        Width and height of the picture.

    Attributes
    ----------
    camera : Camera
    azimuth : float
        Where the camera stands around the up direction, in radians.
    """

    def __init__(
        self, camera: Camera, pose: ArrayLike, up: ArrayLike, size: tuple[int, int]
    ) -> None:
        self.camera = camera
        self._pose = np.array(pose, np.float64)
        self._is_parallel = not np.asarray(camera.projection(size))[3, :3].any()
        right, _, front = home_axes(up)
        back = self._pose[:3, 2]
        self.azimuth = math.atan2(float(linalg.dot(back, right)), float(linalg.dot(back, front)))

    def pose(self) -> NDArray[np.float64]:
        """Return the camera's pose, ``world_from_view``, (4, 4) float64."""
        return self._pose.copy()

    def rotation(self) -> NDArray[np.float64]:
        """Return the camera's axes in world space: (3, 3), columns right, up and back."""
        return self._pose[:3, :3].copy()

    def position(self) -> NDArray[np.float64]:
        """Return the camera's position, (3,), in world space."""
        return self._pose[:3, 3].copy()

    def eye(self) -> NDArray[np.float64]:
        """Return the camera's position and 1; of parallel rays, the direction to it and 0."""
        if self._is_parallel:
            return np.array([*linalg.normalize(self._pose[:3, 2]), 0.0])
        return np.array([*self._pose[:3, 3], 1.0])

    def camera_reaching(self, farthest: float, needed: float) -> Camera:
        """Return the camera; if it shows the whole model, one whose far plane is at ``needed``.

        Parameters
        ----------
        farthest, needed : float
            Depths of the model's and the stage's farthest points, in world units.
        """
        zfar = getattr(self.camera, "zfar", None)
        if zfar is None or getattr(self.camera, "reversed_depth", False):
            return self.camera
        if not farthest <= zfar < needed:
            return self.camera
        camera: Any = copy.copy(self.camera)
        camera.zfar = needed
        return camera


#: What stages are seen from.
AnyView: TypeAlias = Viewpoint | CameraView

"""A trackball: camera poses controlled by the mouse."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ._rotations import rotation_about

_SLOW = 0.3  # fraction of the picture's shorter side per radian
_CLICK = 0.9  # remaining distance after a click of the wheel


def _shift(vector) -> NDArray[np.float64]:
    pose = np.eye(4)
    pose[:3, 3] = vector
    return pose


class Trackball:
    """Camera poses around a target.

    Parameters
    ----------
    pose : (4, 4) float
        world-from-camera at first.
    size : (float, float)
        Of the picture, in pixels.
    scale : float
        The diagonal of the scene.
    target : (3,) float
        What is turned about.
    """

    STATE_ROTATE, STATE_PAN, STATE_ROLL, STATE_ZOOM = 0, 1, 2, 3

    def __init__(self, pose, size, scale, target=(0.0, 0.0, 0.0)):
        self._size = np.array(size, np.float64)
        self._scale = float(scale)
        self._pose = self._n_pose = np.asarray(pose, np.float64)
        self._target = self._n_target = np.asarray(target, np.float64)
        self._state = Trackball.STATE_ROTATE
        self._pdown = np.zeros(2)

    @property
    def pose(self) -> NDArray[np.float64]:
        """world-from-camera, (4, 4)."""
        return self._n_pose

    def set_state(self, state: int) -> None:
        """Choose the effect of drags."""
        self._state = state

    def resize(self, size) -> None:
        """Set the size of the picture, in pixels."""
        self._size = np.array(size, np.float64)

    def down(self, point) -> None:
        """Start a drag at a pixel."""
        self._pdown = np.array(point, np.float64)
        self._pose, self._target = self._n_pose, self._n_target

    def drag(self, point) -> None:
        """Continue a drag to a pixel, y up."""
        point = np.array(point, np.float64)
        moves = {
            Trackball.STATE_ROTATE: self._rotated,
            Trackball.STATE_ROLL: self._rolled,
            Trackball.STATE_PAN: self._panned,
            Trackball.STATE_ZOOM: self._zoomed,
        }
        self._n_pose = moves[self._state](point) @ self._pose

    def _rotated(self, point) -> NDArray[np.float64]:
        dx, dy = (point - self._pdown) / (_SLOW * self._size.min())
        about_y = rotation_about(-dx, self._pose[:3, 1], self._target)
        return rotation_about(dy, self._pose[:3, 0], self._target) @ about_y

    def _rolled(self, point) -> NDArray[np.float64]:
        first, last = self._pdown - self._size / 2.0, point - self._size / 2.0
        angle = math.atan2(first[1], first[0]) - math.atan2(last[1], last[0])
        return rotation_about(angle, self._pose[:3, 2], self._target)

    def _panned(self, point) -> NDArray[np.float64]:
        dx, dy = (self._pdown - point) / (5.0 * _SLOW * self._size.min()) * self._scale
        move = dx * self._pose[:3, 0] + dy * self._pose[:3, 1]
        self._n_target = self._target + move
        return _shift(move)

    def _zoomed(self, point) -> NDArray[np.float64]:
        dy = point[1] - self._pdown[1]
        share = math.copysign(abs(dy) / (0.5 * self._size[1]), dy)
        ratio = math.expm1(share) if dy > 0 else -math.expm1(share)
        radius = np.linalg.norm(self._pose[:3, 3] - self._target)
        return _shift(-np.sign(dy) * ratio * radius * self._pose[:3, 2])

    def scroll(self, clicks: int) -> None:
        """Move nearer by some clicks of a wheel."""
        self._n_pose = self._scrolled(self._n_pose, clicks)
        self._pose = self._scrolled(self._pose, clicks)

    def _scrolled(self, pose, clicks) -> NDArray[np.float64]:
        radius = np.linalg.norm(pose[:3, 3] - self._target)
        return _shift((_CLICK**clicks - 1.0) * radius * pose[:3, 2]) @ pose

    def rotate(self, azimuth: float, axis=None) -> None:
        """Rotate about an axis, or about the camera's up direction."""
        self._n_pose = self._turned(self._n_pose, azimuth, axis)
        self._pose = self._turned(self._pose, azimuth, axis)

    def _turned(self, pose, azimuth, axis) -> NDArray[np.float64]:
        about = pose[:3, 1] if axis is None else axis
        return rotation_about(azimuth, about, self._target) @ pose


__all__ = ["Trackball"]

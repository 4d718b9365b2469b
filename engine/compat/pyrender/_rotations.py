"""Rotations as quaternions (x, y, z, w), and about axes."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray


def matrix_of(quaternion) -> NDArray[np.float64]:
    """Return the rotation of a quaternion, (3, 3); it need not have unit length."""
    x, y, z, w = np.asarray(quaternion, np.float64)
    double = 2.0 / (x * x + y * y + z * z + w * w)
    return np.array(
        [
            [1 - double * (y * y + z * z), double * (x * y - z * w), double * (x * z + y * w)],
            [double * (x * y + z * w), 1 - double * (x * x + z * z), double * (y * z - x * w)],
            [double * (x * z - y * w), double * (y * z + x * w), 1 - double * (x * x + y * y)],
        ]
    )


def quaternion_of(matrix) -> NDArray[np.float64]:
    """Return the quaternion of a rotation, (4,), w not negative (Shepperd 1978)."""
    m = np.asarray(matrix, np.float64)
    squares = np.array([*(2 * np.diag(m) - np.trace(m)), np.trace(m)])  # of 4 v² - 1
    largest = int(np.argmax(squares))
    skew = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    quaternion = np.empty(4)
    if largest == 3:
        quaternion[:3], quaternion[3] = skew, 1.0 + squares[3]
    else:
        quaternion[:3] = m[largest] + m[:, largest]
        quaternion[largest], quaternion[3] = 1.0 + squares[largest], skew[largest]
    quaternion /= np.linalg.norm(quaternion)
    return -quaternion if quaternion[3] < 0 else quaternion


def rotation_about(angle: float, axis, point) -> NDArray[np.float64]:
    """Return the rotation by an angle about an axis through a point, (4, 4)."""
    axis = np.asarray(axis, np.float64) / np.linalg.norm(axis)
    half = 0.5 * angle
    pose = np.eye(4)
    pose[:3, :3] = matrix_of([*(axis * math.sin(half)), math.cos(half)])
    pose[:3, 3] = point - pose[:3, :3] @ np.asarray(point, np.float64)
    return pose

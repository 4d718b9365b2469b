"""Parts of instance poses, as EXT_mesh_gpu_instancing needs them.

In: matrices. Out: translations, quaternions, scales, and whether they reproduce the poses.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....base import linalg


class PoseParts(NamedTuple):
    """The parts of poses.

    Attributes
    ----------
    translations : (N, 3) float64
    rotations : (N, 4) float64
        Unit quaternions x, y, z, w.
    scales : (N, 3) float64
    """

    translations: np.ndarray
    rotations: np.ndarray
    scales: np.ndarray


def parts_of_poses(poses: np.ndarray) -> PoseParts:
    """Split poses (N, 4, 4); a reflection becomes a negative scale along x, shear is lost."""
    axes = poses[:, :3, :3].transpose(0, 2, 1)
    scales = linalg.length(axes)
    x, y, z = axes.transpose(1, 0, 2)
    scales[linalg.dot(linalg.cross(x, y), z) < 0.0, 0] *= -1.0
    turned = poses[:, :3, :3] / np.where(scales == 0.0, 1.0, scales)[:, np.newaxis, :]
    return PoseParts(poses[:, :3, 3].copy(), _quaternions(turned), scales)


def are_sheared(poses: np.ndarray, parts: PoseParts) -> bool:
    """Return whether any pose differs from its parts."""
    composed = linalg.quaternion_to_matrix(parts.rotations)[:, :3, :3]
    composed = composed * parts.scales[:, np.newaxis, :]
    apart = np.abs(composed - poses[:, :3, :3]).max(axis=(1, 2), initial=0.0)
    return bool((apart > 1e-5 * np.abs(poses[:, :3, :3]).max(axis=(1, 2), initial=1e-30)).any())


def _quaternions(m: np.ndarray) -> np.ndarray:
    """Return the quaternions of rotations (N, 3, 3), by the largest of their components."""
    diagonal = m[:, (0, 1, 2), (0, 1, 2)]
    trace = diagonal[:, 0] + diagonal[:, 1] + diagonal[:, 2]
    largest = np.concatenate([diagonal, trace[:, np.newaxis]], axis=1).argmax(axis=1)
    found = np.empty((len(m), 4))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        rows = m[largest == k]
        found[largest == k, k] = 1.0 + rows[:, k, k] - rows[:, i, i] - rows[:, j, j]
        found[largest == k, i] = rows[:, i, k] + rows[:, k, i]
        found[largest == k, j] = rows[:, j, k] + rows[:, k, j]
        found[largest == k, 3] = rows[:, j, i] - rows[:, i, j]
    rows = m[largest == 3]
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        found[largest == 3, k] = rows[:, j, i] - rows[:, i, j]
    found[largest == 3, 3] = 1.0 + trace[largest == 3]
    found /= np.sqrt((found * found).sum(axis=1, keepdims=True))
    found[found[:, 3] < 0.0] *= -1.0
    return found

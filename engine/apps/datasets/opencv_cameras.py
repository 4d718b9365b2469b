"""Conversion of cameras and poses to OpenCV's and BOP's conventions.

In: our cameras, which look along -Z with +Y up. Out: the matrix K, and poses for a camera that
looks along +Z with +Y down. Pixel coordinates start at the centre of the top left pixel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera
from ...model.scene.lenses.lens_camera import LensCamera

_FLIP = np.diag([1.0, -1.0, -1.0, 1.0])
_ROUNDING = 1e-6


def cv_from_camera(pose: ArrayLike) -> NDArray[np.float64]:
    """Return camera-from-world of a camera that looks along +Z with +Y down, (4, 4).

    Parameters
    ----------
    pose : (4, 4) float
        world-from-camera of one of ours.
    """
    return linalg.multiply(_FLIP, linalg.inverse(pose))


def intrinsics_of(camera: Camera, width: int, height: int) -> list[float]:
    """Return the matrix K of a camera and a picture, row by row: nine numbers.

    Raises
    ------
    InvalidArgumentError
        It has no perspective, or a lens.
    """
    if isinstance(camera, LensCamera):
        raise InvalidArgumentError(
            f"a {type(camera).__name__} has no matrix K alone: BOP's pictures are those of pinhole "
            "cameras"
        )
    matrix = np.asarray(camera.projection((width, height)), np.float64)
    scale = -float(matrix[3, 2])
    if scale <= 0.0 or matrix[3, [0, 1, 3]].any() or matrix[:2, 3].any():
        raise InvalidArgumentError("the camera has no perspective: it has no matrix K")
    (xx, xy, xz), (yx, yy, yz) = (matrix[:2, :3] / scale).tolist()
    across, down = 0.5 * width, 0.5 * height
    return [
        *(xx * across, 0.0 - xy * across, (1.0 - xz) * across - 0.5),
        *(0.0 - yx * down, yy * down, (1.0 + yz) * down - 0.5),
        *(0.0, 0.0, 1.0),
    ]


def rigid_parts(
    pose: NDArray[np.float64], scale: float, what: str
) -> tuple[list[float], list[float]]:
    """Return a pose's rotation, row by row, and its translation times a scale.

    Raises
    ------
    InvalidArgumentError
        It is no rotation: what is posed is scaled or mirrored.
    """
    axes = pose[:3, :3]
    lengths = linalg.length(axes.T)
    turned = float(linalg.dot(linalg.cross(axes[:, 0], axes[:, 1]), axes[:, 2]))
    if np.abs(lengths - 1.0).max() > _ROUNDING or abs(turned - 1.0) > 4 * _ROUNDING:
        raise InvalidArgumentError(
            f"{what} is scaled or mirrored, and BOP's poses are rotations: scale the mesh instead"
        )
    return axes.ravel().tolist(), (pose[:3, 3] * scale).tolist()

"""Scans of LiDARs: points with what is known of each.

In: the returns of a scan. Out: arrays with a row for each, pictures with a pixel for each beam, and
files.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from ...base.calls import checks_types
from ...base.validation import choose
from .cloud_files import save_cloud

#: What `LidarScan.image` shows.
ScanImage = Literal["range", "intensity", "incidence", "object_id", "instance_id", "face_id"]
_IMAGES: tuple[ScanImage, ...] = get_args(ScanImage)


@dataclass(frozen=True, kw_only=True)
class LidarScan:
    """The returns of a scan, one row each, in the order of time, then ring.

    Attributes
    ----------
    shape : (int, int)
        Rings and columns of the sensor, returns or not.
    points : (N, 3) float32
        In the sensor's space when the beam was sent: x forward, y left, z up. World units.
    world_points : (N, 3) float64
        World space.
    range : (N,) float32
        Distance along the beam, in world units.
    intensity : (N,) float32
        Reflectance times ``incidence``, from 0 to 1. The reflectance is the mean of red, green and
        blue of the base colour in linear light. It does not fall off with distance.
    incidence : (N,) float32
        Cosine of the angle between beam and surface normal: 1 where the beam is perpendicular.
    normal : (N, 3) float32
        World space; the unit normal of the face's front.
    ring, column : (N,) int32
        The beam; ring 0 is the lowest of the patterns of `Lidar.of`.
    time : (N,) float32
        Seconds since the start of the scan.
    object_id, instance_id, face_id : (N,) int32
        As of frames.
    """

    shape: tuple[int, int]
    points: NDArray[np.float32]
    world_points: NDArray[np.float64]
    range: NDArray[np.float32]
    intensity: NDArray[np.float32]
    incidence: NDArray[np.float32]
    normal: NDArray[np.float32]
    ring: NDArray[np.int32]
    column: NDArray[np.int32]
    time: NDArray[np.float32]
    object_id: NDArray[np.int32]
    instance_id: NDArray[np.int32]
    face_id: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.points)

    @checks_types
    def image(self, name: ScanImage = "range") -> NDArray[np.float32] | NDArray[np.int32]:
        """Return values as a picture with a pixel for each beam, the highest ring on top.

        Parameters
        ----------
        name : {"range", "intensity", "incidence", "object_id", "instance_id", "face_id"}

        Returns
        -------
        (rings, columns) float32 or int32
            0 where there is no return; -1 of IDs.
        """
        values = getattr(self, choose(name, _IMAGES, "name"))
        picture = np.full(self.shape, -1 if name.endswith("_id") else 0, values.dtype)
        picture[self.shape[0] - 1 - self.ring, self.column] = values
        return picture

    @checks_types
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the points to a file, whole or not at all.

        Parameters
        ----------
        path : path-like
            The suffix decides the format: .pcd (PCL, binary), .ply (binary), .bin (KITTI's
            Velodyne: x, y, z and intensity as float32, nothing else), or .npz (all arrays).

        Raises
        ------
        InvalidArgumentError, FileAccessError
        """
        save_cloud(path, {name: value for name, value in vars(self).items() if name != "shape"})

    def __repr__(self) -> str:
        return f"<LidarScan of {len(self)} points>"

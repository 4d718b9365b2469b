"""Sensors of robots: optical flow, stereo cameras and LiDARs, and files of what they measure.

`Moment` keeps what a frame shows while the scene moves on, for optical flow; `StereoCamera` draws
rectified pairs with disparities; `Lidar` measures distances along beams.
"""

from ...io.output.value_files import save_values
from .flow import Flow
from .lidar import Lidar
from .moments import Moment
from .scans import LidarScan
from .stereo import StereoCamera, StereoPair

__all__ = [
    "Flow",
    "Lidar",
    "LidarScan",
    "Moment",
    "StereoCamera",
    "StereoPair",
    "save_values",
]

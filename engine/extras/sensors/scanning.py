"""How a LiDAR measures: the motion of the sensor, its rays, and what they tell.

In: a `Lidar`, a scene, the sensor's poses at the start and end. Out: a `LidarScan` (R186).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.validation import matrix4, whole_number
from ...errors import InvalidArgumentError
from ...model.motion.interpolation import straight, turns
from ...model.scene.scene import Scene
from ...model.spatial.rays import RayHits
from .reflectance import reflectances_of
from .scans import LidarScan

if TYPE_CHECKING:
    from .lidar import Lidar

# A sensor's axes are x forward, y left, z up; those of its node are as a camera's.
_NODE_FROM_SENSOR = np.array(
    [(0.0, -1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (-1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)]
)
_ROUNDING = 1e-6
_ULP = 2.0**-53


class Motion(NamedTuple):
    """World-from-sensor at the start and at the end of a scan, in the sensor's own axes."""

    start: NDArray[np.float64]
    end: NDArray[np.float64]

    def at(self, shares: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return origins and rotations at shares (N,) of the way: one, or N of each."""
        if np.array_equal(self.start, self.end):
            return self.start[:3, 3], self.start[:3, :3]
        moments, rows = np.unique(shares, return_inverse=True)
        ways = turns(*(linalg.matrix_to_quaternion(one)[np.newaxis] for one in self))
        quaternions = ways.rows(np.zeros(len(moments), np.intp)).at(moments)
        begin, end = (one[np.newaxis, :3, 3] for one in self)
        places = straight(begin, end, moments)
        return places[rows], linalg.quaternion_to_matrix(quaternions)[rows, :3, :3]


def start_and_end(pose: ArrayLike, end_pose: ArrayLike | None) -> Motion:
    """Return the motion between two poses of a sensor's node.

    Raises
    ------
    InvalidArgumentError
        One is scaled or mirrored.
    """
    start = _rigid(pose, "pose")
    return Motion(start, start if end_pose is None else _rigid(end_pose, "end_pose"))


def _rigid(pose: ArrayLike, what: str) -> NDArray[np.float64]:
    matrix = matrix4(pose, what)
    axes = matrix[:3, :3]
    turned = float(linalg.dot(linalg.cross(axes[:, 0], axes[:, 1]), axes[:, 2]))
    if np.abs(linalg.length(axes.T) - 1.0).max() > _ROUNDING or abs(turned - 1.0) > 4 * _ROUNDING:
        raise InvalidArgumentError(f"{what} is scaled or mirrored: a sensor only turns and moves")
    return linalg.multiply(matrix, _NODE_FROM_SENSOR)


def measured(lidar: Lidar, scene: Scene, motion: Motion, dropout: float, seed: int) -> LidarScan:
    """Return the scan of a scene: see `Lidar.scan`."""
    rays, times = lidar.directions.reshape(-1, 3), lidar.times.reshape(-1)
    origins, rotations = motion.at(np.minimum(times / lidar.duration, 1.0))
    directions = linalg.dot(rotations, rays[:, np.newaxis, :])
    hits = scene.raycast_many(origins, directions, max_distance=lidar.max_range)
    kept = (hits.object_id >= 0) & (hits.distance >= lidar.min_range)
    beams = np.flatnonzero(kept & _kept_by_chance(len(rays), dropout, seed))
    beams = beams[np.lexsort((beams // lidar.shape[1], times[beams]))]  # by time, then ring
    chosen: Any = [part[beams] for part in hits]
    met = RayHits(*chosen)
    incidence = np.abs(linalg.dot(met.normal, linalg.normalize(directions[beams])))
    rings, columns = np.divmod(beams, lidar.shape[1])
    return LidarScan(
        shape=lidar.shape,
        points=(rays[beams] * met.distance[:, np.newaxis]).astype(np.float32),
        world_points=met.position,
        range=met.distance.astype(np.float32),
        intensity=(reflectances_of(scene, met) * incidence).astype(np.float32),
        incidence=incidence.astype(np.float32),
        normal=met.normal.astype(np.float32),
        ring=rings.astype(np.int32),
        column=columns.astype(np.int32),
        time=times[beams].astype(np.float32),
        object_id=met.object_id,
        instance_id=met.instance_id,
        face_id=met.face_id,
    )


def _kept_by_chance(count: int, dropout: float, seed: int) -> NDArray[np.bool_]:
    """Return which of so many beams are not lost."""
    number = whole_number(seed, "seed", 0, 2**63 - 1)
    if dropout == 0.0:
        return np.ones(count, bool)
    words = np.asarray(np.random.Philox(key=number).random_raw(count), np.uint64)
    return (words >> np.uint64(11)) * _ULP >= dropout

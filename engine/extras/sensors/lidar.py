"""LiDARs: sensors that measure distances along beams, such as spinning ones on cars and robots.

In: a pattern of beams, a scene, the sensor's pose or its motion. Out: a `LidarScan`. Each beam is a
ray of the scene's own ray casting, in float64, so that IDs and distances are exactly those that
`Scene.raycast` finds; results are rounded once to float32: the same bits everywhere (R186).
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ...base import linalg
from ...base.angles import angles
from ...base.calls import checks_types
from ...base.image_size import check_size
from ...base.numbers import floats, real, shown
from ...base.validation import (
    CheckedAttribute,
    Closed,
    NumberAttribute,
    choose,
    fraction,
    positive,
    whole_number,
)
from ...errors import InvalidArgumentError, warn
from ...model.scene.scene import Scene
from .lidar_patterns import PATTERNS
from .scanning import measured, start_and_end
from .scans import LidarScan

_MOST_BEAMS = 1 << 24


def _distance(value: float, what: str) -> float:
    number = real(value)
    if not number >= 0.0:
        raise InvalidArgumentError(f"{what} must be 0 or more, not {shown(value)}")
    return number


class Lidar(Closed):
    """A LiDAR: a pattern of beams from one point.

    `Lidar.of` has the patterns of common sensors, `Lidar.spinning` and `Lidar.raster` make others.

    Parameters
    ----------
    elevations : (rings,) or (rings, columns) float
        Radians above the sensor's horizon.
    azimuths : (columns,) or (rings, columns) float
        Radians to the left of forward.
    times : (columns,) or (rings, columns) float, optional
        Seconds after the start of the scan at which the beams are sent; by default all 0.
    duration : float
        Seconds of the whole scan, during which a moving sensor goes from one pose to the other.
    min_range, max_range : float
        World units: nearer and farther surfaces give no return. Nearer ones still hide others.

    Attributes
    ----------
    NAMES : tuple of str
        Of the sensors that `Lidar.of` knows.
    elevations, azimuths, times : (rings, columns) float64, read-only
    shape : (int, int)
        Rings and columns.
    directions : (rings, columns, 3) float64
        Unit vectors in the sensor's space: x forward, y left, z up.

    Raises
    ------
    InvalidArgumentError
    """

    NAMES: ClassVar[tuple[str, ...]] = tuple(PATTERNS)
    duration: NumberAttribute = CheckedAttribute(positive)
    min_range: NumberAttribute = CheckedAttribute(_distance)
    max_range: NumberAttribute = CheckedAttribute(_distance)

    def __init__(
        self,
        elevations: ArrayLike,
        azimuths: ArrayLike,
        *,
        times: ArrayLike | None = None,
        duration: float = 0.1,
        min_range: float = 0.0,
        max_range: float = math.inf,
    ) -> None:
        rows = angles(elevations, "elevations")
        rows = rows[:, np.newaxis] if rows.ndim == 1 else rows
        given: list[Any] = [rows, angles(azimuths, "azimuths")]
        given.append(floats(0.0 if times is None else times, "times"))
        try:
            shape = np.broadcast_shapes(*(one.shape for one in given))
        except ValueError:
            shape = ()
        if len(shape) != 2 or not 0 < math.prod(shape) <= _MOST_BEAMS:
            raise InvalidArgumentError(
                "elevations, azimuths and times must be (rings,) or (rings, columns), (columns,) "
                "or (rings, columns), at most 2**24 beams"
            )
        self._elevations, self._azimuths, self._times = (
            frozen(np.array(np.broadcast_to(one, shape), np.float64)) for one in given
        )
        for name, values in (("elevations", self._elevations), ("azimuths", self._azimuths)):
            if not np.isfinite(values).all():
                raise InvalidArgumentError(f"{name} must be finite")
        if (np.abs(self._elevations) > math.pi / 2 + 1e-9).any():
            warn("elevations lie beyond straight up or down: they are radians, see numpy.radians")
        if not (np.isfinite(self._times).all() and (self._times >= 0.0).all()):
            raise InvalidArgumentError("times must be finite, and 0 or more")
        self.duration = duration
        self.min_range, self.max_range = min_range, max_range

    @classmethod
    @checks_types
    def of(cls, name: str) -> Lidar:
        """Return the LiDAR of a common sensor, with its nominal angles, at 10 turns a second.

        Parameters
        ----------
        name : str
            One of `Lidar.NAMES`, such as ``"vlp-16"`` or ``"os1-128"``.

        Raises
        ------
        InvalidArgumentError
        """
        pattern = PATTERNS[choose(name, PATTERNS, "name")]
        return cls.spinning(
            np.array(pattern.elevations) * (math.pi / 180.0),
            pattern.steps,
            rate=pattern.rate,
            offsets=np.array(pattern.offsets or 0.0) * (-math.pi / 180.0),
            min_range=pattern.least,
            max_range=pattern.most,
        )

    @classmethod
    @checks_types
    def spinning(
        cls,
        elevations: ArrayLike,
        steps: int = 1024,
        *,
        rate: float = 10.0,
        offsets: ArrayLike = 0.0,
        min_range: float = 0.0,
        max_range: float = math.inf,
    ) -> Lidar:
        """Return a LiDAR that turns once around its axis, clockwise as seen from above.

        A scan begins and ends at the back, so that its picture shows what is in front in the
        middle, and what is to the left on the left.

        Parameters
        ----------
        elevations : (rings,) float
            Radians, a beam each.
        steps : int
            Columns.
        rate : float
            Turns a second.
        offsets : float or (rings,) float
            Radians by which the beams look to the left of their column.
        min_range, max_range : float
            As of `Lidar`.

        Raises
        ------
        InvalidArgumentError
        """
        count, duration = whole_number(steps, "steps", 1, _MOST_BEAMS), 1.0 / positive(rate, "rate")
        columns = np.arange(count) / count
        azimuths = math.pi - (2.0 * math.pi) * (columns + 0.5 / count)
        sideways = angles(offsets, "offsets")
        if sideways.ndim > 1:
            raise InvalidArgumentError("offsets must be a number, or one for each beam")
        return cls(
            elevations,
            azimuths + (sideways[:, np.newaxis] if sideways.ndim else sideways),
            times=columns * duration,
            duration=duration,
            min_range=min_range,
            max_range=max_range,
        )

    @classmethod
    @checks_types
    def raster(
        cls,
        size: tuple[int, int],
        fov: tuple[float, float],
        *,
        duration: float = 0.1,
        min_range: float = 0.0,
        max_range: float = math.inf,
    ) -> Lidar:
        """Return a solid-state LiDAR, which scans a rectangle in equal angles, row after row.

        Parameters
        ----------
        size : (int, int)
            Columns and rows of beams.
        fov : (float, float)
            Radians across and down that the outermost beams are apart.
        duration : float
            Seconds of a scan.
        min_range, max_range : float
            As of `Lidar`.

        Raises
        ------
        InvalidArgumentError
        """
        (columns, rows), spread = check_size(size), floats(fov, "fov")
        if spread.shape != (2,):
            raise InvalidArgumentError(f"fov must be two angles, not {shown(fov)}")
        across, down = (positive(one, "fov") for one in spread.tolist())
        whole = positive(duration, "duration")
        ends = np.linspace(0.5, -0.5, columns) if columns > 1 else np.zeros(1)
        heights = np.linspace(-0.5, 0.5, rows) if rows > 1 else np.zeros(1)
        order = np.arange(rows)[::-1, np.newaxis] * columns + np.arange(columns)
        return cls(
            heights * down,
            ends * across,
            times=order * (whole / (rows * columns)),
            duration=whole,
            min_range=min_range,
            max_range=max_range,
        )

    @property
    def elevations(self) -> NDArray[np.float64]:
        return self._elevations

    @property
    def azimuths(self) -> NDArray[np.float64]:
        return self._azimuths

    @property
    def times(self) -> NDArray[np.float64]:
        return self._times

    @property
    def shape(self) -> tuple[int, int]:
        rings, columns = self._elevations.shape
        return rings, columns

    @property
    def directions(self) -> NDArray[np.float64]:
        level, up = linalg.cos(self._elevations), linalg.sin(self._elevations)
        forward, left = linalg.cos(self._azimuths), linalg.sin(self._azimuths)
        return np.stack([level * forward, level * left, up], axis=-1)

    @checks_types
    def scan(
        self,
        scene: Scene,
        pose: ArrayLike,
        *,
        end_pose: ArrayLike | None = None,
        dropout: float = 0.0,
        seed: int = 0,
    ) -> LidarScan:
        """Measure a scene.

        Parameters
        ----------
        scene : Scene
            As it is now: it stands still during the scan. Rays meet the faces of visible meshes,
            from both sides; lines, points and transparency do not count.
        pose : (4, 4) float
            World-from-sensor, as of a camera: the sensor looks along the node's -Z with +Y up, as
            `look_at` makes it. Not scaled.
        end_pose : (4, 4) float, optional
            Where the sensor is at the end of the scan: between, it moves straight and turns evenly,
            and each beam starts where the sensor is at its time.
        dropout : float
            The share of returns that are lost, from 0 to 1, at random.
        seed : int
            Of what is lost: the same seed loses the same beams.

        Returns
        -------
        LidarScan

        Raises
        ------
        InvalidArgumentError
        """
        motion = start_and_end(pose, end_pose)
        return measured(self, scene, motion, fraction(dropout, "dropout"), seed)

    def __repr__(self) -> str:
        return f"<Lidar {self.shape[0]} rings x {self.shape[1]} columns>"

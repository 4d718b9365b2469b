"""The heights of a city, for the free distance around a flying viewer.

In: meshes in world space, Y up. Out: distances from a point to a column over each square of the
ground, as high as what stands there. Nothing is nearer than they are.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...extras.worlds.plan import PITCH
from ...model.geometry.mesh import Mesh

#: The overhang of things beyond the square of their corners, and of moving cars.
OVERHANG = 4.0


class Skyline:
    """The maximum heights of squares the size of a city tile.

    Parameters
    ----------
    meshes : sequence of Mesh
        None of their triangles is wider than a tile.
    """

    def __init__(self, meshes: Sequence[Mesh]) -> None:
        bounds = np.array([mesh.bounds for mesh in meshes], np.float64)
        self._low = np.floor(bounds[:, 0, [0, 2]].min(axis=0) / PITCH).astype(np.int64)
        last = np.floor(bounds[:, 1, [0, 2]].max(axis=0) / PITCH).astype(np.int64)
        self._heights = np.full(tuple(last - self._low + 1), -np.inf)
        for mesh in meshes:
            self._add(mesh)
        self._centers = [
            (np.arange(count) + low + 0.5) * PITCH
            for count, low in zip(self._heights.shape, self._low, strict=True)
        ]

    def _add(self, mesh: Mesh) -> None:
        """Raise the squares under each triangle's corners to its highest corner."""
        squares = np.floor(mesh.positions[:, [0, 2]] / np.float32(PITCH)).astype(np.int64)
        squares = np.ravel_multi_index(tuple((squares - self._low).T), self._heights.shape)
        heights = mesh.positions[:, 1][mesh.faces].max(axis=1).astype(np.float64)
        for corner in mesh.faces.T:
            np.maximum.at(self._heights.reshape(-1), squares[corner], heights)

    def clearance(self, eye: np.ndarray) -> float:
        """Return a radius of free space around ``eye``, (3,); 0 near the ground."""
        half = PITCH / 2 + OVERHANG
        aside = [
            np.maximum(np.abs(centers - eye[axis]) - half, 0.0)
            for centers, axis in zip(self._centers, (0, 2), strict=True)
        ]
        above = np.maximum(eye[1] - self._heights - OVERHANG, 0.0)
        squares = aside[0][:, np.newaxis] ** 2 + aside[1] ** 2 + above * above
        return float(np.sqrt(squares.min()))

"""What lies on a surface: points whose depth is that of the surface there.

In: the triangles of all surfaces. Out: for points, how much the surface under them rises from pixel
to pixel, and whether they lie on it. A line that lies on a surface is brought forward by so much
that its whole width shows; a line that merely passes through one is not.
"""

from __future__ import annotations

import numpy as np

from ..._native import rasterizer as _native
from ...base.thread_count import resolve_threads
from ...rendering.backend_selection import resolve_backend
from ._view import Region

_SLACK = 0.002  # of the scene's depth: what counts as the same depth everywhere
MOST_LIFT = 0.035  # of the scene's depth: how far things are brought forward at most
_AROUND = ((0, 0), (-1, 0), (1, 0), (0, -1), (0, 1))


class Surfaces:
    """Which triangle shows at each pixel, and its plane."""

    def __init__(self, region: Region, clip: np.ndarray, faces: np.ndarray) -> None:
        self._size = region.width, region.height
        shape = region.height, region.width
        self._face_id = np.empty(shape, np.int32)
        self.depth, weights = np.empty(shape, np.float32), np.empty((*shape, 3), np.float32)
        _native.rasterize(
            *(clip, np.ascontiguousarray(faces), _native.CULLS["none"]),
            *(resolve_backend(), resolve_threads(), self._face_id, self.depth, weights),
        )
        self._clip, self._faces = clip, faces

    def limited(self, rise: np.ndarray, span: float) -> np.ndarray:
        return np.minimum(rise, MOST_LIFT * span)

    def under(
        self, places: np.ndarray, span: float, looks_round: bool
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the rise of the surface at places, depth a pixel, and which lie on it.

        ``looks_round``: at neighbouring pixels as well, for what lies at the rim of its face.
        """
        rise, gap = np.zeros(len(places)), np.full(len(places), np.inf)
        width, height = self._size
        column, row = (
            np.nan_to_num(np.floor(places[:, k]), nan=-9.0, posinf=-9.0, neginf=-9.0)
            for k in (0, 1)
        )
        for right, down in _AROUND if looks_round else _AROUND[:1]:
            x, y = column + right, row + down
            inside = np.flatnonzero((x >= 0) & (x < width) & (y >= 0) & (y < height))
            face = self._face_id[y[inside].astype(int), x[inside].astype(int)]
            inside, face = inside[face >= 0], face[face >= 0]
            if not len(inside):
                continue
            steep, depth = self._planes(face, places[inside])
            apart = np.abs(places[inside, 2] - depth)
            better = apart < gap[inside]
            rise[inside[better]], gap[inside[better]] = steep[better], apart[better]
        return rise, gap <= np.minimum(rise, MOST_LIFT * span) + _SLACK * span

    def _planes(self, face: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how steep the planes of faces are, and their depths at places."""
        width, height = self._size
        corners = self._clip[self._faces[face]].astype(np.float64)
        x = (corners[..., 0] / corners[..., 3] + 1.0) * (0.5 * width)
        y = (1.0 - corners[..., 1] / corners[..., 3]) * (0.5 * height)
        z = corners[..., 2] / corners[..., 3]
        x1, x2, y1, y2 = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0], y[:, 1] - y[:, 0], y[:, 2] - y[:, 0]
        z1, z2 = z[:, 1] - z[:, 0], z[:, 2] - z[:, 0]
        area = x1 * y2 - x2 * y1
        area[area == 0.0] = 1e-30
        across, down = (z1 * y2 - z2 * y1) / area, (x1 * z2 - x2 * z1) / area
        depth = z[:, 0] + across * (places[:, 0] - x[:, 0]) + down * (places[:, 1] - y[:, 0])
        return np.abs(across) + np.abs(down), depth

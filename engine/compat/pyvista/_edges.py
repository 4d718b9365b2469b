"""Edges of faces, drawn on the faces: how much of a pixel is edge.

In: which face shows at samples, and where its corners are. Out: shares from 0 to 1. The method is
that of VTK's shader (vtkPolyDataEdgesGS.glsl): the distance of the pixel's middle from the nearest
edge of its face, on the screen.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._parts import Part
from ._renderer_view import View


def edge_shares(
    part: Part, view: View, faces: NDArray[np.int32], middles: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how much of the pixels at samples is edge, (N,) float64.

    Parameters
    ----------
    faces : (N,) int32
        The face that each sample shows.
    middles : (N, 2) float64
        The middles of the samples' pixels, y down.
    """
    shown, which = np.unique(faces, return_inverse=True)
    corners = view.pixels(part.places[part.faces[shown].reshape(-1)])[:, :2].reshape(-1, 3, 2)
    nearest = np.full(len(faces), np.inf)
    turn = _turn(corners)
    for k in range(3):
        start = corners[:, k]
        along = corners[:, (k + 1) % 3] - start
        along = along / np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-300)[:, None]
        across = np.stack([-along[:, 1], along[:, 0]], -1) * turn[:, None]
        offset = -(across * start).sum(1)
        distance = (across[which] * middles).sum(1) + offset[which]
        if part.edges is not None:
            distance = np.where(part.edges[faces, k], distance, np.inf)
        nearest = np.minimum(nearest, distance)
    return np.clip(0.5 + 0.5 * part.look.edge_width - nearest, 0.0, 1.0)


def _turn(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return 1 where corners go round in one way, and -1 in the other."""
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.where(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] >= 0.0, 1.0, -1.0)


def polygon_edges(part: Part) -> NDArray[np.int32]:
    """Return the edges of a part's polygons, each once, (E, 2) int32 of its vertices."""
    pairs = np.stack([part.faces, np.roll(part.faces, -1, axis=1)], -1)
    pairs = pairs[part.edges] if part.edges is not None else pairs.reshape(-1, 2)
    return np.unique(np.sort(pairs, axis=1), axis=0)

"""Normals of faces, found only where faces show.

In: which face shows at samples. Out: its normal, towards the camera.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ._parts import Part
from ._renderer_view import View


def facet_normals(
    part: Part, faces: NDArray[np.int32], places: NDArray[np.float64], view: View
) -> NDArray[np.float64]:
    """Return the normals at samples, (N, 3) float64, of unit length, in view space.

    Parameters
    ----------
    faces : (N,) int32
        The face that each sample shows.
    places : (N, 3) float64
        The samples, in view space.
    """
    shown, which = np.unique(faces, return_inverse=True)
    a, b, c = (part.places[part.faces[shown, k]] for k in range(3))
    across = linalg.cross(b - a, c - a)
    across /= np.maximum(np.sqrt((across * across).sum(1, keepdims=True)), 1e-300)
    normals = across[which]
    if view.is_parallel:
        away = normals[:, 2] < 0.0
    else:
        away = (normals * places).sum(1) > 0.0
    normals[away] *= -1.0
    return normals

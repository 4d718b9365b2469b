"""Shadow casters: which nodes cast shadows, and whether they have changed."""

from __future__ import annotations

import numpy as np

from .._native.rasterizer import find_casters
from ..model.scene.staged_data import NodeRows


def placed_casters(arrays: NodeRows, selection: np.ndarray | None = None) -> bytes:
    """Return a state that is equal as long as the same nodes cast shadows from the same places.

    Parameters
    ----------
    arrays : NodeArrays
    selection : (words,) uint64, optional
        A bit for each node; only these nodes count.
    """
    found = np.empty((arrays.count, 3), np.int32)
    return found[: find_casters(arrays.rows, arrays.count, selection, found)].tobytes()

"""Shadow casters: which nodes cast shadows, and whether they have changed."""

from __future__ import annotations

import numpy as np

from .._native.scene_graph import SHOWN
from ..model.scene.node_arrays import CASTS_NONE
from ..model.scene.staged_data import NodeRows


def placed_casters(arrays: NodeRows, selection: np.ndarray | None = None) -> tuple[bytes, ...]:
    """Return a state that is equal as long as the same nodes cast shadows from the same places.

    Parameters
    ----------
    arrays : NodeArrays
    selection : (words,) uint64, optional
        A bit for each node; only these nodes count.
    """
    columns, count = arrays.columns, arrays.count
    casts = columns["unshadowed"][:count] & CASTS_NONE == 0
    casts &= (columns["flags"][:count] & SHOWN != 0) & (columns["object"][:count] >= 0)
    if selection is not None:
        casts &= np.unpackbits(selection.view(np.uint8), bitorder="little")[:count] != 0
    slots = np.flatnonzero(casts)
    names = ("object", "world_version")
    return slots.tobytes(), *(columns[name][slots].tobytes() for name in names)

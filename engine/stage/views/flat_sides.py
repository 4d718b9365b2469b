"""First views that would show one flat side alone: a model is seen from another quarter then.

In: a first azimuth, and the normals that a small picture shows from any azimuth. Out: the same
azimuth, or one a quarter turn or two farther. It is only asked for models that state no material,
such as machine parts and scans, whose front means nothing.

A box shows three sides, and the largest takes about two thirds of what is seen. Where one direction
of normals takes nearly all, that side hides the depth of the model. It is left only for a view that
clearly has depth: plates and reliefs stay as they are.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ...model.geometry.mesh import Mesh
from ...model.materials.material import states_nothing
from .viewpoint import QUARTER_TURN

#: Pixels of the small pictures.
SIZE = 96, 72
#: The share of one direction above which a view is flat, and below which another one has depth.
_FLAT, _DEEP = 0.85, 0.7
#: Directions are the same if their coordinates round to the same tenths.
_STEPS = 10.0


def has_no_front(mesh: Mesh) -> bool:
    """Return whether a mesh keeps its form, and states neither a material nor colours."""
    is_plain = mesh.colors is None and all(map(states_nothing, mesh.materials))
    return is_plain and mesh.joints is None and not mesh.morph_targets


def flat_share(normals: NDArray[np.float32]) -> float:
    """Return the share of the most frequent direction among normals, (N, 3); 0 of none."""
    if not len(normals):
        return 0.0
    steps = np.rint(normals * np.float32(_STEPS)).astype(np.int64)
    _, counts = np.unique(steps @ np.array([1, 100, 10_000]), return_counts=True)
    return float(counts.max()) / len(normals)


def choose_azimuth(azimuth: float, normals_from: Callable[[float], NDArray[np.float32]]) -> float:
    """Return the azimuth of the first view, in radians.

    Parameters
    ----------
    azimuth : float
        The usual one.
    normals_from : callable
        Returns the normals (N, 3) of the pixels that show the model from an azimuth.
    """
    if flat_share(normals_from(azimuth)) <= _FLAT:
        return azimuth
    turned = [azimuth + quarters * QUARTER_TURN for quarters in (1, 2, 3)]
    shares = [flat_share(normals_from(one)) for one in turned]
    least = min(shares)
    return turned[shares.index(least)] if least < _DEEP else azimuth

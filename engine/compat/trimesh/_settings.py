"""What a picture of a trimesh scene is drawn with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Settings:
    """What trimesh's viewer was asked for.

    Attributes
    ----------
    size : (int, int)
        Width and height in pixels.
    is_smooth : bool
    flags : dict
        ``cull``, ``wireframe``, ``axis``, ``grid``.
    line_width, point_size : float
        Pixels.
    lift : float
        How far lines are moved towards the camera, in world units.
    background : color or None
    hidden : frozenset of str
        Nodes that are left out.
    fixed : frozenset of str
        Geometries that stay where the camera first saw them.
    first_transform : (4, 4) float64
        World from camera, of the first picture.
    """

    size: tuple[int, int]
    is_smooth: bool
    flags: dict[str, Any]
    line_width: float
    point_size: float
    lift: float
    background: Any
    hidden: frozenset[str]
    fixed: frozenset[str]
    first_transform: NDArray[np.float64]

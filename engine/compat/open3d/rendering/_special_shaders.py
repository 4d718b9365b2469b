"""Open3D's shaders that show depths: ``depth`` as heat, ``depthValue`` as digits of base 256.

In: a frame, the things of its objects. Out: their light, put into an array. The formulas are those
of Open3D's depth.mat and depth_value.mat, and of Filament's heat map.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ....rendering.frame import Frame
from ._things import BY_DEPTH, Thing

_HEAT = np.array([1.8, 1.14, 0.3])
#: Light below 0, which the heat map has at its ends, shows as the brightest in Filament.
_BRIGHTEST = 65504.0


def special_colors(
    light: NDArray[np.float64], frame: Frame, things: dict[int, Thing], near: float
) -> None:
    """Put the colours of what is drawn by its depth into ``light``, (H, W, 3).

    ``near`` is the camera's now; heat goes by the planes of when the material was set.
    """
    for number, thing in things.items():
        if thing.record.shader in BY_DEPTH:
            where = np.nonzero((frame.object_id == number) & (frame.depth > 0))
            depth = frame.depth[where].astype(np.float64)
            is_heat = thing.record.shader == "depth"
            light[where] = _heat(depth, *thing.planes) if is_heat else _digits(depth, near)


def _heat(depth: NDArray[np.float64], near: float, far: float) -> NDArray[np.float64]:
    place = -far / (1.0 + (far - near) / depth)
    share = 4.0 * (place + near) / (near - far)
    shifted = share[:, np.newaxis] * 2.1 - _HEAT
    heat = 1.0 - shifted * shifted
    heat[(heat < 0).any(axis=1)] = _BRIGHTEST
    return heat


def _digits(depth: NDArray[np.float64], near: float) -> NDArray[np.float64]:
    whole = np.floor((1.0 - np.clip(near / depth, 0.0, 1.0)) * 16777215.0).astype(np.int64)
    digits = np.stack([whole >> 16, whole >> 8 & 255, whole & 255], axis=1)
    return digits / 255.0

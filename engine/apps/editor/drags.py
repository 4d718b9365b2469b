"""The pose of a gizmo drag: exact steps along or around its handles.

In: the pose at the start of the drag, the gizmo's single precision result, and a step. Out: a pose
in double precision. Axes close to the world's or the node's become exact, and factors close to 1
become 1, so that a drag adds no small rotation or scale.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from .gizmo import snapped, steps_of_turn, turned

_NEARLY = 2e-3  # tolerance of single precision after decomposing a matrix


def dragged_pose(
    tool: str,
    start: NDArray[np.float64],
    made: NDArray[np.float64],
    step: float | None = None,
    *,
    is_local: bool = False,
) -> NDArray[np.float64]:
    """Return the pose that a drag leads to.

    Parameters
    ----------
    tool : {"move", "rotate", "scale"}
    start, made : (4, 4) float64
        World poses: at the beginning, and what the gizmo made of it.
    step : float, optional
        World units, degrees or per cent that the drag is rounded to.
    is_local : bool
        Whether the handles of "move" lie along the axes of the node.
    """
    if tool == "move":
        return _moved(start, made, step, is_local)
    return _turned(start, made, step) if tool == "rotate" else _scaled(start, made, step)


def _moved(start, made, step: float | None, is_local: bool) -> NDArray[np.float64]:
    pose, offset = start.copy(), made[:3, 3] - start[:3, 3]
    if step:
        axes = _axes(start) if is_local else np.eye(3)
        steps = snapped([float(linalg.dot(offset, axis)) for axis in axes], step)
        offset = sum(axis * count for axis, count in zip(axes, steps.tolist(), strict=True))
    pose[:3, 3] += offset
    return pose


def _turned(start, made, step: float | None) -> NDArray[np.float64]:
    turn = np.eye(4)
    turn[:3, :3] = linalg.multiply(_rotation(made), linalg.inverse(_rotation(start)))[:3, :3]
    x, y, z, w = linalg.matrix_to_quaternion(turn).tolist()
    sine = math.sqrt(x * x + y * y + z * z)
    if sine < 1e-9:
        return start.copy()
    angle = 2.0 * float(linalg.atan2(sine, w))
    if angle > math.pi:
        angle -= 2.0 * math.pi
    axis = _nearest_axis(np.array([x, y, z]) / sine, [*np.eye(3), *_axes(start)])
    if step:
        angle = float(snapped(angle, steps_of_turn(step)))
    pose = linalg.multiply(turned(axis, angle, start[:3, 3]), start)
    pose[:3, 3] = start[:3, 3]
    return pose


def _scaled(start, made, step: float | None) -> NDArray[np.float64]:
    lengths = linalg.length(start[:3, :3].T)
    lengths = np.where(lengths > 0.0, lengths, 1.0)
    factors = linalg.length(made[:3, :3].T) / lengths
    if step:
        factors = np.maximum(snapped(factors, step / 100.0), min(step / 100.0, 1.0))
    factors = np.where(np.abs(factors - 1.0) < 1e-5, 1.0, factors)
    pose = start.copy()
    pose[:3, :3] *= factors
    return pose


def _axes(pose) -> NDArray[np.float64]:
    """Return the directions of a pose's axes, (3, 3): a row each."""
    return linalg.normalize(np.ascontiguousarray(pose[:3, :3].T))


def _rotation(pose) -> NDArray[np.float64]:
    rotation = np.eye(4)
    rotation[:3, :3] = _axes(pose).T
    return rotation


def _nearest_axis(axis, candidates) -> NDArray[np.float64]:
    """Return the first of some axes, or its opposite, close to an axis; else the axis itself."""
    for candidate in candidates:
        along = float(linalg.dot(axis, candidate))
        if abs(along) > 1.0 - _NEARLY * _NEARLY:
            return candidate * math.copysign(1.0, along)
    return axis

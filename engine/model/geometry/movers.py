"""The arrays that deform a mesh: joints with their weights, and morph targets.

In: arguments of a caller. Out: checked arrays, by their names in the mesh.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ..._native.loaders import frozen
from ...base.numbers import as_array, floats
from ...errors import InvalidArgumentError
from .morph_targets import MorphTarget

#: The vertex axis of each array.
VERTEX_AXES = {
    "joints": 0,
    "weights": 0,
    "morph_positions": 1,
    "morph_normals": 1,
    "morph_tangents": 1,
}
_MOST_JOINT = 2**16 - 1


def check_influences(joints: Any, weights: Any, count: int) -> dict[str, np.ndarray | None]:
    """Return joints (V, N) uint16 and weights (V, N) float32 of row sums 1; both or neither."""
    if joints is None and weights is None:
        return {"joints": None, "weights": None}
    if joints is None or weights is None:
        raise InvalidArgumentError("joints and weights go together: give both")
    joints, weights = as_array(joints, "joints"), floats(weights, "weights")
    if joints.dtype.kind not in "iu":
        raise InvalidArgumentError(f"joints must be integers, got {joints.dtype}")
    if joints.ndim != 2 or joints.shape[1] == 0 or weights.shape != joints.shape:
        raise InvalidArgumentError(
            f"joints and weights must be (V, N), not {joints.shape} and {weights.shape}"
        )
    if len(joints) != count:
        raise InvalidArgumentError(f"joints has {len(joints)} rows for {count} vertices")
    if joints.size and not 0 <= int(joints.min()) <= int(joints.max()) <= _MOST_JOINT:
        wrong = int(joints.min()) if joints.min() < 0 else int(joints.max())
        raise InvalidArgumentError(f"joints holds {wrong}, which is no number of a joint")
    return {"joints": frozen(joints.astype(np.uint16)), "weights": frozen(shares(weights))}


def shares(weights: np.ndarray) -> np.ndarray:
    """Return weights (V, N) float32, each row divided by its sum.

    Raises
    ------
    InvalidArgumentError
        A weight is negative or not finite, or a row is all 0.
    """
    if not (np.isfinite(weights) & (weights >= 0.0)).all():
        row = int(np.argmin((np.isfinite(weights) & (weights >= 0.0)).all(axis=1)))
        raise InvalidArgumentError(f"weights of vertex {row} must be finite and not negative")
    most = weights.max(axis=1, initial=0.0)
    if not (most > 0.0).all():
        row = int(np.argmin(most > 0.0))
        raise InvalidArgumentError(f"weights of vertex {row} are all 0: nothing would hold it")
    scaled = weights / most[:, np.newaxis]
    total = np.zeros(len(weights))
    for column in range(weights.shape[1]):  # in the written order
        total = total + scaled[:, column]
    return (scaled / total[:, np.newaxis]).astype(np.float32)


def check_targets(value: Any, count: int) -> tuple[MorphTarget, ...]:
    """Return morph targets, checked to have one row for each of ``count`` vertices."""
    if not isinstance(value, Iterable):
        raise InvalidArgumentError(f"morph_targets must be several MorphTarget, not {value!r}")
    targets = tuple(value)
    for number, target in enumerate(targets):
        if not isinstance(target, MorphTarget):
            kind = type(target).__name__
            raise InvalidArgumentError(f"morph target {number} must be a MorphTarget, not {kind}")
        if len(target) != count:
            raise InvalidArgumentError(
                f"morph target {number} has {len(target)} rows for {count} vertices"
            )
    return targets


def stacked(targets: tuple[MorphTarget, ...], count: int) -> dict[str, np.ndarray | None]:
    """Return the offsets of all targets, (T, V, 3) float32, zero where a target has none."""
    return {
        "morph_positions": _stack([target.positions for target in targets], count),
        "morph_normals": _stack([target.normals for target in targets], count),
        "morph_tangents": _stack([target.tangents for target in targets], count),
    }


def _stack(offsets: list[Any], count: int) -> np.ndarray | None:
    if all(each is None for each in offsets):
        return None
    stack = np.zeros((len(offsets), count, 3), np.float32)
    for row, each in zip(stack, offsets, strict=True):
        if each is not None:
            row[:] = each
    return frozen(stack)

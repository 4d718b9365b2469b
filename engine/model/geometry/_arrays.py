"""The arrays of a mesh: a check for each kind, and the attribute that holds one.

In: anything array-like. Out: a read-only C-contiguous array with a fixed dtype that shares no
writable memory, or an `InvalidArgumentError` that names the fault.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from types import FrameType
from typing import Any, Generic, TypeVar, overload

import numpy as np

from ..._native.loaders import frozen, is_frozen
from ...base.numbers import as_array, count_not_finite
from ...errors import InvalidArgumentError, warn
from ..materials.colors import eight_bit_or_linear
from ..materials.linear_colors import marked

_INT32_MAX = 2**31 - 1


Given = TypeVar("Given")
Kept = TypeVar("Kept")


class ArrayAttribute(Generic[Given, Kept]):
    """A checked array of a mesh; assigning passes the new one to the mesh's ``_replace``."""

    def __init__(self, check: Callable[[Any, str], Any], *, optional: bool = False) -> None:
        self._check = check
        self._optional = optional

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, mesh: None, owner: type | None = None) -> ArrayAttribute[Any, Any]: ...

    @overload
    def __get__(self, mesh: object, owner: type | None = None) -> Kept: ...

    def __get__(self, mesh: Any, owner: type | None = None) -> Any:
        return self if mesh is None else mesh._arrays[self._name]

    def __set__(self, mesh: Any, value: Given) -> None:
        if value is None and not self._optional:
            raise InvalidArgumentError(f"{self._name} cannot be None")
        name = self._name.removeprefix("_given_")
        mesh._replace(self._name, None if value is None else self._check(value, name))


def check_vectors2(value: Any, what: str) -> np.ndarray:
    """Return (N, 2) float32, checked."""
    return _frozen(_floats(value, what, 2), np.float32)


def check_vectors3(value: Any, what: str) -> np.ndarray:
    """Return (N, 3) float32, checked."""
    return _frozen(_floats(value, what, 3), np.float32)


def check_positions(value: Any, what: str) -> np.ndarray:
    """Return (N, 3) float32; warn of non-finite values, unless a loader calls."""
    array = check_vectors3(value, what)
    if array is not value:
        broken = count_not_finite(array)
        if broken and not _is_loading():
            warn(f"{broken} of {len(array)} {what} are not finite: what uses them is not drawn")
    return array


def _is_loading() -> bool:
    """Return whether a loader calls, which words its own warnings about its file."""
    frame: FrameType | None = sys._getframe()
    while frame is not None:
        if frame.f_globals.get("__name__", "").startswith("engine3d.io."):
            return True
        frame = frame.f_back
    return False


def check_vectors4(value: Any, what: str) -> np.ndarray:
    """Return (N, 4) float32, checked."""
    return _frozen(_floats(value, what, 4), np.float32)


def check_colors(value: Any, what: str) -> np.ndarray:
    """Return (N, 4) uint8 or linear float32; three components get an opaque alpha."""
    array = eight_bit_or_linear(value, what)
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise InvalidArgumentError(f"{what} must be (N, 3) or (N, 4), got {array.shape}")
    if array.shape[1] == 4:
        return marked(_frozen(array, array.dtype))
    widened = np.empty((len(array), 4), array.dtype)
    widened[:, :3] = array
    widened[:, 3] = 255 if array.dtype == np.uint8 else 1
    return marked(_frozen(widened, array.dtype))


def check_indices(value: Any, what: str) -> np.ndarray:
    """Return (N,) int32, checked."""
    return _frozen(_integers(value, what, ()), np.int32)


def check_pairs(value: Any, what: str) -> np.ndarray:
    """Return (N, 2) int32, checked."""
    return _frozen(_integers(value, what, (2,)), np.int32)


def check_triples(value: Any, what: str) -> np.ndarray:
    """Return (N, 3) int32, checked."""
    return _frozen(_integers(value, what, (3,)), np.int32)


def check_flags3(value: Any, what: str) -> np.ndarray:
    """Return (N, 3) bool, checked."""
    array = _shaped(as_array(value, what), what, (3,))
    if array.dtype.kind not in "biu" and array.size:
        raise InvalidArgumentError(f"{what} must be bool, got {array.dtype}")
    return _frozen(array, np.bool_)


def check_groups(value: Any, faces: int) -> dict[str, np.ndarray]:
    """Return groups as a dict of str to (N,) int32 face indices."""
    if not isinstance(value, Mapping):
        raise InvalidArgumentError(f"groups must be a dict of names to indices, not {value!r}")
    groups = {}
    for name, indices in value.items():
        if not isinstance(name, str):
            raise InvalidArgumentError(f"the name of a group must be a str, not {name!r}")
        what = f"group {name!r}"
        groups[name] = check_indices(indices, what)
        require_range(groups[name], faces, what, "faces")
    return groups


def require_range(indices: np.ndarray, count: int, what: str, of_what: str) -> None:
    """Raise unless every index is in 0..count-1."""
    # Viewed as unsigned, negative numbers exceed every count: usually one test is enough.
    if indices.size == 0 or int(indices.view(np.uint32).max()) < count:
        return
    low, high = int(indices.min()), int(indices.max())
    if low < 0 or high >= count:
        raise InvalidArgumentError(
            f"{what} holds the index {low if low < 0 else high}, but there are {count} {of_what}"
        )


def _shaped(array: np.ndarray, what: str, row: tuple[int, ...]) -> np.ndarray:
    if array.size == 0 and array.ndim == 1:
        return array.reshape((0, *row))
    if array.ndim != 1 + len(row) or array.shape[1:] != row:
        expected = "(N," + "".join(f" {n}" for n in row) + ")"
        raise InvalidArgumentError(f"{what} must have shape {expected}, got {array.shape}")
    return array


def _floats(value: Any, what: str, components: int) -> np.ndarray:
    array = _shaped(as_array(value, what), what, (components,))
    if array.dtype.kind not in "fiu":
        raise InvalidArgumentError(f"{what} must be numbers, got {array.dtype}")
    return array


def _integers(value: Any, what: str, row: tuple[int, ...]) -> np.ndarray:
    array = _shaped(as_array(value, what), what, row)
    if array.dtype.kind not in "iu" and array.size:
        raise InvalidArgumentError(f"{what} must be integers, got {array.dtype}")
    if array.size and array.dtype != np.int32:
        low, high = int(array.min()), int(array.max())
        if low < -_INT32_MAX or high > _INT32_MAX:
            wrong = low if low < -_INT32_MAX else high
            raise InvalidArgumentError(f"{what} holds {wrong}, which no 32-bit index can be")
    return array


def _frozen(array: np.ndarray, dtype: Any) -> np.ndarray:
    """Return a read-only array of the given dtype; copy it unless nobody can write to it."""
    if not (is_frozen(array) and array.dtype == dtype and array.flags.c_contiguous):
        with np.errstate(over="ignore", invalid="ignore"):
            array = frozen(np.array(array, dtype, order="C"))
    return array

"""The numbers of a mesh by name, such as temperatures: a row for each vertex, face or point.

In: arrays, with or without the elements that they belong to. Out: a checked dict of read-only
arrays, which knows the elements of each. Pictures show them by `render`'s ``color_by``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen, is_frozen
from ...base.calls import shows_annotations
from ...base.checked_containers import CheckedDict
from ...base.dirty_tracking import renew
from ...base.numbers import as_array
from ...base.validation import choose, own
from ...choices import ValuesOn
from ...errors import InvalidArgumentError

if TYPE_CHECKING:
    from .mesh import Mesh

#: The elements that numbers belong to, and the arrays of a mesh that hold them.
_PLACES: dict[ValuesOn, str] = {"vertices": "positions", "faces": "faces", "points": "points"}

KINDS: tuple[ValuesOn, ...] = tuple(_PLACES)
#: Ends the name of numbers of faces whose own name belongs to others in the mesh.
OF_FACES = " (faces)"


@shows_annotations
class Values(NamedTuple):
    """Numbers with the elements of a mesh that they belong to.

    Attributes
    ----------
    array : (N,) or (N, K) number
    on : {"vertices", "faces", "points"}
        Faces are triangles; points are the entries of `Mesh.points`.
    """

    array: ArrayLike
    on: ValuesOn


class MeshValues(CheckedDict):
    """The numbers of a mesh: a dict of str to (N,) or (N, K) read-only array.

    An assigned array is copied. Its length tells whether it belongs to the mesh's vertices, faces
    or points; an array for a name that exists stays where it is if it fits. Where the length fits
    several of them, assign `Values`. Floats of 4 and 8 bytes and integers keep their type, bool
    becomes ``uint8``, half floats ``float32``. NaN stands for no number.
    """

    def __init__(self, owner: Any, content: Mapping[str, Values]) -> None:
        self._on: dict[str, ValuesOn] = {name: held.on for name, held in content.items()}
        arrays = {name: held.array for name, held in content.items()}
        super().__init__(owner, _take_changed, arrays)

    def __reduce_ex__(self, protocol: SupportsIndex) -> tuple[Any, ...]:
        return dict, (self.held(),)

    def on(self, name: str) -> ValuesOn:
        """Return what the numbers of a name belong to: ``"vertices"``, ``"faces"``, ``"points"``.

        Raises
        ------
        InvalidArgumentError
            There are no such numbers.
        """
        if name not in self:
            raise InvalidArgumentError(f"no values {name!r}; {told_names(self)}")
        return self._on[name]

    def held(self) -> dict[str, Values]:
        """Return a dict of the arrays with what they belong to."""
        return {name: Values(array, self._on[name]) for name, array in self.items()}

    def _put(self, content: dict[str, Any]) -> None:
        """Replace the content; arrays alone, of an owner that is gone, stay where they were."""
        on: dict[str, ValuesOn] = {}
        for name, held in content.items():
            on[name] = held.on if isinstance(held, Values) else self._on.get(name, "vertices")
        arrays = [held.array if isinstance(held, Values) else held for held in content.values()]
        super()._put(dict(zip(on, arrays, strict=True)))
        self._on = on


def told_names(names: Iterable[str], whose: str = "this mesh") -> str:
    """Return the part of a message that lists the names that exist."""
    known = ", ".join(map(repr, names))
    return f"{whose} has {known}" if known else f"{whose} has none"


def put_values(mesh: Mesh, values: Mapping[str, Values]) -> None:
    """Give a mesh numbers that fit it, such as a loader's, without a check."""
    held = values.held() if isinstance(values, MeshValues) else values
    owned = {name: Values(own(np.asarray(array)), on) for name, (array, on) in held.items()}
    mesh._values = MeshValues(mesh, owned)


def check_values(mesh: Mesh, values: Mapping[str, ArrayLike | Values]) -> dict[str, Values]:
    """Return numbers for a mesh, checked, as read-only arrays.

    Raises
    ------
    InvalidArgumentError
        A name is no text, an array holds no numbers or has the wrong length, or its length fits
        several kinds of elements.
    """
    if not isinstance(values, Mapping):
        raise InvalidArgumentError(f"values must be a dict of names to arrays, not {values!r}")
    known = {id(array): mesh._values.on(name) for name, array in mesh._values.items()}
    checked = {}
    for name, given in values.items():
        if not isinstance(name, str):
            raise InvalidArgumentError(f"the name of values must be a str, not {name!r}")
        if isinstance(given, Values):
            checked[name] = checked_values(mesh, given.array, name, given.on)
        elif id(given) in known:
            checked[name] = Values(given, known[id(given)])
        else:
            former = mesh._values.on(name) if name in mesh._values else None
            checked[name] = checked_values(mesh, given, name, None, former)
    return checked


def checked_values(
    mesh: Mesh,
    array: ArrayLike,
    name: str,
    on: ValuesOn | None = None,
    former: ValuesOn | None = None,
) -> Values:
    """Return an array of numbers for a mesh, checked, with what they belong to.

    Parameters
    ----------
    mesh : Mesh
    array : (N,) or (N, K) number
    name : str
    on : {"vertices", "faces", "points"}, optional
        What they belong to; by default the length tells it.
    former : {"vertices", "faces", "points"}, optional
        What they belong to if the length fits it and ``on`` is left out.

    Raises
    ------
    InvalidArgumentError
    """
    rows = _numbers(array, f"values {name!r}")
    counts = {place: len(getattr(mesh, what)) for place, what in _PLACES.items()}
    if on is not None:
        choose(on, KINDS, "on")
        if len(rows) != counts[on]:
            raise InvalidArgumentError(
                f"values {name!r} has {len(rows)} rows for {counts[on]} {on}"
            )
        return Values(rows, on)
    fitting = [place for place, count in counts.items() if count == len(rows)]
    if not len(rows) and former is None and any(counts.values()):
        fitting = []  # not those of the points that a mesh of faces lacks
    if former in fitting:
        return Values(rows, former)
    if not fitting:
        elements = ", ".join(f"{n} {place}" for place, n in counts.items() if n) or "no vertices"
        raise InvalidArgumentError(f"values {name!r} has {len(rows)} rows for {elements}")
    if not len(rows) or fitting == ["vertices", "points"] and _are_all(mesh.points):
        return Values(rows, fitting[0])  # a cloud: both are the same
    if len(fitting) > 1:
        kinds = " or ".join(f"the {place}" for place in fitting)
        raise InvalidArgumentError(
            f"the {len(rows)} rows of values {name!r} could belong to {kinds}: "
            f"say Values(array, on={fitting[0]!r})"
        )
    return Values(rows, fitting[0])


def _are_all(points: NDArray[np.int32]) -> bool:
    """Return whether points are all vertices in their order."""
    return bool((points == np.arange(len(points))).all())


def _numbers(value: Any, what: str) -> NDArray[Any]:
    """Return numbers as a read-only C-contiguous array of a type that is kept."""
    array = as_array(value, what)
    if array.dtype.kind not in "biuf":
        raise InvalidArgumentError(f"{what} must be numbers, got {array.dtype}")
    if array.ndim not in (1, 2) or (array.ndim == 2 and not array.shape[1]):
        raise InvalidArgumentError(f"{what} must have shape (N,) or (N, K), got {array.shape}")
    kept = _kept_type(array.dtype)
    if is_frozen(array) and array.dtype == kept and array.flags.c_contiguous:
        return array
    with np.errstate(over="ignore", invalid="ignore"):
        return frozen(np.array(array, kept, order="C"))


def _kept_type(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return the type that numbers of some type are kept in."""
    if dtype.kind == "b":
        return np.dtype(np.uint8)
    if dtype.kind == "f" and dtype.itemsize not in (4, 8):
        return np.dtype(np.float32 if dtype.itemsize < 4 else np.float64)
    return dtype.newbyteorder("=")


def drop_misfits(mesh: Mesh) -> None:
    """Take away the numbers of elements whose count has changed."""
    held = mesh._values.held()
    counts = {place: len(mesh._arrays[what]) for place, what in _PLACES.items()}  # type: ignore[arg-type]
    fitting = {name: one for name, one in held.items() if len(mesh._values[name]) == counts[one.on]}
    if len(fitting) < len(held):
        mesh._values._put(fitting)


def taken_rows(values: MeshValues, **rows: Any) -> dict[str, Values]:
    """Return the numbers of a mesh's successor.

    Parameters
    ----------
    values : MeshValues
    **rows : slice or (N,) int
        The old elements of the new ones, by what numbers belong to: ``vertices=rows``. Numbers of
        others are left out.
    """
    return {
        name: Values(array[rows[values.on(name)]], values.on(name))
        for name, array in values.items()
        if values.on(name) in rows
    }


def joined_values(meshes: Iterable[Mesh]) -> dict[str, Values]:
    """Return the numbers of meshes that are joined, in their order.

    A mesh without a name's numbers, or with numbers of other elements than the first mesh that has
    them, gets NaN for them; so do missing columns. Integers beside NaN become ``float64``.
    """
    meshes = list(meshes)
    on: dict[str, ValuesOn] = {}
    for mesh in meshes:
        for name in mesh._values:
            on.setdefault(name, mesh._values.on(name))
    return {name: Values(_joined(meshes, name, place), place) for name, place in on.items()}


def _joined(meshes: list[Mesh], name: str, on: ValuesOn) -> NDArray[Any]:
    parts = []
    for mesh in meshes:
        has_them = name in mesh._values and mesh._values.on(name) == on
        count = len(getattr(mesh, _PLACES[on]))
        parts.append(mesh._values[name] if has_them else np.zeros((count, 0), np.float32))
    return joined_rows(parts)


def joined_rows(parts: list[NDArray[Any]]) -> NDArray[Any]:
    """Return numbers one after another; columns that a part lacks are NaN.

    Parameters
    ----------
    parts : list of (N,) or (N, K) number
        K is 0 for a part that has none.
    """
    if len(parts) == 1:
        return parts[0]
    if all(part.shape[1:] == parts[0].shape[1:] for part in parts):
        return np.concatenate(parts)
    held = [part for part in parts if part.ndim == 1 or part.shape[1]]
    columns = [part.reshape(len(part), -1) if part.size else part for part in parts]
    width = max(1 if part.ndim == 1 else part.shape[1] for part in held)
    dtype = np.result_type(*held)
    dtype = dtype if dtype.kind == "f" else np.dtype(np.float64)
    joined = np.full((sum(map(len, parts)), width), np.nan, dtype)
    start = 0
    for part in columns:
        if part.size:
            joined[start : start + len(part), : part.shape[1]] = part
        start += len(part)
    return joined if any(part.ndim == 2 for part in held) else joined[:, 0].copy()


def _take_changed(
    mesh: Mesh, values: dict[str, Any], put: Callable[[dict[str, Any]], None]
) -> None:
    """Replace the content of a mesh's own dict of numbers."""
    put(check_values(mesh, values))
    mesh._origin = None  # a file or a primitive would not give them again
    renew(mesh)

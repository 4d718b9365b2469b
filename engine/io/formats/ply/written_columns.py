"""The numbers of a mesh as properties of a written PLY file.

In: a mesh. Out: columns for its vertices and faces, and the names that the file cannot hold. A name
that readers take for something else, such as ``red``, is not written.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....model.geometry.mesh import Mesh
from ....model.geometry.values import OF_FACES
from .ply_colors import names_of_colors
from .ply_faces import FACE_NAMES
from .ply_vertices import WIDEST_VECTOR, meant_names

#: The names of PLY's types by those of NumPy.
TYPES = {
    "<f4": "float",
    "<f8": "double",
    "i1": "char",
    "u1": "uchar",
    "<i2": "short",
    "<u2": "ushort",
    "<i4": "int",
    "<u4": "uint",
}
_WHOLE = ("<i4", "<u4")


class Column(NamedTuple):
    """A property: its name, type and numbers, (N,), or (N, K) for a list."""

    name: str
    code: str
    values: NDArray[np.generic]

    @property
    def is_list(self) -> bool:
        """Whether it is a list of K numbers in each row."""
        return self.values.ndim == 2

    @property
    def line(self) -> str:
        """The line of the header."""
        list_words = "list uchar " if self.is_list else ""
        return f"property {list_words}{TYPES[self.code]} {self.name}"


class WrittenValues(NamedTuple):
    """The columns of the numbers of vertices and faces; what is lost, in words."""

    vertices: list[Column]
    faces: list[Column]
    lost: list[str]


def written_values(
    mesh: Mesh, names: Iterable[str], points: NDArray[np.int32] | None
) -> WrittenValues:
    """Return the columns for the numbers of a mesh.

    Parameters
    ----------
    mesh : Mesh
    names : iterable of str
        The other properties of the vertices.
    points : (P,) int or None
        The vertices to write if these are points alone, which get the points' numbers too.
    """
    found = WrittenValues([], [], [])
    of_vertices = {name for name in mesh.values if mesh.values.on(name) != "faces"}
    meant = {*names, *meant_names({*names, *of_vertices})}
    used: set[str] = {*FACE_NAMES, *names_of_colors(set(mesh.values))}
    for key, (given, on) in mesh.values.held().items():
        name, array = key.removesuffix(OF_FACES) if on == "faces" else key, np.asarray(given)
        if on == "vertices" and points is not None:
            array = array[points]
        taken = used if on == "faces" else meant
        can_be = name not in taken and not (on == "points" and points is None)
        if not (can_be and _is_word(name) and (array.ndim == 1 or array.shape[1] <= WIDEST_VECTOR)):
            found.lost.append(f"the values {key!r} of {on}")
            continue
        taken.add(name)
        column = _column(name, array)
        if (
            column.code == "<f8"
            and (column.values.astype(array.dtype) != array).any()
            and (array.dtype.kind != "f")
        ):
            found.lost.append(f"all digits of the values {key!r}")
        (found.faces if on == "faces" else found.vertices).append(column)
    return found


def _is_word(name: str) -> bool:
    return name.isascii() and name.isprintable() and bool(name) and " " not in name


def _column(name: str, array: NDArray[np.generic]) -> Column:
    """Return a column of a type that PLY has."""
    code = array.dtype.newbyteorder("<").str.replace("|", "")
    if code not in TYPES:  # integers of 8 bytes
        fitting = (code for code in _WHOLE if _fits(array, code))
        code = next(fitting, "<f8")
    return Column(name, code, array.astype(code, copy=False))


def _fits(array: NDArray[Any], code: str) -> bool:
    limits = np.iinfo(code)
    return not array.size or (limits.min <= int(array.min()) and int(array.max()) <= limits.max)


def packed(columns: list[Column], count: int) -> NDArray[np.void]:
    """Return the rows of columns as they are in a binary file; lists begin with their length."""
    fields: list[tuple[str, ...] | tuple[str, str, tuple[int]]] = []
    for number, column in enumerate(columns):
        if column.is_list:
            fields.append((f"length {number}", "u1"))
            fields.append((f"{number}", column.code, (column.values.shape[1],)))
        else:
            fields.append((f"{number}", column.code))
    rows = np.empty(count, np.dtype(fields))
    for number, column in enumerate(columns):
        rows[f"{number}"] = column.values
        if column.is_list:
            rows[f"length {number}"] = column.values.shape[1]
    return rows


def kinds_of(columns: list[Column], count: int) -> NDArray[np.int64] | None:
    """Return a number for each row, (N, 1), equal for equal rows; None without columns."""
    if not columns:
        return None
    rows = packed(columns, count)
    octets = rows.view(np.uint8).reshape(count, -1)
    return np.unique(octets, axis=0, return_inverse=True)[1].reshape(-1, 1)

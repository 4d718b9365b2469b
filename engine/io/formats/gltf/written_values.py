"""The numbers of a mesh as custom attributes of a written glTF file.

In: a mesh. Out: arrays of types that such attributes can have, by names that begin with ``_``, and
what the file cannot hold: numbers of faces, rows of more than four, and digits beyond float32.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....choices import ValuesOn
from ....model.geometry.mesh import Mesh

_WIDEST = 4
_WHOLE = ("i1", "u1", "i2", "u2")


class WrittenValues(NamedTuple):
    """The attributes with what they belong to; what is lost, in words."""

    attributes: dict[str, tuple[NDArray[np.generic], ValuesOn]]
    lost: list[str]


def written_values(mesh: Mesh) -> WrittenValues:
    """Return the attributes for the numbers of a mesh, each (N, K)."""
    made = WrittenValues({}, [])
    for name, (given, on) in mesh.values.held().items():
        array = np.asarray(given)
        rows, word = array.reshape(len(array), -1), name if name.startswith("_") else f"_{name}"
        if on == "faces" or rows.shape[1] > _WIDEST or word in made.attributes:
            made.lost.append(f"the values {name!r} of {on}")
            continue
        stored = _stored(rows)
        with np.errstate(all="ignore"):
            is_same = np.array_equal(stored.astype(rows.dtype), rows, rows.dtype.kind == "f")
        if not is_same:
            made.lost.append(f"all digits of the values {name!r}")
        made.attributes[word] = stored, on
    return made


def _stored(rows: NDArray[np.generic]) -> NDArray[np.generic]:
    """Return numbers as integers of one or two bytes if they are such, else as float32."""
    if rows.dtype.kind in "iu":
        own = rows.dtype.str[1:]
        if own in _WHOLE:
            return rows
        for code in _WHOLE:
            limits = np.iinfo(code)
            if not rows.size or (limits.min <= int(rows.min()) and int(rows.max()) <= limits.max):
                return rows.astype(code)
    with np.errstate(over="ignore"):
        return rows.astype(np.float32)

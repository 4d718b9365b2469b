"""Converts tables of pandas for drawing: a point for each row.

In: a DataFrame whose columns have the names of PLY's properties: ``x y z``; ``red green blue`` or
``r g b``, and their alpha; ``nx ny nz``. Out: a `Scene` with one mesh of points, whose values are
the other columns of numbers. Rows without a place are left out. Colours range to 1, to 255, or to
65535 as those of laser scans do.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import floats
from ...errors import warn
from ...model.geometry.mesh import Mesh
from ...model.geometry.values import Values
from ...model.scene.scene import Scene
from ..formats.ply.ply_colors import names_of_colors

_PLACES, _NORMALS = ("x", "y", "z"), ("nx", "ny", "nz")


def scene_from_pandas(table: Any) -> Scene | None:
    """Return a scene of a DataFrame; None for one without columns ``x y z``, and for others.

    Raises
    ------
    InvalidArgumentError
        A column of places, colours or normals holds no numbers.
    """
    if not (hasattr(table, "columns") and set(_PLACES) <= set(table.columns)):
        return None
    places = _numbers(table, _PLACES)
    table = table[np.isfinite(places).all(axis=1)]
    places = _numbers(table, _PLACES)
    given: dict[str, Any] = {}
    named = set(map(str, table.columns))
    names = [name for name in names_of_colors(named - {"f_dc_0"}) if name in named][:4]
    if len(names) >= 3 and len(table):
        given["colors"] = _colors(table, names)
    if set(_NORMALS) <= set(table.columns):
        given["normals"] = _numbers(table, _NORMALS)
    mesh = Mesh(places, points=np.arange(len(places)), **given)
    taken = {*_PLACES, *_NORMALS, *(names if "colors" in given else ())}
    for name in table.columns:
        column = np.asarray(table[name])
        if name not in taken and column.dtype.kind in "biuf" and len(column):
            mesh.values[str(name)] = Values(column, on="vertices")
    scene = Scene()
    scene.add(mesh, name="points")
    return scene


def _numbers(table: Any, names: Sequence[str]) -> NDArray[np.float64]:
    return np.stack([floats(table[name], f"the column {name!r}") for name in names], axis=1)


def _colors(table: Any, names: Sequence[str]) -> NDArray[Any]:
    """Return colours as bytes, or from 0 to 1; missing ones are 0. Alpha has a range of its own."""
    groups = names[:3], names[3:]
    held = [(group, np.nan_to_num(_numbers(table, group))) for group in groups if group]
    fulls = [_full(table, group, numbers) for group, numbers in held]
    if 1.0 not in fulls:
        parts = [_codes(numbers, full) for (_, numbers), full in zip(held, fulls, strict=True)]
        return np.concatenate(parts, axis=1).astype(np.uint8)
    shares = [
        numbers if full == 1.0 else _codes(numbers, full) / 255.0
        for (_, numbers), full in zip(held, fulls, strict=True)
    ]
    return np.clip(np.concatenate(shares, axis=1), 0.0, 1.0)


def _full(table: Any, names: Sequence[str], numbers: NDArray[np.float64]) -> float:
    """Return the number that means full in some columns: 1, 255 or 65535. A guess is a warning."""
    types = [table[name].dtype for name in names]
    largest = float(numbers.max())
    if not all(one.kind in "iu" for one in types) and largest <= 1.0:
        return 1.0
    is_wide = all(one.kind == "u" and one.itemsize == 2 for one in types)
    if largest <= 255.0:
        if is_wide:
            _warn_of_range(names, f"16-bit integers up to {largest:g}", 255)
        return 255.0
    if not is_wide:
        _warn_of_range(names, f"numbers up to {largest:g}", 65535)
    return 65535.0


def _warn_of_range(names: Sequence[str], found: str, full: int) -> None:
    warn(f"{', '.join(names)}: {found} are read as of 0 to {full}")


def _codes(numbers: NDArray[np.float64], full: float) -> NDArray[np.float64]:
    """Return whole numbers of 0 to 255."""
    return np.clip(np.floor(numbers / (full / 255.0) + 0.5), 0, 255)

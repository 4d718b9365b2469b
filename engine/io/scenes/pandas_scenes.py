"""Converts tables of pandas for drawing: a point for each row.

In: a DataFrame whose columns have the names of PLY's properties: ``x y z``; ``red green blue`` or
``r g b``, and their alpha; ``nx ny nz``. Out: a `Scene` with one mesh of points, whose values are
the other columns of numbers. Rows without a place are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import floats
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
    """Return colours: integers up to 255, or floats up to 1; missing ones are 0."""
    numbers = np.nan_to_num(_numbers(table, names))
    is_whole = all(np.asarray(table[name]).dtype.kind in "iu" for name in names)
    if is_whole or numbers.max() > 1.0:
        return np.clip(np.floor(numbers + 0.5), 0, 255).astype(np.uint8)
    return np.clip(numbers, 0.0, 1.0)

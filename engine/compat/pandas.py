"""A plotting backend of pandas: ``df.plot(backend="engine3d", kind="scatter3d")``.

In: a DataFrame, names of its columns. Out: a `Frame`, which shows itself in notebooks. pandas finds
this module by the entry point of its group ``pandas_plotting_backends``; it is not imported here.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.numbers import floats
from ..base.validation import choose
from ..errors import InvalidArgumentError
from ..io.scenes.upright_loading import stand_upright
from ..model.geometry.mesh import Mesh
from ..model.geometry.values import Values
from ..model.scene.scene import Scene
from ..rendering.frame import Frame
from ..stage.render import render

__all__ = ["KINDS", "plot"]

#: The plots that there are; pandas' own are flat.
KINDS = ("scatter3d", "line3d")
_FLAT = "x", "y", "z"


def plot(
    data: Any,
    kind: str = "scatter3d",
    x: Any = None,
    y: Any = None,
    z: Any = None,
    c: Any = None,
    *,
    equal: bool = False,
    **options: Any,
) -> Frame:
    """Draw a table in space, its column ``z`` upwards.

    Parameters
    ----------
    data : pandas.DataFrame
    kind : {"scatter3d", "line3d"}
        A point for each row, or a line from row to row.
    x, y, z : str
        Columns; by default those of these names.
    c : str, optional
        A column of numbers, shown as colours with a bar, or of names of colours; or one colour.
    equal : bool
        Whether a unit is as long on all three axes. Otherwise each column is as long as the others.
    **options
        As of `engine3d.render`: ``size``, ``colormap``, ``point_size`` and so on.

    Returns
    -------
    frame : Frame

    Raises
    ------
    InvalidArgumentError
        There is no such kind or column, or a column holds no numbers.
    """
    choose(kind, KINDS, "kind")
    if not hasattr(data, "columns"):
        raise InvalidArgumentError(f"{kind} needs a DataFrame, not a {type(data).__name__}")
    names = [name if given is None else given for name, given in zip(_FLAT, (x, y, z), strict=True)]
    places = np.stack([floats(_column(data, name), f"the column {name!r}") for name in names], 1)
    keeps = np.isfinite(places).all(axis=1)
    places = places[keeps]
    if not equal and len(places):
        low, span = places.min(axis=0), np.ptp(places, axis=0)
        places = (places - low) / np.where(span > 0, span, 1.0)
    numbers = np.arange(len(places))
    lines = np.stack([numbers[:-1], numbers[1:]], axis=1) if kind == "line3d" else None
    mesh = Mesh(places, points=None if kind == "line3d" else numbers, lines=lines)
    if c is not None and len(places):
        _color(mesh, data, c, keeps, options)
    scene = Scene()
    scene.add(mesh, name=kind)
    stand_upright(scene, "+Z")
    return render(scene, **options)


def _column(data: Any, name: Any) -> Any:
    if name not in data.columns:
        known = ", ".join(map(str, data.columns))
        raise InvalidArgumentError(f"there is no column {name!r}: there are {known or 'none'}")
    return data[name]


def _color(mesh: Mesh, data: Any, c: Any, keeps: Any, options: dict[str, Any]) -> None:
    """Colour a mesh by a column of numbers or of colours, or all alike."""
    is_column = isinstance(c, str) and c in data.columns
    if not is_column:
        mesh.colors = [c] * len(mesh.positions)
        return
    column = np.asarray(data[c])[keeps]
    if column.dtype.kind in "biuf":
        mesh.values[c] = Values(column, on="vertices")
        options.setdefault("color_by", c)
        options.setdefault("bar", True)
    else:
        mesh.colors = column.tolist()

"""The colours of a PLY element, converted by each property's type and range.

In: the table of an element. Out: sRGB bytes or linear floats, as a `Mesh` takes them. Numbers are
display values; the floats of our own files are linear light. Programs differ: floats may range to
255, 16-bit integers may hold 8 bits, and an alpha has a type and a range of its own. 3D Gaussian
splats have colours as the first coefficient of spherical harmonics.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model.materials.colors import linear_from_display, srgb_to_linear_table
from ....model.materials.linear_colors import marked
from ...reading.warning_list import WarningList
from .ply_tables import PlyTable

_COLORS = (
    ("red", "green", "blue"),
    ("r", "g", "b"),
    ("diffuse_red", "diffuse_green", "diffuse_blue"),
)
_ALPHAS = ("alpha", "a", "diffuse_alpha")
_SPLATS, _OPACITY = ("f_dc_0", "f_dc_1", "f_dc_2"), "opacity"
# The constant spherical harmonic, 1 / (2 sqrt(pi)).
_HARMONIC = 0.28209479177387814
# Floats from here on range to 255; our own writer's never do.
_LEAST_CODE, _MOST_CODE = 16.0, 256.0
# Alphas beyond 1 by more than a rounding error.
_LEAST_WHOLE = 1.01


def color_names(table: PlyTable) -> tuple[str, ...]:
    """Return the names of colour properties, alphas included; empty if there are none."""
    names = next((names for names in _COLORS if table.has(*names)), ())
    return (*names, *_ALPHAS) if names else _ALPHAS


def names_of_colors(names: set[str]) -> tuple[str, ...]:
    """Return the names of colours among those of an element's properties, and all of alpha."""
    sets = next((one for one in _COLORS if names.issuperset(one)), ())
    splats = _SPLATS if not sets and names.issuperset(_SPLATS) else ()
    return (*sets, *_ALPHAS, *splats)


def read_colors(table: PlyTable, warnings: WarningList, is_own: bool = False) -> np.ndarray | None:
    """Read the colours of an element.

    Parameters
    ----------
    table : PlyTable
    warnings : WarningList
        Gets a warning if floats are taken for numbers of 0 to 255.
    is_own : bool
        Whether our own writer made the file; then floats are linear light.

    Returns
    -------
    colors : (N, 4) uint8 or float32, or None
        sRGB bytes, or linear light if any of red, green and blue is a float of 0 to 1. None without
        colours.
    """
    names = next((names for names in _COLORS if table.has(*names)), None)
    if names is None:
        return None
    alpha = next((name for name in _ALPHAS if table.has(name)), None)
    both = (*names, *([alpha] if alpha else []))
    if {table.type(name) for name in both} == {"u1"}:
        colors = np.full((len(table), 4), 255, np.uint8)
        colors[:, : len(both)] = table.columns(*both)
        return colors
    kinds = [table.type(name) for name in both]
    values = [table.column(name) for name in both] if len(set(kinds)) > 1 else None
    if values is None:  # read at once
        block = table.columns(*both)
        if kinds[0].startswith("f") and (is_own or _is_of_0_to_1(block)):
            return _light(block, is_own)
        values = list(block.T)
    columns = [_Column(*column) for column in zip(both, kinds, values, strict=True)]
    ranges = _Ranges(is_own, warnings)
    fulls = ranges.of_colors(columns[:3])
    clear = None if alpha is None else ranges.shares(columns[3])
    return _joined(columns[:3], fulls, clear, is_own)


def _is_of_0_to_1(block: np.ndarray) -> bool:
    """Return whether floats certainly do not range to 255, as in most files."""
    largest = float(block.max(initial=0))
    return largest < (_LEAST_WHOLE if block.shape[1] == 4 else _LEAST_CODE)


def _light(block: np.ndarray, is_linear: bool) -> np.ndarray:
    """Return floats in linear light, white where invalid."""
    with np.errstate(over="ignore"):
        colors = np.ones((len(block), 4), np.float32)
        colors[:, : block.shape[1]] = np.nan_to_num(block, nan=1.0)
    if not is_linear:
        colors[:, :3] = linear_from_display(colors[:, :3])
    return marked(np.clip(colors, 0, np.finfo(np.float32).max, out=colors))


class _Column(NamedTuple):
    """A property: its name, type and numbers (N,)."""

    name: str
    kind: str
    values: np.ndarray


class _Ranges:
    """Determines the ranges of properties, and warns of guesses.

    Parameters
    ----------
    is_own : bool
        Whether floats are linear light.
    warnings : WarningList
    """

    def __init__(self, is_own: bool, warnings: WarningList) -> None:
        self._is_own, self._warnings = is_own, warnings

    def of_colors(self, columns: list[_Column]) -> list[float | None]:
        """Return the value that means 255 in each column; None for floats of 0 to 1.

        Columns of one type share a range.
        """
        found = {}
        for kind in {column.kind: None for column in columns}:
            alike = [column for column in columns if column.kind == kind]
            largest = max(_largest(column.values) for column in alike)
            names = ", ".join(column.name for column in alike)
            found[kind] = self._full(names, kind, largest, _LEAST_CODE)
        return [found[column.kind] for column in columns]

    def shares(self, column: _Column) -> np.ndarray:
        """Return alphas, (N,) float64 from 0 to 1."""
        full = self._full(column.name, column.kind, _largest(column.values), _LEAST_WHOLE)
        return _codes(column, full) / 255 if full else np.nan_to_num(column.values, nan=1.0)

    def _full(self, names: str, kind: str, largest: float, least: float) -> float | None:
        if kind.startswith("f"):
            if self._is_own or not least <= largest < _MOST_CODE:
                return None
            self._warn(f"{names}: floats up to {largest:g} are read as of 0 to 255")
            return 255.0
        if kind[1] == "1":
            return 255.0
        if largest > 255.0:
            return 65535.0 if largest <= 65535.0 else float(np.iinfo(kind).max)
        if kind == "u2":
            self._warn(f"{names}: 16-bit integers up to {largest:g} are read as of 0 to 255")
        return 255.0

    def _warn(self, message: str) -> None:
        self._warnings.add_once(message)


def _joined(
    columns: list[_Column], fulls: list[float | None], clear: np.ndarray | None, is_linear: bool
) -> np.ndarray:
    """Return the colours of three columns, with alphas of 0 to 1."""
    count = len(columns[0].values)
    known = [full for full in fulls if full is not None]
    if len(known) == len(fulls):
        colors = np.full((count, 4), 255, np.uint8)
        for channel, (column, most) in enumerate(zip(columns, known, strict=True)):
            colors[:, channel] = _codes(column, most)
        if clear is not None:
            colors[:, 3] = np.floor(np.clip(clear, 0, 1) * 255 + 0.5)
        return colors
    colors = np.ones((count, 4), np.float32)
    with np.errstate(over="ignore"):
        for channel, (column, full) in enumerate(zip(columns, fulls, strict=True)):
            if full is None:
                values = np.nan_to_num(column.values, nan=1.0)
                colors[:, channel] = values if is_linear else linear_from_display(values)
            else:
                colors[:, channel] = srgb_to_linear_table()[_codes(column, full).astype(np.uint8)]
        if clear is not None:
            colors[:, 3] = clear
    return marked(np.clip(colors, 0, np.finfo(np.float32).max, out=colors))


def _codes(column: _Column, full: float) -> np.ndarray:
    """Return display values as whole numbers of 0 to 255, float64; non-finite ones white."""
    values = column.values.astype(np.float64) / (full / 255)
    if column.kind == "i1":  # bytes that were meant unsigned
        values = np.where(values < 0, values + 256, values)
    return np.floor(np.clip(np.nan_to_num(values, nan=255.0), 0, 255) + 0.5)


def _largest(values: np.ndarray) -> float:
    largest = float(values.max(initial=0))
    return largest if np.isfinite(largest) else float(values[np.isfinite(values)].max(initial=0))


def is_splats(table: PlyTable) -> bool:
    """Return whether vertices are 3D Gaussian splats, whose colours are coefficients."""
    return table.has(*_SPLATS) and not any(table.has(*names) for names in _COLORS)


def splat_colors(table: PlyTable, warnings: WarningList) -> np.ndarray:
    """Read the view-independent colours of 3D Gaussian splats.

    Returns
    -------
    colors : (N, 4) uint8
        ``0.5 + 0.2821 f_dc`` as display values, and the sigmoid of the opacity as alpha.
    """
    warnings.add(
        "3D Gaussian splats are drawn as points of their base colours and opacities: their sizes, "
        "directions and view-dependent colours are left out"
    )
    colors = np.full((len(table), 4), 255, np.uint8)
    shares = [0.5 + _HARMONIC * table.column(name).astype(np.float64) for name in _SPLATS]
    if table.has(_OPACITY):
        with np.errstate(over="ignore"):
            shares.append(1.0 / (1.0 + np.exp(-table.column(_OPACITY).astype(np.float64))))
    for channel, share in enumerate(shares):
        share = np.clip(np.nan_to_num(share, nan=1.0), 0, 1)
        colors[:, channel] = np.floor(share * 255 + 0.5)
    return colors

"""The parsed arrays of an OBJ file, from C, with errors in words.

In: the bytes of a file. Out: vertices, the corners of faces, lines and points, zero-based and
checked, and the statements that set something for the elements behind them: materials, libraries,
objects, groups and smoothing groups. Every error names its line; kinds of statement that are not
understood are warned of once each.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ...._native import loaders as native
from ....errors import FileFormatError
from ...reading.corner_mesh import Vertices
from ...reading.smoothing import FLAT
from ...reading.sources import Source
from ...reading.text import checked_text, decoded, shown
from ...reading.warning_list import WarningList

# Bytes between checks for other events, such as Ctrl-C.
_STEP = 4 << 20
# The fraction of the work done when all bytes are parsed.
_PARSING = 0.8
_ROWS = ("vertex", "texture coordinate", "normal")
_LEAST = (3, 1, 3)
_SMOOTH = 1  # the smoothing group of all faces where none is set


class Elements(NamedTuple):
    """The faces, lines or points of a file.

    Attributes
    ----------
    sizes : (E,) int32
        The number of corners of each element.
    positions : (C,) int32
        Position indices of all corners, element after element, from 0.
    uvs, normals : (C,) int32 or None
        Likewise, -1 for none; None if no corner has any.
    are_triangles : bool
        Whether all elements have three corners.
    """

    sizes: np.ndarray
    positions: np.ndarray
    uvs: np.ndarray | None
    normals: np.ndarray | None
    are_triangles: bool

    def part(self, first: int, last: int) -> Elements:
        """Return the elements first..last-1."""
        corners = slice(int(self.sizes[:first].sum()), int(self.sizes[:last].sum()))
        return Elements(
            self.sizes[first:last],
            self.positions[corners],
            None if self.uvs is None else self.uvs[corners],
            None if self.normals is None else self.normals[corners],
            self.are_triangles,
        )


@dataclass
class ObjFile:
    """The contents of an OBJ file.

    Attributes
    ----------
    vertices : Vertices
    faces, lines, points : Elements
    setters : (S,) `engine3d._native.loaders.SETTER`
        The statements that set a state, in file order.
    names : memoryview
        The bytes that contain the names of ``setters``.
    """

    vertices: Vertices
    faces: Elements
    lines: Elements
    points: Elements
    setters: np.ndarray
    names: memoryview


def read_obj_file(source: Source, warnings: WarningList) -> ObjFile:
    """Parse the bytes of an OBJ file.

    Raises
    ------
    FileFormatError
        A number or index is invalid, or a vertex does not exist. A missing texture coordinate or
        normal gives a warning, and the corner has none.
    """
    reader = native.ObjReader(checked_text(source))
    while reader.read(_STEP):
        source.progress(_PARSING * min(reader.consumed / len(source.data), 1.0))
    problem = reader.end()
    if problem != native.DONE:
        raise _error(problem, reader.error, source.path)
    found = reader.take()
    faces, lines, points = (
        _elements(found[kind], found, warnings, of_faces=kind == "faces")
        for kind in ("faces", "lines", "points")
    )
    vertices = Vertices(found["positions"], found["colors"], found["uvs"], found["normals"])
    return ObjFile(vertices, faces, lines, points, found["setters"], found["names"])


def _error(problem: int, details: tuple[int, int, int, bytes], path: str) -> Exception:
    if problem == native.NO_MEMORY:
        return MemoryError()
    which, count, line, word = details
    what = _ROWS[which]
    message = {
        native.TOO_LARGE: "more than 2^31 vertices, corners or lines",
        native.NO_VERTICES: "no vertices in this OBJ file",
        native.FEW_NUMBERS: f"{what} with {count} numbers, at least {_LEAST[which]} are needed",
        native.NOT_A_NUMBER: f"not a number: {shown(word)}",
        native.NOT_AN_INDEX: f"not a {what} index: {shown(word)}",
        native.NO_INDEX: f"a corner without a vertex index: {shown(word)}",
        native.MANY_INDICES: f"a corner has at most three indices: {shown(word)}",
        native.OUT_OF_RANGE: f"{what} index out of range, there are {count}: {shown(word)}",
    }[problem]
    return FileFormatError(message, path, line or None)


def _elements(
    read: tuple[Any, ...], found: dict[str, Any], warnings: WarningList, *, of_faces: bool
) -> Elements:
    """Return one kind of elements; warn of dropped content."""
    sizes, (positions, uvs, normals), are_triangles, (short, line), outside = read
    for which, (count, first, word) in enumerate(outside):
        if count:
            total = len(found["uvs" if which == 1 else "normals"])
            warnings.add(
                f"{_ROWS[which]} index out of range, there are {total}: {shown(word)}; "
                f"left out in {count} corners",
                first,
            )
    if of_faces and short:
        warnings.add(f"{short} faces of fewer than three corners are left out", line)
    return Elements(sizes, positions, uvs, normals, are_triangles)


class Setters:
    """Statements of one kind.

    Attributes
    ----------
    lines : list of int
        The line of each.
    before : dict of str to (S,) int64
        How many ``"faces"``, ``"lines"`` and ``"points"`` stand before each.
    """

    def __init__(self, file: ObjFile, kind: int) -> None:
        self._chosen = file.setters[file.setters["kind"] == kind]
        self._text = file.names
        self._names: list[str] | None = None
        self.before = {
            what: self._chosen[what].astype(np.int64) for what in ("faces", "lines", "points")
        }
        self.lines = self._chosen["line"].tolist()

    def __len__(self) -> int:
        return len(self._chosen)

    def words(self) -> list[bytes]:
        """Return what follows each one's keyword; of those not understood, the keyword."""
        starts = self._chosen["name"].tolist()
        lengths = self._chosen["name_length"].tolist()
        text = self._text
        return [bytes(text[s : s + n]) for s, n in zip(starts, lengths, strict=True)]

    def names(self) -> list[str]:
        """Return the same as text; names may hold blanks."""
        if self._names is None:
            self._names = [decoded(word) for word in self.words()]
        return self._names

    def values(self) -> np.ndarray:
        return self._chosen["value"]


class ObjStates:
    """States by element.

    Attributes
    ----------
    materials, libraries, objects, groups : Setters
        The statements ``usemtl``, ``mtllib``, ``o`` and ``g``.
    """

    def __init__(self, file: ObjFile, warnings: WarningList) -> None:
        self.materials = Setters(file, native.MATERIAL)
        self.libraries = Setters(file, native.LIBRARY)
        self.objects = Setters(file, native.OBJECT)
        self.groups = Setters(file, native.GROUP)
        self._smoothing = Setters(file, native.SMOOTHING)
        _warn_of_unknown(Setters(file, native.UNKNOWN), warnings)
        self._smoothing_values = self._smoothing.values()
        self._warn_of_smoothing(warnings)

    @property
    def has_smoothing(self) -> bool:
        """Whether the file sets any smoothing group; without, all faces are in one."""
        return len(self._smoothing) > 0

    def smoothing_groups(self, faces: int) -> np.ndarray:
        """Return the smoothing group of each face, 0 for flat."""
        if not self.has_smoothing:
            return np.broadcast_to(np.int64(_SMOOTH), faces)
        values = np.concatenate([[FLAT], np.maximum(self._smoothing_values, FLAT)])
        return np.repeat(values, run_lengths(self._smoothing, faces))

    def _warn_of_smoothing(self, warnings: WarningList) -> None:
        wrong = np.flatnonzero(self._smoothing_values < 0).tolist()
        if wrong:
            words = self._smoothing.words()
            for number in wrong:
                word = words[number].split()[0]
                line = self._smoothing.lines[number]
                warnings.add(f"smoothing group {shown(word)} counts as off", line)


def run_lengths(setters: Setters, faces: int) -> np.ndarray:
    """Return how many faces stand before the first statement, and behind each up to the next."""
    return np.diff(setters.before["faces"], prepend=0, append=faces)


def _warn_of_unknown(setters: Setters, warnings: WarningList) -> None:
    unknown: dict[bytes, list[int]] = {}
    for keyword, line in zip(setters.words(), setters.lines, strict=True):
        unknown.setdefault(keyword, []).append(line)
    for keyword, lines in unknown.items():
        warnings.add(
            f"{shown(keyword)} is not understood; {len(lines)} statements left out", lines[0]
        )

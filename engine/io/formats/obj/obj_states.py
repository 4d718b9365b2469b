"""The statements of an OBJ file that set a state for later elements.

In: an `ObjFile`. Out: where materials, libraries, objects, groups and smoothing groups are set.
Each unknown kind of statement gives one warning.
"""

from __future__ import annotations

import numpy as np

from ...._native import loaders as native
from ...reading.smoothing import FLAT
from ...reading.text import decoded, shown
from ...reading.warning_list import WarningList
from .obj_file import ObjFile

_SMOOTH = 1


class Setters:
    """Statements of one kind.

    Attributes
    ----------
    lines : list of int
        The line number of each.
    before : dict of str to (S,) int64
        How many ``"faces"``, ``"lines"`` and ``"points"`` precede each.
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
        """Return the text after each keyword; for unknown statements, the keyword."""
        starts = self._chosen["name"].tolist()
        lengths = self._chosen["name_length"].tolist()
        text = self._text
        return [bytes(text[s : s + n]) for s, n in zip(starts, lengths, strict=True)]

    def names(self) -> list[str]:
        """Return the same as text; names may contain blanks."""
        if self._names is None:
            self._names = [decoded(word) for word in self.words()]
        return self._names

    def values(self) -> np.ndarray:
        return self._chosen["value"]


class ObjStates:
    """The states set for elements.

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
        """Return whether the file sets any smoothing group; otherwise all faces are in one."""
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
    """Return the number of faces before the first statement, and after each up to the next."""
    return np.diff(setters.before["faces"], prepend=0, append=faces)


def _warn_of_unknown(setters: Setters, warnings: WarningList) -> None:
    unknown: dict[bytes, list[int]] = {}
    for keyword, line in zip(setters.words(), setters.lines, strict=True):
        unknown.setdefault(keyword, []).append(line)
    for keyword, lines in unknown.items():
        warnings.add(
            f"{shown(keyword)} is not understood; {len(lines)} statements left out", lines[0]
        )

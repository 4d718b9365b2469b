"""The statements of an OBJ file that set a state for the elements behind them.

In: `Statements`. Out: which materials, libraries, objects, groups and smoothing groups are set
where. Kinds of statement that are not understood are warned of once each.
"""

from __future__ import annotations

import numpy as np

from .obj_statements import Statements, keyword_code
from .smoothing import FLAT
from .text import decoded, shown
from .warning_list import WarningList

_GEOMETRY = ("v", "vt", "vn", "f", "fo", "l", "p", "g", "o", "s")
# Statements that change nothing that is drawn here.
_IGNORED = (b"lod", b"shadow_obj", b"trace_obj", b"bevel", b"c_interp", b"d_interp", b"vp", b"mg")
_SMOOTH = 1
_MAX_GROUP = 2**31 - 1


class ObjStates:
    """States by statement.

    Attributes
    ----------
    material_uses, libraries : list of (str, int)
        What follows each ``usemtl`` and ``mtllib``, and its line.
    use_statements : list of int
        The statements of ``material_uses``.
    objects, groups : (N,) int64
        The statements ``o`` and ``g``.
    """

    def __init__(self, statements: Statements, warnings: WarningList) -> None:
        self._statements = statements
        self._warnings = warnings
        self.material_uses: list[tuple[str, int]] = []
        self.use_statements: list[int] = []
        self.libraries: list[tuple[str, int]] = []
        self.objects = statements.of("o")
        self.groups = statements.of("g")
        self._read_others()

    def name(self, statement: int) -> str:
        """Return what follows a statement's keyword; names may hold blanks."""
        return decoded(self._statements.rest(statement))

    def smoothing_groups(self, elements: np.ndarray) -> np.ndarray:
        """Return the smoothing group of each element's statement, 0 for flat.

        All are in one group if the file sets none at all.
        """
        setters = self._statements.of("s")
        if len(setters) == 0:
            return np.full(len(elements), _SMOOTH, np.int64)
        values = np.array([self._smoothing_group(s) for s in setters.tolist()], np.int64)
        return np.concatenate([[FLAT], values])[last_before(setters, elements) + 1]

    def _read_others(self) -> None:
        statements = self._statements
        unknown: dict[bytes, list[int]] = {}
        known = np.isin(statements.keyword, [keyword_code(k) for k in _GEOMETRY])
        for statement in np.flatnonzero(~known).tolist():
            keyword = statements.keyword_text(statement)
            if keyword == b"usemtl":
                self.material_uses.append((self.name(statement), statements.line(statement)))
                self.use_statements.append(statement)
            elif keyword == b"mtllib":
                self.libraries.append((self.name(statement), statements.line(statement)))
            elif keyword not in _IGNORED:
                unknown.setdefault(keyword, []).append(statement)
        for keyword, members in unknown.items():
            self._warnings.add(
                f"{shown(keyword)} is not understood; {len(members)} statements left out",
                statements.line(members[0]),
            )

    def _smoothing_group(self, statement: int) -> int:
        word = (self._statements.words(statement) or [b"off"])[0]
        if word in (b"off", b"on"):
            return FLAT if word == b"off" else _SMOOTH
        try:
            return min(max(int(word[:10]), 0), _MAX_GROUP)
        except ValueError:
            self._warnings.add(
                f"smoothing group {shown(word)} counts as off", self._statements.line(statement)
            )
            return FLAT


def last_before(setters, elements: np.ndarray) -> np.ndarray:
    """Return the number of the last setting statement before each element, -1 for none."""
    return np.searchsorted(np.asarray(setters, np.int64), elements) - 1

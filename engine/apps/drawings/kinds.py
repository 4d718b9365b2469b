"""The kinds of lines of a drawing, the most important first."""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

#: The kinds of lines. Where two coincide, the drawing has the one that is listed first.
#: ``section``: outlines of cut material; ``outline``: where a surface turns from the viewer;
#: ``border``: edges of one triangle only; ``crease``: sharp edges; ``intersection``: where parts
#: run through each other; ``line``: lines of the model's own.
LineKind: TypeAlias = Literal["section", "outline", "border", "crease", "intersection", "line"]
KINDS: tuple[LineKind, ...] = get_args(LineKind)
SECTION, OUTLINE, BORDER, CREASE, INTERSECTION, LINE = range(len(KINDS))

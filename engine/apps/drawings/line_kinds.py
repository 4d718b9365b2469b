"""The kinds of lines of a drawing as numbers, the most important first."""

from __future__ import annotations

from typing import get_args

from ...choices import LineKind

KINDS: tuple[LineKind, ...] = get_args(LineKind)
SECTION, OUTLINE, BORDER, CREASE, INTERSECTION, LINE = range(len(KINDS))

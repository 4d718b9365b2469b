"""Lines in the world that are no edges of triangles, with kind and part.

In: their ends. Out: `Lines`, which views draw beside the edges.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .line_kinds import SECTION


class Lines(NamedTuple):
    """Lines in the world.

    Attributes
    ----------
    ends : (N, 2, 3) float64
    kinds : (N,) int8
        Indices of `KINDS`.
    parts : (N,) int32
    """

    ends: NDArray[np.float64]
    kinds: NDArray[np.int8]
    parts: NDArray[np.int32]


def joined_lines(several: list[Lines]) -> Lines:
    """Return several sets of lines as one."""
    if len(several) == 1:
        return several[0]
    return Lines(*(np.concatenate(columns) for columns in zip(*several, strict=True)))


def lines_of(ends: NDArray[np.float64], kind: int, parts: NDArray[np.int32]) -> Lines:
    """Return lines of one kind."""
    return Lines(ends, np.full(len(ends), kind, np.int8), parts)


def section_lines(segments: NDArray[np.float64], part: int) -> Lines:
    """Return the outlines (N, 2, 3) of a cut part."""
    return lines_of(segments, SECTION, np.full(len(segments), part, np.int32))

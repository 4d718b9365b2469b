"""The pieces of a view's lines: which are visible, and which hidden.

In: surfaces and a projection. Out: straight pieces on paper, each stroke once, in millimetres.
Which stretch of a line a triangle hides is found in closed form, so that lines end exactly where
they pass behind something; docs/drawings.md tells the method.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native import drawing as native
from ...base.validation import choose
from ...choices import LineKind
from .clipping import are_before, clip_triangles
from .line_kinds import KINDS, OUTLINE
from .model_lines import Lines, joined_lines
from .projections import Projection
from .surfaces import Surfaces

#: Lines that lie within so many millimetres of each other are one stroke, but not more than a share
#: of the frame.
_ONE_STROKE, _MOST_SHARE = 0.02, 1e-4


class Pieces(NamedTuple):
    """Straight pieces of lines on paper.

    Attributes
    ----------
    ends : (N, 2, 2) float64
        Millimetres from the frame's upper left corner, x right, y down.
    kinds : (N,) int8
        Indices of `KINDS`.
    parts : (N,) int32
    hidden : (N,) bool
    """

    ends: NDArray[np.float64]
    kinds: NDArray[np.int8]
    parts: NDArray[np.int32]
    hidden: NDArray[np.bool_]

    def of(self, kind: LineKind | None = None, hidden: bool | None = None) -> Pieces:
        """Return the pieces of a kind, or those that are hidden, or not."""
        kept = np.ones(len(self.ends), bool)
        if kind is not None:
            kept &= self.kinds == KINDS.index(choose(kind, KINDS, "kind"))
        if hidden is not None:
            kept &= self.hidden == hidden
        return Pieces(self.ends[kept], self.kinds[kept], self.parts[kept], self.hidden[kept])

    @property
    def length(self) -> float:
        """The length of all, in millimetres."""
        steps = self.ends[:, 1] - self.ends[:, 0]
        return float(np.sqrt(steps[:, 0] * steps[:, 0] + steps[:, 1] * steps[:, 1]).sum())


def find_pieces(
    surfaces: Surfaces,
    projection: Projection,
    *,
    intersections: bool,
    threads: int,
    more_lines: list[Lines] | None = None,
    caps: list[NDArray[np.float64]] | None = None,
) -> Pieces:
    """Return the pieces of all lines that a view of surfaces shows.

    Parameters
    ----------
    surfaces : Surfaces
    projection : Projection
    intersections : bool
        Whether parts that run through each other have lines there.
    threads : int
    more_lines : list of Lines
        Other lines to draw, perhaps on the near plane.
    caps : list of (N, 3, 3) float64
        Other triangles that hide.
    """
    if not len(surfaces.places):
        return _no_pieces()
    cut = [surfaces.lines]
    if intersections:
        cut.append(surfaces.intersections(threads))
    others = joined_lines([*cut, *(more_lines or [])])
    planes = projection.planes(surfaces.bounds)
    eye = projection.eye()
    found = native.draw_view(
        surfaces.edges,
        *others,
        # What a section has in its plane lies on the near plane, which must not cut it off.
        sum(len(lines.kinds) for lines in cut),
        *_hiders(surfaces, planes, caps or []),
        projection.clip_from_world,
        projection.size,
        eye,
        projection.is_parallel,
        projection.is_parallel or _is_beside(eye, surfaces.bounds),
        planes,
        surfaces.thickness,
        min(_ONE_STROKE, _MOST_SHARE * max(projection.size)),
        OUTLINE,
        threads,
    )
    return Pieces(*found)


@np.errstate(all="ignore")
def _is_beside(eye: list[float], bounds: NDArray[np.float64]) -> bool:
    """Return whether a viewer is outside of a box."""
    place = np.divide(eye[:3], eye[3])
    return bool(((place < bounds[0]) | (place > bounds[1])).any())


def _hiders(
    surfaces: Surfaces, planes: NDArray[np.float64], caps: list[NDArray[np.float64]]
) -> tuple[NDArray[np.float64] | None, NDArray[np.int32] | None]:
    """Return the places and triangles that hide lines; none if they are those of the surfaces."""
    if not caps and are_before(surfaces.bounds, planes):
        return None, None
    places, faces, _ = clip_triangles(surfaces.places, surfaces.faces, planes)
    for cap in caps:
        corners = np.arange(3 * len(cap), dtype=np.int32).reshape(-1, 3) + np.int32(len(places))
        faces = np.concatenate([faces, corners])
        places = np.concatenate([places, cap.reshape(-1, 3)])
    return np.ascontiguousarray(places), np.ascontiguousarray(faces)


def _no_pieces() -> Pieces:
    return Pieces(
        np.zeros((0, 2, 2)), np.zeros(0, np.int8), np.zeros(0, np.int32), np.zeros(0, bool)
    )

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
from ...choices import LineKind
from .clipping import clip_lines, clip_triangles
from .line_kinds import KINDS
from .model_lines import Lines, edge_lines, intersection_lines, joined_lines
from .projections import Projection
from .surfaces import Surfaces

#: Lines within this share of the largest coordinate from a plane lie on it. Coordinates are rounded
#: to 24 bits.
_THICKNESS = 2.0**-21
#: Triangles reach beyond their sides by this share of that, so that no line shows through a seam:
#: more than rounding in float64, but no more, as lines may run almost along a side.
_REACH = 2.0**-22
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
            kept &= self.kinds == KINDS.index(kind)
        if hidden is not None:
            kept &= self.hidden == hidden
        return Pieces(*(column[kept] for column in self))

    @property
    def length(self) -> float:
        """The length of all, in millimetres."""
        steps = self.ends[:, 1] - self.ends[:, 0]
        return float(np.sqrt(steps[:, 0] * steps[:, 0] + steps[:, 1] * steps[:, 1]).sum())


class Hiders(NamedTuple):
    """The triangles that hide lines.

    Attributes
    ----------
    places : (V, 3) float64
    faces : (F, 3) int32
    thickness : float
        World units: a line so near a triangle's plane lies on it.
    """

    places: NDArray[np.float64]
    faces: NDArray[np.int32]
    thickness: float


@np.errstate(all="ignore")
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
    bounds = _bounds(surfaces.places)
    planes = projection.planes(bounds)
    places, faces, sources = clip_triangles(surfaces.places, surfaces.faces, planes)
    thickness = _THICKNESS * float(np.abs(bounds).max())
    lines = [edge_lines(surfaces, projection.eye())]
    if intersections:
        bodies = native.find_bodies(surfaces.faces, len(surfaces.places))
        if len(bodies) and (bodies != bodies[0]).any():
            crossed = native.cross_surfaces(places, faces, bodies[sources], thickness, threads)
            lines.append(intersection_lines(crossed, surfaces.parts[sources]))
    lines = [clipped(each, planes) for each in lines]
    # What a section has in its plane lies on the near plane, which must not cut it off.
    lines += [clipped(each, planes[1:]) for each in more_lines or []]
    for cap in caps or []:
        corners = np.arange(3 * len(cap), dtype=np.int32).reshape(-1, 3) + len(places)
        faces = np.concatenate([faces, corners.astype(np.int32)])
        places = np.concatenate([places, cap.reshape(-1, 3)])
    hiders = Hiders(places, faces, thickness)
    seen = clipped(joined_lines(lines), projection.sides())
    return hidden_pieces(seen, hiders, projection, threads)


def clipped(lines: Lines, planes: NDArray[np.float64]) -> Lines:
    """Return what is left of lines before planes."""
    ends, sources = clip_lines(lines.ends, planes)
    return Lines(ends, lines.kinds[sources], lines.parts[sources])


def hidden_pieces(lines: Lines, hiders: Hiders, projection: Projection, threads: int) -> Pieces:
    """Return the pieces of lines before and behind triangles, each stroke once."""
    line_paper = projection.on_paper(lines.ends.reshape(-1, 3)).reshape(-1, 2, 4)
    nothing = hiders.thickness * projection.scale_at(line_paper[..., 2])
    found = native.hide_lines(
        hiders.places,
        projection.on_paper(hiders.places),
        hiders.faces,
        projection.eye(),
        hiders.thickness,
        _REACH * nothing,
        lines.ends,
        line_paper,
        nothing,
        threads,
    )
    pieces = _pieces_of(found, line_paper[..., :2], lines)
    nearness = min(_ONE_STROKE, _MOST_SHARE * max(projection.size))
    return _each_once(pieces, max(nearness, 2.0 * nothing), threads)


def _pieces_of(found: NDArray[np.void], paper: NDArray[np.float64], lines: Lines) -> Pieces:
    rows = found["line"]
    a, b = paper[rows, 0], paper[rows, 1]
    shares = (found[name][:, np.newaxis] for name in ("from", "to"))
    ends = np.stack([a * (1.0 - share) + b * share for share in shares], axis=1)
    return Pieces(ends, lines.kinds[rows], lines.parts[rows], found["is_hidden"] != 0)


def _each_once(pieces: Pieces, tolerance: float, threads: int) -> Pieces:
    """Return the pieces without what lies on more important ones: visible ones come first."""
    order = np.lexsort([pieces.kinds, pieces.hidden])
    pieces = Pieces(*(column[order] for column in pieces))
    found = native.hide_repeated(pieces.ends.reshape(-1, 4), tolerance, threads)
    found = found[found["is_hidden"] == 0]
    lines = Lines(np.zeros((len(order), 2, 3)), pieces.kinds, pieces.parts)
    kept = _pieces_of(found, pieces.ends, lines)
    return kept._replace(hidden=pieces.hidden[found["line"]])


def _bounds(places: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([places.min(axis=0), places.max(axis=0)])


def _no_pieces() -> Pieces:
    return Pieces(
        np.zeros((0, 2, 2)), np.zeros(0, np.int8), np.zeros(0, np.int32), np.zeros(0, bool)
    )

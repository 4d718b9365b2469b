"""The lines of a view: which edges of surfaces a drawing shows, before anything hides them.

In: surfaces, and the point from which they are seen. Out: lines in the world, with kind and part.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from .line_kinds import BORDER, CREASE, INTERSECTION, LINE, OUTLINE, SECTION
from .mesh_edges import face_normals
from .surfaces import Surfaces

#: Triangles are seen from the front if the angle to the line of sight has at least this sine.
_EDGE_ON = 1e-6


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
    return Lines(*(np.concatenate(columns) for columns in zip(*several, strict=True)))


def lines_of(ends: NDArray[np.float64], kind: int, parts: NDArray[np.int32]) -> Lines:
    """Return lines of one kind."""
    return Lines(ends, np.full(len(ends), kind, np.int8), parts)


@np.errstate(all="ignore")
def edge_lines(surfaces: Surfaces, eye: NDArray[np.float64]) -> Lines:
    """Return the outlines, borders and creases of surfaces, and the model's own lines.

    Parameters
    ----------
    surfaces : Surfaces
    eye : (4,) float64
        The viewer's position and 1, or the direction to him and 0.
    """
    fronts = _fronts(surfaces, eye)
    has_two = surfaces.beside[:, 1] >= 0
    first, second = fronts[surfaces.beside].T
    outlines = has_two & (first != (second ^ surfaces.turned))
    shown = np.flatnonzero(outlines | surfaces.creases | surfaces.borders)
    kinds = np.where(surfaces.borders[shown], BORDER, CREASE).astype(np.int8)
    kinds[outlines[shown]] = OUTLINE
    places = surfaces.places
    edges = Lines(places[surfaces.ends[shown]], kinds, surfaces.parts[surfaces.beside[shown, 0]])
    return joined_lines([edges, lines_of(places[surfaces.lines], LINE, surfaces.line_parts)])


def _fronts(surfaces: Surfaces, eye: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which triangles are seen from the front, (F,)."""
    if not len(surfaces.faces):
        return np.zeros(1, bool)
    normals, is_flat = face_normals(surfaces.places, surfaces.faces)
    to_eye = eye[:3] - surfaces.places[surfaces.faces[:, 0]] * eye[3]
    sines = linalg.dot(normals, to_eye) / linalg.length(to_eye)
    fronts: NDArray[np.bool_] = (sines > _EDGE_ON) & ~is_flat
    return fronts


def intersection_lines(crossings: NDArray[np.void], parts: NDArray[np.int32]) -> Lines:
    """Return the lines in which surfaces cross; each belongs to the part of its first triangle.

    Parameters
    ----------
    crossings : (S,) of `CROSSING`
    parts : (F,) int32
        Of the triangles.
    """
    ends = crossings["ends"].reshape(-1, 2, 3)
    return lines_of(ends, INTERSECTION, parts[crossings["faces"][:, 0]])


def section_lines(segments: NDArray[np.float64], part: int) -> Lines:
    """Return the outlines (N, 2, 3) of a cut part."""
    return lines_of(segments, SECTION, np.full(len(segments), part, np.int32))

"""How the faces of a surface meet: edges with one face, with two, with more; what hangs together.

In: faces over points that each occur once. Out: `Edges`, and the part that each face belongs to.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..geometry.topology import components, half_edges


class Edges(NamedTuple):
    """The edges of a surface, each once.

    Attributes
    ----------
    ends : (E, 2) ndarray of int64
        The points that an edge joins, the smaller number first.
    counts : (E,) ndarray of int64
        How many faces an edge has.
    pairs : (P, 2) ndarray of int64
        Those two faces, where an edge has two.
    opposed : (P,) ndarray of bool
        Whether these two run along the edge in opposite directions, as neighbours do that show the
        same side.
    """

    ends: NDArray[np.int64]
    counts: NDArray[np.int64]
    pairs: NDArray[np.int64]
    opposed: NDArray[np.bool_]

    @property
    def are_closed(self) -> bool:
        """Whether each edge has two faces, of opposite directions, so that there is an inside."""
        return bool((self.counts == 2).all() and self.opposed.all())


def edges_of(faces: NDArray[np.int64]) -> Edges:
    """Return the edges of faces (F, 3), whose corners are three different points each."""
    sides = half_edges(faces)
    forward = sides[:, 0] < sides[:, 1]
    low, high = sides.min(axis=1), sides.max(axis=1)
    order = np.lexsort((high, low))
    low, high = low[order], high[order]
    new = np.ones(len(order), bool)
    new[1:] = (low[1:] != low[:-1]) | (high[1:] != high[:-1])
    starts = np.flatnonzero(new)
    counts = np.diff(np.append(starts, len(order)))
    first = starts[counts == 2]
    pairs = np.stack([order[first], order[first + 1]], axis=1)
    opposed = forward[pairs[:, 0]] != forward[pairs[:, 1]]
    return Edges(np.stack([low[starts], high[starts]], axis=1), counts, pairs // 3, opposed)


def parts_of(faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the part of each face, (F,): faces that share a point are in one part.

    Parts are numbered by their first faces, from 0 on.
    """
    owners = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(faces.ravel(), kind="stable")
    points, owners = faces.ravel()[order], owners[order]
    same = points[1:] == points[:-1]
    label = components(len(faces), owners[:-1][same], owners[1:][same])
    _, numbers = np.unique(label, return_inverse=True)
    return numbers

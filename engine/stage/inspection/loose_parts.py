"""The parts of a single mesh: its named groups of faces, or else the pieces that hang together.

In: a mesh. Out: the faces of each part. A piece whose faces look inward is a hollow of the piece
around it, and stays with it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.language import translated
from ...model.geometry.mesh import Mesh
from ...model.measuring.edges import parts_of
from ...model.measuring.surfaces import surface_of

#: More pieces are not taken apart one by one: the smallest stay together.
MOST_PARTS = 400


class LoosePart(NamedTuple):
    """A part of a mesh: its name, and which faces belong to it, (F,) bool."""

    name: str
    faces: NDArray[np.bool_]


def loose_parts(mesh: Mesh) -> list[LoosePart]:
    """Return the parts of a mesh, one or more; each face is in one of them."""
    named = _named_parts(mesh)
    if len(named) > 1:
        return named
    numbers = _pieces(mesh)
    count = int(numbers.max(initial=-1)) + 1
    names = [translated("piece {number}", number=k + 1) for k in range(count)]
    return [LoosePart(name, numbers == k) for k, name in enumerate(names)]


def _named_parts(mesh: Mesh) -> list[LoosePart]:
    """Return the groups of a mesh, each face in the first one that has it; then the rest."""
    free, found = np.ones(len(mesh.faces), bool), []
    for name, faces in mesh.groups.items():
        own = np.zeros(len(free), bool)
        own[faces] = True
        own &= free
        if own.any():
            found.append(LoosePart(name, own))
            free &= ~own
    if free.any():
        found.append(LoosePart("rest", free))
    return found if len(found) <= MOST_PARTS else []


def _pieces(mesh: Mesh) -> NDArray[np.int64]:
    """Return the piece of each face, (F,)."""
    surface = surface_of(mesh)
    if not len(surface.faces):
        return np.zeros(len(mesh.faces), np.int64)
    pieces = parts_of(surface.faces)
    pieces = _with_hollows(pieces, surface.corners)
    _, pieces, sizes = np.unique(pieces, return_inverse=True, return_counts=True)
    ranks = np.empty(len(sizes), np.int64)
    ranks[np.argsort(-sizes, kind="stable")] = np.arange(len(sizes))
    numbers = np.zeros(len(mesh.faces), np.int64)
    numbers[surface.numbers] = np.minimum(ranks[pieces.reshape(-1)], MOST_PARTS - 1)
    return numbers


def _with_hollows(pieces: NDArray[np.int64], corners: NDArray[np.float64]) -> NDArray[np.int64]:
    """Give each piece that looks inward the number of the smallest piece whose box holds it."""
    count = int(pieces.max()) + 1
    a, b, c = (corners[:, k] - corners.mean(axis=(0, 1)) for k in range(3))
    volumes = np.bincount(pieces, linalg.dot(a, linalg.cross(b, c)), count)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, pieces, corners.min(axis=1))
    np.maximum.at(high, pieces, corners.max(axis=1))
    owners = np.arange(count)
    # No more than the largest pieces come apart, and only they hold hollows.
    solid = np.flatnonzero(volumes > 0.0)
    sizes = np.bincount(pieces, minlength=count)
    solid = solid[np.argsort(-sizes[solid], kind="stable")[:MOST_PARTS]]
    for hollow in np.flatnonzero(volumes < 0.0).tolist():
        around = solid[((low[solid] <= low[hollow]) & (high[solid] >= high[hollow])).all(axis=1)]
        if len(around):
            owners[hollow] = around[np.argmin(volumes[around])]
    return owners[pieces]

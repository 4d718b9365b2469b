"""Meshes with poses, as the objects of a `Document`.

In: parts, several of which may share a mesh. Out: one object each, as it is or with its pose
applied. Any number of nodes may repeat a mesh, so that joined they are limited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import FileFormatError
from ...model.geometry.posing import posed_mesh
from .documents import DocumentObject
from .sources import Source
from .text import shown

if TYPE_CHECKING:
    from ...model.geometry.mesh import Mesh

# A file's meshes may hold so many numbers, and its nodes may repeat so many vertices, and besides
# as many as it has bytes. Assign another value to change it.
MAX_REPEATED = 1 << 20
# The last row of a pose may differ so much from 0 0 0 1 after rounding to float32.
_ROUNDING = 1e-5
_LAST_ROW = (0.0, 0.0, 0.0, 1.0)


class PosedPart(NamedTuple):
    """A `DocumentObject` that has a pose."""

    name: str
    mesh: Mesh
    pose: np.ndarray


def document_objects(
    source: Source, parts: list[PosedPart], most_vertices: int, split: bool
) -> list[DocumentObject]:
    """Return one object for each part.

    Parameters
    ----------
    source : Source
    parts : list of PosedPart
    most_vertices : int
        How many vertices all parts may have if their poses are applied.
    split : bool
        Keep the poses apart, and meshes shared.

    Raises
    ------
    FileFormatError
        A pose is not affine, there are too many vertices or none.
    """
    parts = [part._replace(pose=without_rounding(part.pose)) for part in parts]
    for part in parts:
        if not (np.isfinite(part.pose).all() and np.array_equal(part.pose[3], _LAST_ROW)):
            raise FileFormatError(f"node {shown(part.name)} has no affine pose", source.path)
    vertices = sum(len(part.mesh.positions) for part in parts)
    if not vertices:
        raise FileFormatError("no vertices in this file", source.path)
    if not split and vertices > most_vertices:
        raise FileFormatError(
            f"{vertices} vertices where meshes are repeated: one mesh of them is limited to "
            f"{most_vertices}; load_scene keeps the meshes apart",
            source.path,
        )
    if split:
        return [DocumentObject(*part) for part in parts]
    return [DocumentObject(part.name, posed_mesh(part.mesh, part.pose)) for part in parts]


def without_rounding(pose: np.ndarray) -> np.ndarray:
    """Return a (4, 4) pose with the last row of an affine one, if it has it but for rounding."""
    if pose[3].tolist() == [*_LAST_ROW] or not np.abs(pose[3] - _LAST_ROW).max() <= _ROUNDING:
        return pose
    return np.vstack([pose[:3], _LAST_ROW])


def counts_of(objects: list[DocumentObject]) -> dict[str, Any]:
    """Return the lists that the objects hold, as `Document.counts` shows them."""
    return {
        "vertices": sum(len(entry.mesh.positions) for entry in objects),
        "faces": sum(len(entry.mesh.faces) for entry in objects),
        "triangles": sum(len(entry.mesh.faces) for entry in objects),
        "objects": [entry.name for entry in objects],
    }

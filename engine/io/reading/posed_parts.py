"""Meshes with poses, as the objects of a `Document`.

In: parts, several of which may share a mesh. Out: one object each, with its pose kept or applied.
Since any number of nodes may repeat a mesh, the joined size is limited.
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

# Base limit for the numbers of a file's meshes and the vertices its nodes repeat; the file's size
# in bytes is added. Assignable.
MAX_REPEATED = 1 << 20
# Tolerance for the last row of a pose, 0 0 0 1, after rounding to float32.
_ROUNDING = 1e-5
_LAST_ROW = (0.0, 0.0, 0.0, 1.0)


class PosedPart(NamedTuple):
    """A `DocumentObject` with a pose."""

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
        The limit of the total vertices if poses are applied.
    split : bool
        Whether to keep poses separate and meshes shared.

    Raises
    ------
    FileFormatError
        A pose is not affine, or there are no vertices or too many.
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
    """Return a (4, 4) pose with an exactly affine last row, if it is affine up to rounding."""
    if pose[3].tolist() == [*_LAST_ROW] or not np.abs(pose[3] - _LAST_ROW).max() <= _ROUNDING:
        return pose
    return np.vstack([pose[:3], _LAST_ROW])


def counts_of(objects: list[DocumentObject]) -> dict[str, Any]:
    """Return the sizes of the objects' lists, for `Document.counts`."""
    return {
        "vertices": sum(len(entry.mesh.positions) for entry in objects),
        "faces": sum(len(entry.mesh.faces) for entry in objects),
        "triangles": sum(len(entry.mesh.faces) for entry in objects),
        "objects": [entry.name for entry in objects],
    }

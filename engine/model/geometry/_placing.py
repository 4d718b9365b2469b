"""Moves the vertices of a mesh by a matrix that a program gives.

In: a mesh and a matrix, neither checked. Out: another mesh, with everything that the first has.
"""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from ...base.linalg import inverse
from ...base.validation import matrix4
from ...errors import InvalidArgumentError
from .posing import posed_mesh

if TYPE_CHECKING:
    from .mesh import Mesh


def transformed_mesh(mesh: Mesh, matrix: ArrayLike) -> Mesh:
    """Return a mesh moved by a matrix; see `Mesh.transformed`."""
    pose = matrix4(matrix, "matrix")
    if pose[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise InvalidArgumentError("matrix must be affine: its last row is 0 0 0 1")
    inverse(pose)  # raises where there is none
    if mesh.joints is not None or mesh.morph_targets:
        raise InvalidArgumentError(
            f"{mesh!r} has joints or morph targets: set the pose of its node or its joints instead"
        )
    moved = posed_mesh(mesh, pose)
    moved = copy.copy(mesh) if moved is mesh else moved
    moved.warnings = list(mesh.warnings)
    return moved

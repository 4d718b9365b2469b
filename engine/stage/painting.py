"""Draws all of a model in one material, without changing the model.

In: a mesh, or instances of one. Out: a copy that shares its arrays, in one material.
"""

from __future__ import annotations

import copy

import numpy as np

from ..errors import InvalidArgumentError
from ..model.geometry.mesh import Mesh
from ..model.materials.material import Material
from ..model.scene.instances import InstancedMesh


def painted(thing: Mesh | InstancedMesh, material: Material) -> Mesh | InstancedMesh:
    """Return a mesh, or instances of one, in one material and without colours of their own."""
    if isinstance(thing, InstancedMesh):
        return InstancedMesh(_painted_mesh(thing.mesh, material), thing.poses)
    return _painted_mesh(thing, material)


def dress(mesh: Mesh, material: Material) -> None:
    """Give all faces of a mesh one material."""
    mesh.material_ids = np.zeros(len(mesh.faces), np.int32)
    mesh.materials = [material]


def check_material(value: Material | None) -> Material | None:
    """Return the material that replaces a model's own, checked; None keeps them.

    Raises
    ------
    InvalidArgumentError
    """
    if value is not None and not isinstance(value, Material):
        raise InvalidArgumentError(
            f"material must be a Material or None, not {type(value).__name__}"
        )
    return value


def _painted_mesh(mesh: Mesh, material: Material) -> Mesh:
    twin = copy.copy(mesh)
    dress(twin, material)
    twin.colors = None
    return twin

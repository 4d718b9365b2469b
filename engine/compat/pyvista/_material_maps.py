"""The maps of a physical material of VTK, and what of such a material is not drawn.

In: a ``vtkProperty`` and the ``vtkPolyData`` that has it. Out: `Maps`, materials, and warnings.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from ...errors import warn
from ...model.materials.material import Material
from ._parts import Maps, Part
from ._scalar_colors import texture_of

#: Textures that change normals: VTK draws them where points have tangents.
_OF_TANGENTS = {"normalTex": "normal maps", "coatNormalTex": "normal maps of clear coats"}


def uvs_of(coordinates: Any) -> NDArray[np.float32]:
    """Return texture coordinates, (V, 2) float32."""
    return vtk_to_numpy(coordinates)[:, :2].astype(np.float32)


def maps_of(given: Any, data: Any) -> Maps | None:
    """Return the maps of a physical material; None where it has none."""
    _tell_undrawn(given, data)
    found = [given.GetTexture(name) for name in ("materialTex", "emissiveTex")]
    coordinates = data.GetPointData().GetTCoords()
    if coordinates is None or not any(found):
        return None
    material, emissive = (None if one is None else texture_of(one) for one in found)
    return Maps(uvs_of(coordinates), material, emissive)


def make_physical(material: Material, part: Part) -> None:
    """Give a material what a part's physical look says of mirrored light."""
    look = part.look
    material.metallic, material.roughness = look.metallic, look.roughness
    root = math.sqrt(look.base_reflectance)
    material.ior = (1.0 + root) / max(1.0 - root, 1e-6)
    if part.maps is not None:
        material.metallic_roughness_texture = part.maps.material
    if look.coat is not None:
        material.clearcoat, material.clearcoat_roughness = look.coat.strength, look.coat.roughness


def _tell_undrawn(given: Any, data: Any) -> None:
    undrawn = []
    if data.GetPointData().GetTangents() is not None:
        undrawn += [what for name, what in _OF_TANGENTS.items() if given.GetTexture(name)]
    if given.GetAnisotropy() > 0.0:
        undrawn.append("anisotropy")
    for what in undrawn:
        warn(f"engine3d does not draw {what} of physical materials")

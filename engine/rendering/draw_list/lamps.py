"""Finds the meshes that are the glowing parts of lamps: their own light passes through them.

In: an up-to-date scene, and one of its point or spot lights. Out: the slots of nodes that cast no
shadow of this light, though they cast those of other lights.

A bulb would otherwise block the light inside it. A mesh whose box contains the light lets it pass
if it emits light, or is unlit, and its node is above or below that of the light in the tree; or,
wherever it is in the tree, if it emits all over and the light is in the middle half of its box.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..._native.scene_graph import SHOWN
from ...model.materials.material import Material
from ...model.scene.staged_data import AnyData, NodeRows


def lamp_slots(data: AnyData, light: int, place: Sequence[float]) -> tuple[int, ...]:
    """Return the slots of the nodes that let a light pass.

    Parameters
    ----------
    data : SceneData or StagedData
    light : int
        The slot of the light's node.
    place : (3,) sequence of float
        The light's position, in world space.
    """
    arrays, objects = data.arrays, data.objects.objects
    columns, count = arrays.columns, arrays.count
    low, high = columns["bounds"][:count, :3], columns["bounds"][:count, 3:6]
    holds = ((low <= place) & (high >= place)).all(axis=1)
    holds &= (columns["flags"][:count] & SHOWN != 0) & (columns["object"][:count] >= 0)
    found = []
    for slot in np.flatnonzero(holds).tolist():
        shape = objects[columns["object"][slot]]
        materials = getattr(shape, "mesh", shape).materials
        if any(_emits(one) or one.unlit for one in materials):
            middle, size = (low[slot] + high[slot]) / 2, high[slot] - low[slot]
            is_amid = bool((np.abs(place - middle) <= size / 4).all())
            is_kin = _is_above(arrays, slot, light) or _is_above(arrays, light, slot)
            if is_kin or (is_amid and all(map(_glows, materials))):
                found.append(slot)
    return tuple(found)


def _emits(material: Material) -> bool:
    strength = material.emissive_strength if material.is_physical else 1.0
    return strength > 0.0 and any(component > 0 for component in material.emissive)


def _glows(material: Material) -> bool:
    """Return whether a material emits everywhere, which rules out emissive textures."""
    return _emits(material) and material.emissive_texture is None


def _is_above(arrays: NodeRows, slot: int, other: int) -> bool:
    """Return whether a node is an ancestor of another."""
    parents = arrays.columns["parent"]
    while other >= 0 and other != slot:
        other = int(parents[other])
    return other == slot

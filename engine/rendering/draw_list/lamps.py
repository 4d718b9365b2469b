"""Finds the meshes that are the glowing parts of lamps: they let their lamp's light pass.

In: a scene that is up to date, a point or spot light of it. Out: the slots of nodes that cast no
shadow of this light, though they cast those of others.

A light that stands in a bulb would light nothing, if the bulb kept it in. A mesh whose box holds
the light lets it pass if it emits and its node is above or below that of the light in the tree; or,
wherever it is in the tree, if it glows all over and the light is in the middle half of its box.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..._native.scene_graph import SHOWN
from ...model.materials.material import Material
from ...model.scene.staged_data import AnyData, NodeRows


def lamp_slots(data: AnyData, light: int, place: Sequence[float]) -> tuple[int, ...]:
    """Return the slots of what lets a light pass.

    Parameters
    ----------
    data : SceneData or StagedData
    light : int
        The slot of the light's node.
    place : (3,) sequence of float
        Of the light, in world space.
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
        if any(map(_emits, materials)):
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
    """Whether a material emits all over, as a texture can't tell."""
    return _emits(material) and material.emissive_texture is None


def _is_above(arrays: NodeRows, slot: int, other: int) -> bool:
    """Whether a node is above another one in the tree."""
    parents = arrays.columns["parent"]
    while other >= 0 and other != slot:
        other = int(parents[other])
    return other == slot

"""The resources of scenes: meshes, materials, textures, and how many nodes use each.

In: scenes. Out: counts. Nodes that share an object are counted together, so that the cost depends
on the number of distinct objects, not of nodes.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ..._native.scene_graph import ALIVE
from ..geometry.mesh import Mesh
from ..materials.material import textures_of
from ..motion.posed_mesh import PosedMesh
from .instances import InstancedMesh
from .nodes import Node
from .scene import Scene


def uses_in(scenes: Iterable[Scene]) -> dict[Any, int]:
    """Return how many nodes use each mesh, material and texture, in order of their numbers."""
    uses: dict[Any, int] = {}
    for scene in scenes:
        arrays = scene.data.arrays
        columns = {name: arrays.columns[name][: arrays.count] for name in ("object", "flags")}
        drawn = columns["object"][(columns["flags"] & ALIVE != 0) & (columns["object"] >= 0)]
        counts = np.bincount(drawn, minlength=len(scene.data.objects.objects)).tolist()
        for obj, count in zip(scene.data.objects.objects, counts, strict=False):
            for thing in resources_of(obj):
                uses[thing] = uses.get(thing, 0) + count
    return uses


def users_of(scene: Scene, thing: Any) -> tuple[Node, ...]:
    """Return the nodes that use a mesh, material or texture, in scene order."""
    numbers = {n for n, obj in enumerate(scene.data.objects.objects) if thing in resources_of(obj)}
    arrays = scene.data.arrays
    rows = np.flatnonzero(np.isin(arrays.columns["object"][: arrays.count], list(numbers)))
    nodes = (arrays.nodes[row] for row in rows.tolist())
    return tuple(node for node in nodes if node is not None)


def resources_of(obj: Any) -> dict[Any, None]:
    """Return the mesh, materials and textures of a node's object, each once."""
    mesh = obj.mesh if isinstance(obj, (InstancedMesh, PosedMesh)) else obj
    if not isinstance(mesh, Mesh):
        return {}
    found: dict[Any, None] = {mesh: None}
    for material in mesh.materials:
        found[material] = None
        found.update(dict.fromkeys(textures_of(material).values()))
    return found

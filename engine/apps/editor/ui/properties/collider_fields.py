"""The fields of colliders, by which physics and queries find nodes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .....base.language import translated, translated_choice
from .....model.geometry.mesh import Mesh
from .....model.scene.nodes import Node
from .....model.spatial.colliders import BoxCollider, Collider, MeshCollider, SphereCollider
from .fields import MOST_COMPARED, Fields, name_of
from .shape_fields import mesh_of

COLLIDERS = {
    "none": lambda mesh: None,
    "box": lambda mesh: BoxCollider(),
    "sphere": lambda mesh: SphereCollider(*_ball(mesh)),
    "mesh": lambda mesh: MeshCollider(),
}
KINDS = {BoxCollider: "box", SphereCollider: "sphere", MeshCollider: "mesh"}
_LEAST = 1e-6


def draw_colliders(fields: Fields, nodes: Sequence[Node]) -> None:
    """Lay out the colliders of nodes that hold meshes."""
    has_any = any(node.collider is not None for node in nodes[-MOST_COMPARED:])
    if not fields.folder("Collider", is_open=has_any):
        return
    is_mesh = all(isinstance(node.object, Mesh) for node in nodes)
    kinds = COLLIDERS if is_mesh else ("none", "sphere")  # others need a mesh of the node's own
    now = name_of(_kind(node.collider) for node in nodes)
    chosen = fields.choice("Kind", now, [(name, name) for name in kinds], "collider")
    if chosen is not None and chosen != now:
        make = COLLIDERS[chosen]
        each = [(node, {"collider": make(mesh_of(node.object))}) for node in nodes]
        kind = translated_choice("collider", chosen)
        fields.set_each(each, translated("Set the collider to {kind}", kind=kind))
    if now == "sphere" and len(nodes) <= MOST_COMPARED:
        _draw_radius(fields, nodes)


def _draw_radius(fields: Fields, nodes: Sequence[Node]) -> None:
    balls: list[Any] = [node.collider for node in nodes]
    rows = [[ball.radius] for ball in balls]
    changed = fields.numbers("Radius", rows, max(0.01 * rows[-1][0], _LEAST), low=_LEAST)
    if changed is not None:
        new = [SphereCollider(changed[0], ball.center) for ball in balls]
        fields.drag((node, {"collider": ball}) for node, ball in zip(nodes, new, strict=True))


def _kind(collider: Collider | None) -> str:
    return "none" if collider is None else KINDS[type(collider)]


def _ball(mesh: Mesh) -> tuple[float, np.ndarray]:
    """Return radius and centre of a sphere as wide as a mesh."""
    low, high = mesh.bounds
    return max(float(np.max(high - low)) / 2, _LEAST), (low + high) / 2

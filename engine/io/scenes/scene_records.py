"""Builds a scene from the tree of a scene file.

In: a `SceneRecord` with its meshes. Out: nodes with their objects, in file order. Faults raise a
`FileFormatError` that names the place.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields
from typing import Any

from ...errors import InvalidArgumentError
from ...model.environments.environment import Environment
from ...model.materials.linear_colors import floats_are_linear
from ...model.scene.fog import ExponentialFog, Fog
from ...model.scene.gradients import Gradient
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.surroundings import SCENE_VALUES
from ...model.spatial.colliders import BoxCollider, Collider, MeshCollider, SphereCollider
from ..formats.scene_tree import mesh_of
from ..reading.json_values import JsonValue
from .document_trees import Place, SceneRecord
from .motion_records import MOTION_KEYS, fill_animator
from .object_kinds import KINDS

_NODE_KEYS = {"name", "object", "translation", "rotation", "scale", "pose", "hidden", "static"}
_NODE_KEYS |= {"cast_shadows", "receive_shadows", "collider", "children", *MOTION_KEYS}


def fill_scene(scene: Scene, record: SceneRecord) -> None:
    """Add the nodes of a record to an empty scene, and apply its background and light.

    The floats of its colours are linear light.
    """
    with floats_are_linear():
        _fill(scene, record)


def _fill(scene: Scene, record: SceneRecord) -> None:
    values = record.values.members()
    full_rate_distance = values.pop("full_rate_distance", None)
    for key, value in values.items():
        if key not in SCENE_VALUES:
            raise value.error("is no property of a scene")
        held: Any = value.value
        if key == "environment" and held is not None:
            held = _environment(record, value)
        if key == "background" and isinstance(held, dict):
            held = _background(record, value)
        if key == "fog" and held is not None:
            held = _of_fields(value, (Fog, ExponentialFog))
        _try(value, lambda key=key, held=held: setattr(scene, key, held))
    objects = [_object(record, number) for number in range(len(record.objects))]
    pairs = zip(record.nodes, record.places, strict=True)
    nodes = [_node(scene, objects, entry, place) for entry, place in pairs]
    for number, children in record.children.items():
        for child in children:
            nodes[child].reparent(nodes[number])
    for node, entry in zip(nodes, record.nodes, strict=True):
        if (collider := entry.get("collider")) is not None:
            _try(collider, lambda n=node, c=collider: setattr(n, "collider", _collider(record, c)))
    if full_rate_distance is None:
        fill_animator(scene, nodes, record.nodes, math.inf)
    else:
        rate = full_rate_distance.value
        _try(full_rate_distance, lambda: fill_animator(scene, nodes, record.nodes, rate))


def _environment(record: SceneRecord, number: JsonValue) -> Environment | None:
    return record.environments[number.index(len(record.environments), "environments")]


def _background(
    record: SceneRecord, value: JsonValue
) -> Environment | Gradient | tuple[int, int, int]:
    if "environment" in value.members():
        return _environment(record, value.need("environment")) or (0, 0, 0)
    return _of_fields(value, (Gradient,))


def _of_fields(value: JsonValue, kinds: tuple[type, ...]) -> Any:
    """Return the one of several kinds of value whose parameters the entry has."""
    held = {key: one.value for key, one in value.members().items()}
    for kind in kinds:
        if held.keys() == {one.name for one in fields(kind)}:
            return _try(value, lambda kind=kind: kind(**held))
    expected = " or ".join(", ".join(one.name for one in fields(kind)) for kind in kinds)
    raise value.wrong(f"an object of {expected}")


def _try(place: JsonValue, do: Callable[..., Any]) -> Any:
    """Add the place in the file to errors within the block."""
    try:
        return do()
    except (InvalidArgumentError, TypeError) as error:
        raise place.error(str(error)) from None


def _object(record: SceneRecord, number: int) -> Any:
    if number in record.meshes:
        return record.meshes[number]
    entry = record.objects[number]
    kind = entry.need("kind")
    if kind.value == "instances":
        return _instances(record, entry)
    if not (isinstance(kind.value, str) and kind.value in KINDS):
        raise kind.wrong(f"one of mesh, instances, {', '.join(KINDS)}")
    values = {key: held.value for key, held in entry.members().items() if key != "kind"}

    def make() -> Any:
        obj = KINDS[kind.value](**values)
        if hasattr(obj, "check"):
            obj.check()
        return obj

    return _try(entry, make)


def _instances(record: SceneRecord, entry: JsonValue) -> InstancedMesh:
    mesh, poses = mesh_of(record, entry.need("mesh")), entry.need("poses").array()
    colors = entry.get("colors")
    held = None if colors is None else colors.array()
    return _try(entry, lambda: InstancedMesh(mesh, poses, colors=held))


def _node(scene: Scene, objects: list[Any], entry: JsonValue, place: Place) -> Node:
    for key in entry.value:
        if key not in _NODE_KEYS:
            raise entry.need(key).error("is no property of a node")
    held, name = entry.get("object"), entry.get("name")
    obj = None if held is None else objects[held.index(len(objects), "objects")]
    node = _try(
        entry,
        lambda: scene.add(
            obj,
            name="" if name is None else name.text(),
            static=_is(entry, "static"),
            cast_shadows=_is(entry, "cast_shadows", usual=True),
            receive_shadows=_is(entry, "receive_shadows", usual=True),
            **place,
        ),
    )
    if _is(entry, "hidden"):
        node.visible = False
    return node


def _is(entry: JsonValue, key: str, *, usual: bool = False) -> bool:
    held = entry.get(key)
    return usual if held is None else held.flag()


def _collider(record: SceneRecord, entry: JsonValue) -> Collider:
    kind = entry.need("kind")
    values = {key: held.value for key, held in entry.members().items() if key != "kind"}
    if kind.value == "box":
        return BoxCollider(**values)
    if kind.value == "sphere":
        return SphereCollider(**values)
    if kind.value != "mesh":
        raise kind.wrong("one of box, sphere, mesh")
    mesh = entry.get("mesh")
    return MeshCollider(None if mesh is None else mesh_of(record, mesh))

"""Builds a scene from the tree of a file.

In: a `TreeRecord` with its meshes. Out: the nodes of its default scene with their objects: meshes,
shared as in the file, cameras, lights, skins, and clips for an `AnimationPlayer`. Content that
scenes cannot hold gives warnings.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar
from weakref import WeakKeyDictionary

import numpy as np

from ..._native.loaders import frozen
from ...base.near_words import meant
from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import floats_are_linear, linear
from ...model.materials.material import Material
from ...model.scene.cameras import Camera, OrthographicCamera, PerspectiveCamera
from ...model.scene.instances import InstancedMesh
from ...model.scene.lights import DIRECT_LIGHTS, Light, PointLight
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from .document_trees import (
    ClipRecord,
    LampRecord,
    LensRecord,
    NodeRecord,
    Place,
    PropertyRecord,
    RobotRecord,
    SkinRecord,
    TreeRecord,
)
from .object_kinds import parameters
from .tree_posing import shown_nodes

if TYPE_CHECKING:
    from ...model.motion.clips import Channel
    from ...model.motion.properties import PropertyChannel
    from ...model.motion.skins import Skin

#: The file's record of each object in a scene, for writing it again.
records: WeakKeyDictionary[Any, Any] = WeakKeyDictionary()
#: Pairs of properties, the first of which must be less.
_APART = (("znear", "zfar"), ("inner_cone_angle", "outer_cone_angle"))
#: Marks a node that holds an object its parent could not hold in addition.
FURTHER_PART = object()

_Record = TypeVar("_Record", LensRecord, LampRecord)


class MeshWords(NamedTuple):
    """A file's statements about a mesh, without a reference that would keep it alive.

    Attributes
    ----------
    morph_weights, variants, extras
        As in `MeshRecord`.
    variant_names : tuple of str
        The file's variant names.
    """

    morph_weights: tuple[float, ...]
    variants: dict[int, tuple[Material, ...]]
    extras: Any
    variant_names: tuple[str, ...]


class InstanceWords(NamedTuple):
    """A file's statements about instances.

    Attributes
    ----------
    poses : (N, 4, 4) float32
        The identical array of the instances at loading.
    parts : tuple of arrays or None
        As in `NodeRecord`.
    """

    poses: Any
    parts: tuple[np.ndarray, np.ndarray, np.ndarray] | None


def choose_variant(tree: TreeRecord | None, variant: str | int) -> None:
    """Apply a variant's materials to the meshes of a tree.

    Raises
    ------
    InvalidArgumentError
    """
    names = () if tree is None else tree.variants
    number = (
        variant
        if isinstance(variant, int)
        else next((index for index, name in enumerate(names) if name == variant), -1)
    )
    if tree is None or not 0 <= number < len(names):
        known = f" (there are: {', '.join(map(repr, names))})" if names else ": the file has none"
        hint = meant(variant, names) if isinstance(variant, str) else ""
        raise InvalidArgumentError(f"no variant {shown(variant)}{known}{hint}")
    for record in tree.meshes:
        for part in record.parts:
            if number in part.variants:
                part.mesh.materials = part.variants[number]


def fill_from_tree(scene: Scene, tree: TreeRecord) -> None:
    """Add the nodes of a tree's default scene to an empty scene, and its clips."""
    records[scene] = tree.extras
    _Filling(scene, tree).fill()


class _Filling:
    """Creates each object of a tree once."""

    def __init__(self, scene: Scene, tree: TreeRecord) -> None:
        self._scene, self._tree = scene, tree
        self._instances: dict[tuple[int, ...], InstancedMesh] = {}  # by the IDs of their arrays
        # Cameras, lights and skins by number; None for those left out.
        self._things: dict[tuple[str, int], Camera | Light | None] = {}
        self._skins: dict[int, Skin | None] = {}
        self._nodes: dict[int, Node] = {}  # by number in the tree
        self._parts: dict[int, list[Node]] = {}  # the nodes that show parts of their meshes
        self._keys: dict[int, tuple[np.ndarray, np.ndarray]] = {}  # by the IDs of the first

    def fill(self) -> None:
        """Add everything to the scene."""
        for node in shown_nodes(self._tree):
            self._add(node.number, self._nodes.get(node.parent))
        self._add_skins()
        if self._tree.robot is not None:
            self._add_robot(self._tree.robot)
        for number, clip in enumerate(self._tree.clips):
            self._add_clip(clip, number)

    def _add(self, index: int, parent: Node | None) -> None:
        record = self._tree.nodes[index]
        held = [*self._meshes(record), *self._placed(record)]
        # One of our nodes holds one object; further objects become child nodes.
        first, others = (held[0], held[1:]) if held else (None, [])
        node = self._scene.add(first, name=record.name, parent=parent, **_place(record))
        node.visible = record.visible
        # Keep what the node itself cannot hold; with very many nodes, such records take as much
        # memory.
        if any(x is not None for x in (record.extras, record.rotation, record.matrix)):
            records[node] = record
        self._nodes[index] = node
        shows = [node] if isinstance(first, (Mesh, InstancedMesh)) else []
        for number, obj in enumerate(others, start=1):
            below = self._scene.add(obj, name=f"{record.name}_{number}", parent=node)
            records[below] = FURTHER_PART
            shows += [below] if isinstance(obj, (Mesh, InstancedMesh)) else []
        if shows:
            self._parts[index] = shows
            self._set_weights(record, shows)

    def _meshes(self, record: NodeRecord) -> list[Mesh | InstancedMesh]:
        parts = self._tree.parts(record)
        meshes = [part.mesh for part in parts if len(part.mesh.positions)]
        for part in parts:
            said = MeshWords(part.morph_weights, part.variants, part.extras, self._tree.variants)
            records.setdefault(part.mesh, said)
        poses = record.instances
        if poses is None:
            return [*meshes]
        return [self._instanced(mesh, poses, record) for mesh in meshes]

    def _instanced(self, mesh: Mesh, poses: np.ndarray, record: NodeRecord) -> InstancedMesh:
        """Return the instances of a mesh, shared by nodes with equal ones."""
        colors = record.instance_colors
        key = id(mesh), id(poses), id(colors)
        if key not in self._instances:
            held = None if colors is None else linear(colors)
            made = self._instances[key] = InstancedMesh(mesh, poses, colors=held)
            records[made] = InstanceWords(made.poses, record.instance_parts)
        return self._instances[key]

    def _placed(self, record: NodeRecord) -> list[Camera | Light]:
        """Return the camera and light of a node."""
        things = (
            self._thing("camera", record.camera, self._tree.cameras, _camera),
            self._thing("light", record.light, self._tree.lights, _light),
        )
        return [thing for thing in things if thing is not None]

    def _thing(
        self,
        kind: str,
        number: int | None,
        entries: Sequence[_Record],
        make: Callable[[_Record], Camera | Light],
    ) -> Camera | Light | None:
        """Return the object that a node refers to, created once for all its nodes."""
        if number is None:
            return None
        key = kind, number
        if key not in self._things:
            self._things[key] = self._made(kind, entries[number], make)
        return self._things[key]

    def _made(
        self, kind: str, entry: _Record, make: Callable[[_Record], Camera | Light]
    ) -> Camera | Light | None:
        try:
            obj = make(entry)
        except InvalidArgumentError as error:
            self._scene.warnings.append(f"{kind} {entry.name!r} is left out: {error}")
            return None
        records[obj] = entry
        return obj

    def _set_weights(self, record: NodeRecord, shows: list[Node]) -> None:
        mesh_record = self._tree.parts(record)[0]
        count = len(mesh_record.mesh.morph_targets)
        weights = mesh_record.morph_weights if record.weights is None else record.weights
        if any(weights) and count and record.instances is None:
            weights = (*weights[:count], *(0.0,) * (count - len(weights)))
            for node in shows:
                node.morph_weights = weights

    def _add_robot(self, record: RobotRecord) -> None:
        from ...model.motion.robots import Robot

        nodes = self._nodes
        joints = [(joint.form, nodes[joint.parent], nodes[joint.child]) for joint in record.joints]
        links = [nodes[number] for number in record.links]
        name = record.name or "robot"
        self._scene.data.robots[name] = Robot(name, links, joints, record.values)

    def _add_skins(self) -> None:
        for index, shows in self._parts.items():
            number = self._tree.nodes[index].skin
            if number is None:
                continue
            if number not in self._skins:
                self._skins[number] = self._skin(self._tree.skins[number])
            skin = self._skins[number]
            for node in shows if skin is not None else ():
                if isinstance(node.object, Mesh) and node.object.joints is not None:
                    node.skin = skin

    def _skin(self, record: SkinRecord) -> Skin | None:
        from ...model.motion.skins import Skin

        joints = [self._nodes[joint] for joint in record.joints if joint in self._nodes]
        if len(joints) < len(record.joints):
            self._scene.warnings.append(
                f"skin {record.name!r} is left out: a joint of it is not in the scene"
            )
            return None
        skin = Skin(joints, record.inverse_binds, record.name)
        records[skin] = record
        return skin

    def _add_clip(self, record: ClipRecord, number: int) -> None:
        from ...model.motion.clips import AnimationClip, Channel

        channels: list[Channel | PropertyChannel] = []
        missing = 0
        for channel in record.channels:
            node = self._nodes.get(channel.node)
            moved = [] if node is None else [node]
            if channel.path == "weights":
                moved = self._parts.get(channel.node, []) if node is not None else []
            missing += not moved
            times, values = self._shared(channel.times), self._shared(channel.values)
            channels += [
                Channel(each, channel.path, times, values, channel.interpolation) for each in moved
            ]
        made = [self._property_channels(each, record.name) for each in record.properties]
        missing += sum(not each for each in made)
        channels += self._without_crossing([one for each in made for one in each], record.name)
        if missing:
            self._scene.warnings.append(
                f"animation {record.name!r}: {missing} of its channels move nothing that is shown"
            )
        clip = AnimationClip(channels, record.name)
        records[clip] = record
        self._scene.animations[_free(record.name or f"animation_{number}", self._scene)] = clip

    def _shared(self, array: np.ndarray) -> np.ndarray:
        """Return an array as float64 for channels, shared by all that use it."""
        held = self._keys.get(id(array))
        if held is None:
            held = self._keys[id(array)] = array, frozen(array.astype(np.float64))
        return held[1]

    def _property_channels(self, record: PropertyRecord, clip: str) -> list[PropertyChannel]:
        """Return the channels of a record: several if the scene has several objects for it."""
        targets: list[Any] = []
        if record.kind == "node":
            node = self._nodes.get(record.number)
            parts = self._parts.get(record.number, []) if record.path != "visible" else [node]
            targets = [] if node is None else parts
        elif record.kind == "material":
            targets = list(self._tree.made_materials.get(record.number, ()))
        else:
            thing = self._things.get((record.kind, record.number))
            targets = [] if thing is None else [thing]
        made = (self._property_channel(target, record, clip) for target in targets)
        return [channel for channel in made if channel is not None]

    def _property_channel(
        self, target: Any, record: PropertyRecord, clip: str
    ) -> PropertyChannel | None:
        """Return a channel of one object; None, with a warning, if it lacks the property."""
        from ...model.motion.properties import PropertyChannel

        try:
            times, values = self._shared(record.times), self._shared(record.values)
            with floats_are_linear():
                return PropertyChannel(target, record.path, times, values, record.interpolation)
        except InvalidArgumentError as error:
            what = f"{record.path} of {record.kind} {record.number}"
            self._scene.warnings.append(f"animation {clip!r}: {what} stays: {error}")
            return None

    def _without_crossing(
        self, channels: list[PropertyChannel], clip: str
    ) -> list[PropertyChannel]:
        """Return the channels without those that would cross, such as near and far planes."""
        crossing = set()
        for low, high in _APART:
            ends = {(c.target, c.path): c.reach for c in channels if c.path in (low, high)}
            for target in {target for target, _ in ends}:
                lows = ends.get((target, low), (getattr(target, low),) * 2)
                highs = ends.get((target, high), (getattr(target, high),) * 2)
                if not lows[1] < highs[0]:
                    crossing |= {(target, low), (target, high)}
                    told = f"animation {clip!r}: {low} would be beyond {high}: both stay"
                    self._scene.warnings.append(told)
        return [c for c in channels if (c.target, c.path) not in crossing]


def _free(name: str, scene: Scene) -> str:
    """Return the name, with a number appended if another clip has it."""
    number, free = 1, name
    while free in scene.animations:
        number += 1
        free = f"{name}_{number}"
    return free


def _place(record: NodeRecord) -> Place:
    if record.matrix is not None:
        return {"pose": record.matrix}
    parts = {name: getattr(record, name) for name in ("translation", "rotation", "scale")}
    return {name: value for name, value in parts.items() if value is not None}


def _camera(record: LensRecord) -> Camera:
    """Return a camera with the picture's aspect, whatever the file's."""
    if record.ymag is not None:
        return OrthographicCamera(record.ymag, znear=record.znear, zfar=record.zfar)
    assert record.yfov is not None  # it is a perspective camera
    return PerspectiveCamera(record.yfov, znear=record.znear, zfar=record.zfar)


def _light(record: LampRecord) -> Light:
    light: type | None = DIRECT_LIGHTS.get(record.kind)
    if light is None:
        raise InvalidArgumentError(f"no light is known of the kind {shown(record.kind)}")
    held = {name: getattr(record, name) for name in parameters(light) if hasattr(record, name)}
    if light is PointLight:
        held["falloff"] = "inverse_square" if math.isinf(record.range) else "gltf"
    return light(**{**held, "color": linear(record.color)})

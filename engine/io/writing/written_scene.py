"""Converts a scene to a tree for other file formats.

In: a `Scene`. Out: a `TreeRecord`, and a line for each loss. A file's original statements about
objects are kept if the objects are unchanged.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np

from ...base import linalg
from ...base.numbers import shown
from ...model.geometry.mesh import Mesh
from ...model.materials.colors import linear_color, linear_rows
from ...model.materials.linear_colors import LinearColor
from ...model.materials.material import Material
from ...model.motion.properties import PropertyChannel
from ...model.scene.cameras import OrthographicCamera, PerspectiveCamera
from ...model.scene.instances import InstancedMesh
from ...model.scene.lights import DirectionalLight, PointLight, SpotLight
from ...model.scene.nodes import Node
from ...model.scene.placements import Placements
from ...model.scene.scene import Scene
from ..scenes.document_trees import (
    ChannelRecord,
    ClipRecord,
    LampRecord,
    LensRecord,
    MeshRecord,
    NodeRecord,
    PropertyRecord,
    SkinRecord,
    TreeRecord,
)
from ..scenes.tree_posing import local_pose
from ..scenes.tree_records import FURTHER_PART, records

if TYPE_CHECKING:
    from ...model.motion.clips import AnimationClip
    from ...model.motion.skins import Skin
    from ...model.scene.lights import DirectLight
    from ...model.scene.nodes import SceneObject

_LIGHTS = (DirectionalLight, PointLight, SpotLight)
_REACH = ("range", "inner_cone_angle", "outer_cone_angle")  # properties only some lights have
_IDENTITY = {"translation": (0.0, 0.0, 0.0), "rotation": (0.0, 0.0, 0.0, 1.0)}
_IDENTITY["scale"] = (1.0, 1.0, 1.0)
# What glTF does not hold of a scene; with the environment go its intensity, rotation and blur.
_NOT_HELD = ("background", "ambient", "light_clamp", "exposure", "fog", "environment", "animator")
_Thing = TypeVar("_Thing")


def tree_of_scene(scene: Scene) -> tuple[TreeRecord, list[str]]:
    """Return a scene as a tree, and a line for each loss."""
    making = _Making(scene)
    return making.tree(), making.told


class _TurnedLight:
    """A file node for a directional light that does not shine along -Z."""

    def __init__(self, light: DirectionalLight) -> None:
        self.light = light


_Row: TypeAlias = Node | _TurnedLight


class _Making:
    """The lists of a tree, each object once."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self.told: list[str] = []
        self._lists: dict[str, list[Any]] = {
            name: [] for name in ("meshes", "cameras", "lights", "skins")
        }
        self._numbers: dict[tuple[str | int, ...], int] = {}
        self._kept: list[Any] = []  # keeps IDs from being reused
        self._variants: tuple[str, ...] = ()

    def tree(self) -> TreeRecord:
        scene = self._scene
        # Objects moved to a child node at loading return to their parent.
        self._folded = {
            node: parent
            for node in scene.nodes
            if (parent := node.parent) is not None and _is_further_part(node)
        }
        self._turned = {
            node: _TurnedLight(node.object)
            for node in scene.nodes
            if isinstance(node.object, DirectionalLight) and _is_turned(node.object)
        }
        rows = self._rows()
        self._row = {row: number for number, row in enumerate(rows)}
        nodes = [row for row in rows if isinstance(row, Node)]
        self._placements = Placements(scene, nodes)
        self._place_of = {node: place for place, node in enumerate(nodes)}
        made = tuple(map(self._record, rows))
        self._tell_of_scene(nodes)
        meshes = tuple(self._lists["meshes"])
        materials = _materials_of(meshes)
        self._material_rows = {key: row for row, key in enumerate(materials)}
        clips = tuple(self._clip(*named) for named in scene.animations.items())
        return TreeRecord(
            nodes=made,
            roots=tuple(self._row[node] for node in nodes if node.parent is None),
            meshes=meshes,
            skins=tuple(self._lists["skins"]),
            clips=clips,
            cameras=tuple(self._lists["cameras"]),
            lights=tuple(self._lists["lights"]),
            materials=tuple(materials.values()),
            variants=self._variants,
            extras=records.get(scene),
        )

    def _rows(self) -> list[_Row]:
        """Return the nodes of the file in reading order, parents first.

        So their objects keep their numbers when a loaded file is written again.
        """
        found: list[_Row] = []
        waiting: list[_Row] = [node for node in self._scene.nodes[::-1] if node.parent is None]
        while waiting:
            found.append(waiting.pop())
            waiting += self._below(found[-1])[::-1]
        return found

    def _below(self, row: _Row) -> list[_Row]:
        """Return the children of a file node; its turned light comes last."""
        if not isinstance(row, Node):
            return []
        below: list[_Row] = [child for child in row.children if child not in self._folded]
        return [*below, self._turned[row]] if row in self._turned else below

    def _record(self, row: _Row) -> NodeRecord:
        if isinstance(row, Node):
            return self._node(row)
        direction = row.light.direction
        number = self._number("lights", row.light, _lamp)
        turned = linalg.look_at((0, 0, 0), direction, _across(direction))
        return NodeRecord(matrix=turned, light=number)

    def _node(self, node: Node) -> NodeRecord:
        parts = [node, *(child for child in node.children if child in self._folded)]
        held = [part.object for part in parts if part.object is not None]
        came = records.get(node)
        came = came if isinstance(came, NodeRecord) else NodeRecord()
        return NodeRecord(
            name=node.name,
            children=tuple(self._row[below] for below in self._below(node)),
            visible=node.visible,
            extras=came.extras,
            **_place(came, self._placements, self._place_of[node]),
            **self._shown(node, held),
            **self._placed(node, held),
        )

    def _shown(self, node: Node, held: list[SceneObject]) -> dict[str, Any]:
        """Return the mesh of a node, and its deformation."""
        instanced = [obj for obj in held if isinstance(obj, InstancedMesh)]
        meshes = [obj.mesh for obj in instanced] or [obj for obj in held if isinstance(obj, Mesh)]
        meshes = [mesh for mesh in meshes if _shows(mesh)]
        if not meshes:
            return {}
        if instanced and not len(instanced[0]):
            self.told.append(f"node {shown(node.name)}: gltf files hold no instances without any")
            return {}
        found: dict[str, Any] = {"mesh": self._mesh(meshes)}
        if instanced:
            found["instances"] = _poses(instanced[0])
            came = records.get(instanced[0])
            if came is not None and came.poses is instanced[0].poses:
                found["instance_parts"] = came.parts
            found["instance_colors"] = _linear(instanced[0].colors)
        if node.skin is not None:
            found["skin"] = self._number("skins", node.skin, self._skin)
        usual = self._lists["meshes"][found["mesh"]].morph_weights
        if meshes[0].morph_targets:
            none = (0.0,) * len(usual)
            given = none if node.morph_weights is None else tuple(node.morph_weights.tolist())
            if given != usual:
                found["weights"] = given
        return found

    def _placed(self, node: Node, held: list[SceneObject]) -> dict[str, Any]:
        """Return the camera and light of a node."""
        found: dict[str, Any] = {}
        for obj in held:
            if isinstance(obj, (Mesh, InstancedMesh)):
                continue
            if isinstance(obj, OrthographicCamera) and obj.znear < 0:
                self.told.append(
                    f"node {shown(node.name)}: gltf files hold no camera that sees behind itself"
                )
            elif isinstance(obj, (PerspectiveCamera, OrthographicCamera)):
                found["camera"] = self._number("cameras", obj, _lens)
            elif isinstance(obj, _LIGHTS) and self._is_told(node, obj):
                found["light"] = self._number("lights", obj, _lamp)
            elif not isinstance(obj, _LIGHTS):
                kind = type(obj).__name__
                self.told.append(f"node {shown(node.name)}: gltf files hold no {kind}")
        return found

    def _is_told(self, node: Node, light: DirectLight) -> bool:
        """Return whether glTF can express a light; warn about approximate ones."""
        if node in self._turned:
            return False  # it becomes a child node
        if isinstance(light, PointLight) and light.falloff != "gltf" and light.range < math.inf:
            self.told.append(
                f"node {shown(node.name)}: gltf files hold no light whose falloff is "
                f"{light.falloff!r}"
            )
        return True

    def _number(self, where: str, thing: _Thing, record_of: Callable[[_Thing], object]) -> int:
        """Return the number of an object in its list; add new ones."""
        key = where, id(thing)
        if key not in self._numbers:
            self._kept.append(thing)
            self._lists[where].append(record_of(thing))
            self._numbers[key] = len(self._lists[where]) - 1
        return self._numbers[key]

    def _mesh(self, meshes: list[Mesh]) -> int:
        key: tuple[str | int, ...] = ("meshes", *map(id, meshes))
        if key not in self._numbers:
            self._kept += meshes
            first, *rest = map(self._part, meshes)
            self._lists["meshes"].append(replace(first, rest=tuple(rest)))
            self._numbers[key] = len(self._lists["meshes"]) - 1
            self._tell_of_mesh(meshes)
        return self._numbers[key]

    def _part(self, mesh: Mesh) -> MeshRecord:
        came = records.get(mesh)
        none = (0.0,) * len(mesh.morph_targets)
        if came is None:
            return MeshRecord(mesh.name, mesh, none)
        fits = all(len(held) == len(mesh.materials) for held in came.variants.values())
        if came.variants and fits:
            self._variants = came.variant_names
        usual = came.morph_weights if len(came.morph_weights) == len(none) else none
        return MeshRecord(mesh.name, mesh, usual, came.variants if fits else {}, extras=came.extras)

    def _skin(self, skin: Skin) -> SkinRecord:
        came = records.get(skin)
        joints = tuple(self._row[joint] for joint in skin.joints)
        return SkinRecord(
            skin.name, joints, skin.inverse_binds, extras=None if came is None else came.extras
        )

    def _clip(self, name: str, clip: AnimationClip) -> ClipRecord:
        channels, properties = [], []
        seen = set()
        for channel in clip.channels:
            if isinstance(channel, PropertyChannel):
                properties += self._property(channel, name)
                continue
            node = self._folded.get(channel.node, channel.node)
            # Each part of a mesh has a weights channel, but a file has one for all.
            if node not in self._row or (node, channel.path) in seen:
                continue
            if channel.path == "weights" and channel.values.shape[-1] != _targets_of(node):
                self.told.append(f"animation {shown(name)}: weights of what is not written")
                continue
            seen.add((node, channel.path))
            channels.append(
                ChannelRecord(
                    self._row[node],
                    channel.path,
                    channel.interpolation,
                    channel.times,
                    channel.values,
                )
            )
        came = records.get(clip)
        extras = None if came is None else came.extras
        return ClipRecord(name, clip.duration, tuple(channels), extras, tuple(properties))

    def _property(self, channel: PropertyChannel, clip: str) -> list[PropertyRecord]:
        """Return the record of an animated property; None, with a warning, if not possible."""
        thing, numbers = channel.target, self._numbers
        if isinstance(thing, Node):
            kind, number = "node", self._row.get(self._folded.get(thing, thing))
        elif isinstance(thing, Material):
            kind, number = "material", self._material_rows.get(id(thing))
        else:
            kind = "camera" if ("cameras", id(thing)) in numbers else "light"
            number = numbers.get((f"{kind}s", id(thing)))
        if number is None:
            self.told.append(f"clip {shown(clip)}: what {channel.path} is of is not in the file")
            return []
        keys = channel.interpolation, channel.times, channel.values
        return [PropertyRecord(kind, number, channel.path, *keys)]

    def _tell_of_mesh(self, meshes: list[Mesh]) -> None:
        lost = ["groups"] if any(mesh.groups for mesh in meshes) else []
        hides = (m.edge_visible is not None and not m.edge_visible.all() for m in meshes)
        lost += ["polygons"] if any(hides) else []
        if lost:
            names = " and ".join(lost)
            self.told.append(f"mesh {shown(meshes[0].name)}: gltf files hold no {names}")

    def _tell_of_scene(self, nodes: list[Node]) -> None:
        usual, scene = Scene(), self._scene
        lost = [
            name.replace("_", " ")
            for name in _NOT_HELD
            if not _are_equal(getattr(scene, name, None), getattr(usual, name, None))
        ]
        lost += ["colliders"] if any(node.collider is not None for node in nodes) else []
        lost += ["joints"] if self._scene.robots else []
        lost += ["shadows"] if any(map(_tells_of_shadows, nodes)) else []
        if lost:
            self.told.append(f"gltf files do not hold {', '.join(lost)}")


def _tells_of_shadows(node: Node) -> bool:
    casts = isinstance(node.object, _LIGHTS) and node.object.shadow != "none"
    return bool(casts or not node.cast_shadows or not node.receive_shadows)


def _is_turned(light: DirectionalLight) -> bool:
    """Return whether a light does not shine along -Z, the direction in such files."""
    x, y, z = light.direction.tolist()
    return (x, y) != (0.0, 0.0) or z > 0


def _shows(mesh: Mesh) -> bool:
    """Return whether a mesh has more than vertices, which such files would not hold."""
    return any(map(len, (mesh.faces, mesh.lines, mesh.points)))


def _targets_of(node: Node) -> int:
    """Return how many morph targets the mesh of a node has in the file."""
    mesh = node.object
    return len(mesh.morph_targets) if isinstance(mesh, Mesh) and _shows(mesh) else 0


def _is_further_part(node: Node) -> bool:
    """Return whether a node still is as the loader made it for its parent's further object."""
    if records.get(node) is not FURTHER_PART or node.children:
        return False
    return np.array_equal(node.pose, np.eye(4)) and node.visible and node.object is not None


def _place(came: NodeRecord, placements: Placements, row: int) -> dict[str, Any]:
    """Return a node's pose: as in the file if unchanged, else as parts or a matrix."""
    names = (*_IDENTITY, "matrix")
    pose = placements.poses[row]
    if any(getattr(came, name) is not None for name in names):
        if np.array_equal(np.array(local_pose(came)), pose):
            return {name: getattr(came, name) for name in names}
    if not placements.has_parts[row]:
        return {"matrix": pose}
    parts = {
        "translation": tuple(pose[:3, 3].tolist()),
        "rotation": tuple(placements.rotations[row].tolist()),
        "scale": tuple(placements.scales[row].tolist()),
    }
    return {name: value for name, value in parts.items() if value != _IDENTITY[name]}


def _poses(instanced: InstancedMesh) -> np.ndarray:
    """Return node-from-instance, (N, 4, 4) float64."""
    given = instanced.poses.astype(np.float64)
    if given.ndim == 3:
        return given
    poses = np.tile(np.eye(4), (len(given), 1, 1))
    poses[:, :3, :3] *= given[:, 3, np.newaxis, np.newaxis]
    poses[:, :3, 3] = given[:, :3]
    return poses


def _linear(colors: np.ndarray | None) -> np.ndarray | None:
    """Return instance colours in linear light, (N, 4) float32."""
    return None if colors is None else linear_rows(colors).clip(0, 1)


def _lens(camera: PerspectiveCamera | OrthographicCamera) -> LensRecord:
    came = records.get(camera, LensRecord("perspective"))
    zfar = math.inf if camera.zfar is None else camera.zfar
    common = {"name": came.name, "znear": camera.znear, "zfar": zfar, "extras": came.extras}
    if isinstance(camera, PerspectiveCamera):
        aspect = came.aspect if camera.aspect is None else camera.aspect
        return LensRecord("perspective", yfov=camera.yfov, aspect=aspect, **common)
    xmag = camera.xmag
    if xmag is None:
        xmag = came.xmag if came.ymag == camera.ymag else camera.ymag
    return LensRecord("orthographic", xmag=xmag, ymag=camera.ymag, **common)


def _lamp(light: DirectLight) -> LampRecord:
    came = records.get(light, LampRecord("point"))
    is_linear = isinstance(light.color, LinearColor)
    color = tuple(light.color if is_linear else linear_color(light.color).tolist())
    held = {name: getattr(light, name) for name in _REACH if hasattr(light, name)}
    common = {"name": came.name, "color": color, "extras": came.extras}
    return LampRecord(light.kind, intensity=light.intensity, **common, **held)


def _across(direction: np.ndarray) -> tuple[float, float, float]:
    """Return a direction not parallel to another."""
    x, y, z = np.abs(direction).tolist()
    return (0.0, 1.0, 0.0) if y < max(x, z) else (1.0, 0.0, 0.0)


def _materials_of(meshes: tuple[MeshRecord, ...]) -> dict[int, Material]:
    """Return the used materials by ID, in order of use."""
    found: dict[int, Material] = {}
    for record in meshes:
        for part in record.parts:
            mesh = part.mesh
            numbers = materials_of_faces(mesh)
            numbers += [0] if len(mesh.lines) or len(mesh.points) else []
            used = [mesh.materials[number] for number in numbers]
            found.update((id(material), material) for material in used)
    return found


def materials_of_faces(mesh: Mesh) -> list[int]:
    """Return the material numbers of faces, in writing order.

    Readers make one mesh of the smooth ones and another of the flat ones, so materials of each kind
    are adjacent.
    """
    if not len(mesh.faces):
        return []
    numbers = np.unique(mesh.material_ids).tolist() if len(mesh.materials) > 1 else [0]
    are_flat = mesh.materials[numbers[0]].flat_shading
    return sorted(numbers, key=lambda n: mesh.materials[n].flat_shading != are_flat)


def _are_equal(one: Any, other: Any) -> bool:
    return one is other or (type(one) is type(other) and bool(np.all(one == other)))

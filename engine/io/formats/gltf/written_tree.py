"""The JSON of a written glTF file.

In: a `TreeRecord`. Out: the JSON as Python objects, and the chunks of its buffer.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...scenes.document_trees import ClipRecord, LampRecord, LensRecord, NodeRecord, TreeRecord
from ...writing.losses import lost_mirrors, not_held
from .gltf_file import LIGHTS
from .gltf_nodes import INSTANCING, VISIBILITY
from .gltf_pointers import POINTER
from .written_arrays import GltfArrays
from .written_instances import are_sheared, parts_of_poses
from .written_materials import GltfMaterialList
from .written_meshes import GltfMeshList
from .written_pointers import GltfPointers

_VARIANTS = "KHR_materials_variants"
# The attributes of an instance's pose.
_PARTS = ("TRANSLATION", "ROTATION", "SCALE")


class GltfTree:
    """The JSON of a tree, without its buffer.

    Parameters
    ----------
    tree : TreeRecord

    Attributes
    ----------
    json : dict
    arrays : GltfArrays
    told : list of str
        A line for each thing that glTF cannot hold.
    """

    def __init__(self, tree: TreeRecord) -> None:
        self.arrays = GltfArrays()
        self.told: list[str] = []
        self._extensions: set[str] = set()
        materials = GltfMaterialList(self.arrays)
        meshes = GltfMeshList(self.arrays, materials)
        for material in tree.materials:
            materials.number(material)
        for mesh in tree.meshes:
            meshes.add(mesh)
        self._pointers = GltfPointers(tree, materials)
        lists = {
            "nodes": [self._node(node) for node in tree.nodes],
            "meshes": meshes.meshes,
            "skins": [self._skin(skin) for skin in tree.skins],
            "animations": [self._clip(clip) for clip in tree.clips],
            "cameras": [_camera(camera) for camera in tree.cameras],
            "materials": materials.materials,
            "textures": materials.textures,
            "images": materials.images,
            "samplers": materials.samplers,
            "accessors": self.arrays.accessors,
            "bufferViews": self.arrays.views,
        }
        if materials.converted:
            self.told.append(
                f"gltf files hold physical materials: {materials.converted} others became such"
            )
        self.told += [
            f"gltf files do not hold {thing} of {count} texture{'s' * (count > 1)}"
            for thing, count in materials.lost.items()
        ]
        self.told += lost_mirrors("gltf", materials.mirrors)
        self.told += not_held("gltf", dict.fromkeys(meshes.lost))
        self._extensions |= materials.extensions
        self.json = self._with_extensions(tree, lists, materials.required)
        self.told += self._pointers.define(self.json)

    def _with_extensions(
        self, tree: TreeRecord, lists: dict[str, Any], required: set[str]
    ) -> dict[str, Any]:
        extensions: dict[str, Any] = {}
        if tree.lights:
            extensions[LIGHTS] = {"lights": [_light(light) for light in tree.lights]}
        if tree.variants:
            extensions[_VARIANTS] = {"variants": [{"name": name} for name in tree.variants]}
        if any(clip.properties for clip in tree.clips):
            self._extensions |= {POINTER, *self._pointers.extensions}
        used = sorted(self._extensions | extensions.keys())
        return {
            "asset": {"version": "2.0", "generator": "engine3d"},
            **({"extras": tree.extras} if tree.extras is not None else {}),
            **({"extensionsUsed": used} if used else {}),
            **({"extensionsRequired": sorted(required)} if required else {}),
            **({"extensions": extensions} if extensions else {}),
            "scene": 0,
            "scenes": [{"nodes": list(tree.roots)} if tree.roots else {}],
            **{name: entries for name, entries in lists.items() if entries},
        }

    def _node(self, node: NodeRecord) -> dict[str, Any]:
        entry: dict[str, Any] = {"name": node.name} if node.name else {}
        if node.matrix is not None:
            entry["matrix"] = node.matrix.T.ravel().tolist()
        for name in ("translation", "rotation", "scale", "weights", "children"):
            if value := getattr(node, name):
                entry[name] = list(value)
        for name in ("mesh", "skin", "camera"):
            if (number := getattr(node, name)) is not None:
                entry[name] = number
        extensions: dict[str, Any] = {}
        if node.light is not None:
            extensions[LIGHTS] = {"light": node.light}
        if not node.visible:
            extensions[VISIBILITY] = {"visible": False}
        if node.instances is not None:
            attributes = self._instances(node.instances, node.instance_parts)
            if node.instance_colors is not None:
                attributes["_COLOR_0"] = self.arrays.add(node.instance_colors)
            extensions[INSTANCING] = {"attributes": attributes}
        if extensions:
            self._extensions |= extensions.keys()
            entry["extensions"] = extensions
        if node.extras is not None:
            entry["extras"] = node.extras
        return entry

    def _instances(self, poses: np.ndarray, parts: tuple[Any, ...] | None) -> dict[str, int]:
        if parts is None:
            parts = parts_of_poses(poses)
            if are_sheared(poses, parts):
                self.told.append("gltf files hold no sheared instances: the shear is left out")
        return {
            name: self.arrays.add(part.astype(np.float32))
            for name, part in zip(_PARTS, parts, strict=True)
        }

    def _skin(self, skin: Any) -> dict[str, Any]:
        columns = skin.inverse_binds.transpose(0, 2, 1).reshape(-1, 16)
        entry: dict[str, Any] = {"name": skin.name} if skin.name else {}
        entry["joints"] = list(skin.joints)
        entry["inverseBindMatrices"] = self.arrays.add(columns.astype(np.float32))
        if skin.skeleton is not None:
            entry["skeleton"] = skin.skeleton
        return entry if skin.extras is None else {**entry, "extras": skin.extras}

    def _clip(self, clip: ClipRecord) -> dict[str, Any]:
        samplers: list[dict[str, Any]] = []
        channels = []
        times: dict[bytes, int] = {}
        targets = [{"node": c.node, "path": c.path} for c in clip.channels]
        moved: list[Any] = list(clip.channels)
        for held, target in self._pointers.targets(clip):
            moved.append(held)
            targets.append(target)
        for channel, target in zip(moved, targets, strict=True):
            content = np.asarray(channel.times, np.float32)
            key = content.tobytes()
            if key not in times:
                times[key] = self.arrays.add(content)
                accessor = self.arrays.accessors[times[key]]
                accessor["min"], accessor["max"] = [float(content[0])], [float(content[-1])]
            values = np.asarray(channel.values, np.float32)
            width = values.shape[-1]
            if channel.path == "visible":
                values = (values >= 0.5).astype(np.uint8)
            is_flat = channel.path == "weights" or width == 1
            rows = values.reshape(-1) if is_flat else values.reshape(-1, width)
            sampler = {"input": times[key], "output": self.arrays.add(rows)}
            if channel.interpolation != "linear":
                sampler["interpolation"] = channel.interpolation.upper()
            channels.append({"sampler": len(samplers), "target": target})
            samplers.append(sampler)
        entry: dict[str, Any] = {"name": clip.name} if clip.name else {}
        entry |= {"channels": channels, "samplers": samplers}
        return entry if clip.extras is None else {**entry, "extras": clip.extras}


def _camera(camera: LensRecord) -> dict[str, Any]:
    part: dict[str, Any] = {"znear": camera.znear}
    if not math.isinf(camera.zfar):
        part["zfar"] = camera.zfar
    if camera.kind == "perspective":
        part["yfov"] = camera.yfov
        part |= {} if camera.aspect is None else {"aspectRatio": camera.aspect}
    else:
        part |= {"xmag": camera.xmag, "ymag": camera.ymag}
    entry: dict[str, Any] = {"name": camera.name} if camera.name else {}
    entry |= {"type": camera.kind, camera.kind: part}
    return entry if camera.extras is None else {**entry, "extras": camera.extras}


def _light(light: LampRecord) -> dict[str, Any]:
    entry: dict[str, Any] = {"name": light.name} if light.name else {}
    entry["type"] = light.kind
    if light.color != (1.0, 1.0, 1.0):
        entry["color"] = list(light.color)
    if light.intensity != 1.0:
        entry["intensity"] = light.intensity
    if not math.isinf(light.range):
        entry["range"] = light.range
    if light.kind == "spot":
        inner, outer = light.inner_cone_angle, light.outer_cone_angle
        entry["spot"] = {"innerConeAngle": inner, "outerConeAngle": outer}
    return entry if light.extras is None else {**entry, "extras": light.extras}

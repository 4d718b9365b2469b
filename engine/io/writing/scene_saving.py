"""Writes scenes as JSON: the tree of nodes, and their objects.

In: a scene and a path. Out: one file. Meshes, images and environments from files in the scene's
folder, or below it, are stored by name; primitives by their arguments; all others as base64, so
that nothing is lost. docs/formats.md defines the format, and io/formats/scene_file.py reads it.
"""

from __future__ import annotations

import base64
import json
import math
import os
from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any

import numpy as np

from ..._native.images import encode_png
from ...base.calls import checks_types
from ...base.files.atomic_write import atomic_write, checked_path
from ...base.files.confined_reading import is_inside
from ...base.numbers import shown
from ...errors import InvalidArgumentError, located, warn
from ...model.environments.environment import Environment
from ...model.geometry.creases import CREASE_ANGLE, SMOOTH
from ...model.geometry.mesh import Mesh
from ...model.geometry.movers import VERTEX_AXES
from ...model.geometry.origins import FileOrigin, PrimitiveOrigin, has_own_materials, origin_of
from ...model.materials.material import TEXTURE_SLOTS, Material, says_something, states_nothing
from ...model.materials.textures import PlacedTexture, Texture, image_file_of
from ...model.scene.animation import motions_of
from ...model.scene.fog import ExponentialFog, Fog
from ...model.scene.gradients import Gradient
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.placements import Placements
from ...model.scene.scene import Scene
from ...model.spatial.colliders import BoxCollider, MeshCollider, SphereCollider
from ..formats.gltf import gltf_writer as gltf
from ..formats.scene_file import FORMAT, LISTS, VERSION
from ..reading.json_values import ARRAY_TYPES
from ..scenes.motion_records import motion_entries
from ..scenes.object_kinds import kind_of, parameters, plain, values_of, written
from .saving import write
from .writer_registry import SCENE_EXTENSION, plugin_writer

_ENVIRONMENT_VALUES = {
    "environment_intensity": 1.0,
    "environment_rotation": 0.0,
    "background_blur": 0.0,
}
_IDENTITY = {"translation": np.zeros(3), "rotation": np.eye(4)[3], "scale": np.ones(3)}


@checks_types
def save_scene(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Write a scene to a file, whole or not at all.

    Parameters
    ----------
    scene : Scene
    path : str or path-like
        ``.glb`` and ``.gltf`` give glTF 2.0, all in one file; unchanged images keep their encoded
        bytes. An extension for which a package adds a writer (docs/plugins.md) gives its format.
        Any other extension gives engine3d's JSON, usually named ``.e3d.json``, which
        `load_scene` detects by content; meshes, textures and environments from files in its folder,
        or below it, are stored by relative path, all others inside the file. Losses are issued as
        `Engine3DWarning`. Motion is saved if it belongs to ``scene.animator``.

    Raises
    ------
    FileAccessError
        The file cannot be written.
    InvalidArgumentError
        The argument is not a scene.
    """
    if not isinstance(scene, Scene):
        raise InvalidArgumentError(f"not a Scene: {type(scene).__name__}")
    name = checked_path(path)
    extension = os.path.splitext(name)[1].lower()
    if extension in gltf.EXTENSIONS:
        gltf.save_scene_as(scene, name, extension)
        return
    writer = None if extension == SCENE_EXTENSION else plugin_writer(name)
    if writer is not None:
        write(scene, name, writer)
        return
    save_with_materials(scene, name)


def save_with_materials(scene: Scene, path: str, materials: Iterable[Material] = ()) -> None:
    """Write a scene as engine3d's JSON, with further materials that no node uses yet."""
    content, told = scene_text(scene, os.path.dirname(path) or ".", materials)
    with atomic_write(path) as file:
        file.write(content)
    for message in told:
        warn(located(message, path))


def scene_text(
    scene: Scene, folder: str, materials: Iterable[Material] = ()
) -> tuple[bytes, list[str]]:
    """Return a scene's file for a folder, and a line for each loss.

    Parameters
    ----------
    scene : Scene
    folder : str
    materials : iterable of Material
        Those to be in the file even if no node uses them.
    """
    writing = _Writing(folder)
    writing.nodes(scene)
    writing.materials(materials)
    writing.told += _lost_motion(scene)
    if scene.robots:
        writing.told.append("scenes of engine3d hold no joints: links stay where they stand")
    values = writing.values(scene)
    animator = scene.animator
    if animator is not None and any(motions_of(animator)):
        if math.isfinite(animator.full_rate_distance):
            values["full_rate_distance"] = animator.full_rate_distance
    if not writing.lists["environments"]:  # few scenes have any
        del writing.lists["environments"]
    tree = {"format": FORMAT, "version": VERSION, "scene": values, **writing.lists}
    return "".join(_lines(tree)).encode("ascii"), writing.told


def _lost_motion(scene: Scene) -> list[str]:
    """Return a line that names lost deformation and motion, if there is any."""
    nodes = scene.nodes
    meshes = {id(n.object): n.object for n in nodes if isinstance(n.object, Mesh)}.values()
    lost = ["skins"] if any(node.skin is not None for node in nodes) else []
    lost += ["morph targets"] if any(mesh.morph_targets for mesh in meshes) else []
    lost += ["animations"] if scene.animations else []
    return [f"scenes of engine3d hold no {', '.join(lost)}: glTF does"] if lost else []


def _lines(tree: dict[str, Any]) -> Iterator[str]:
    """Return JSON with a line for each object, so that versions of a file are easily compared."""
    for number, (key, value) in enumerate(tree.items()):
        yield f'{"," if number else "{"}\n"{key}": '
        if key in LISTS and value:
            yield "[\n" + ",\n".join(map(_compact, value)) + "\n]"
        else:
            yield _compact(value)
    yield "\n}\n"


def _compact(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"), allow_nan=False)


def _fields(value: Fog | ExponentialFog | Gradient) -> dict[str, Any]:
    """Return the parameters of an immutable value."""
    return {one.name: written(one.name, getattr(value, one.name)) for one in fields(value)}


class _Writing:
    """The lists of a file, each object once.

    Attributes
    ----------
    lists : dict of str to list
    told : list of str
    """

    def __init__(self, folder: str) -> None:
        self.lists: dict[str, list[Any]] = {name: [] for name in LISTS}
        self.told: list[str] = []
        self._folder = os.path.realpath(folder)
        self._numbers: dict[int, int] = {}
        self._kept: list[Any] = []  # keeps IDs from being reused

    def nodes(self, scene: Scene) -> None:
        """Write the nodes, and their objects."""
        nodes = scene.nodes
        numbers = {node: number for number, node in enumerate(nodes)}
        placements = Placements(scene, nodes)
        motions, lost = motion_entries(scene.animator, numbers)
        self.told += lost
        for row, node in enumerate(nodes):
            entry: dict[str, Any] = {"name": node.name} if node.name else {}
            if (number := self._object(node)) is not None:
                entry["object"] = number
            entry.update(_place(placements, row))
            if not node.visible:
                entry["hidden"] = True
            if node.static:
                entry["static"] = True
            for name in ("cast_shadows", "receive_shadows"):
                if not getattr(node, name):
                    entry[name] = False
            if node.collider is not None:
                entry["collider"] = self._collider(node)
            entry.update(motions.get(node, {}))
            if children := node.children:
                entry["children"] = [numbers[child] for child in children]
            self.lists["nodes"].append(entry)

    def materials(self, materials: Iterable[Material]) -> None:
        """Write materials, unless objects have them."""
        for material in materials:
            self._number("materials", material, self._material)

    def values(self, scene: Scene) -> dict[str, Any]:
        """Write the scene's own values; those of environments only if not default."""
        values: dict[str, Any] = {"background": None, "ambient": written("ambient", scene.ambient)}
        if isinstance(scene.background, tuple):
            values["background"] = written("background", scene.background)
        if isinstance(scene.background, Environment):
            number = self._number("environments", scene.background, self._environment)
            values["background"] = {"environment": number}
        if isinstance(scene.background, Gradient):
            values["background"] = _fields(scene.background)
        if scene.light_clamp is not None:
            values["light_clamp"] = plain(scene.light_clamp)
        if scene.exposure:
            values["exposure"] = scene.exposure
        if scene.fog is not None:
            values["fog"] = _fields(scene.fog)
        if scene.environment is not None:
            number = self._number("environments", scene.environment, self._environment)
            values["environment"] = number
        for name, usual in _ENVIRONMENT_VALUES.items():
            if getattr(scene, name) != usual:
                values[name] = getattr(scene, name)
        return values

    def _environment(self, environment: Environment) -> dict[str, Any]:
        if environment.sun is not None:
            direction, turbidity, disc = environment.sun
            sun = {"sun_direction": list(direction), "turbidity": turbidity, "sun_disc": disc}
            return {"built_in": environment.built_in, **sun}
        if environment.built_in is not None:
            return {"built_in": environment.built_in}
        path = environment.path
        file = None if path is None else self._relative(path)
        if file is not None:
            return {"file": file}
        name = {"name": environment.name} if environment.name else {}
        return {**name, "pixels": _array(environment.pixels)}

    def _number(self, where: str, thing: Any, entry_of: Any) -> int:
        """Return the number of an object in its list; add new ones."""
        if id(thing) not in self._numbers:
            entry = entry_of(thing)
            self._numbers[id(thing)] = len(self.lists[where])
            self._kept.append(thing)
            self.lists[where].append(entry)
        return self._numbers[id(thing)]

    def _object(self, node: Node) -> int | None:
        obj = node.object
        if obj is None:
            return None
        if isinstance(obj, Mesh):
            return self._number("objects", obj, self._mesh)
        if isinstance(obj, InstancedMesh):
            return self._number("objects", obj, self._instances)
        kind = kind_of(obj)
        if kind is None:
            self.told.append(f"node {shown(node.name)}: no word for a {type(obj).__name__}")
            return None
        return self._number("objects", obj, lambda obj: {"kind": kind, **values_of(obj)})

    def _instances(self, instances: InstancedMesh) -> dict[str, Any]:
        entry: dict[str, Any] = {"kind": "instances"}
        entry["mesh"] = self._number("objects", instances.mesh, self._mesh)
        entry["poses"] = _array(instances.poses)
        if instances.colors is not None:
            entry["colors"] = _array(instances.colors)
        return entry

    def _mesh(self, mesh: Mesh) -> dict[str, Any]:
        came = origin_of(mesh)
        named = None if came is None else self._named(came.origin)
        if came is None or named is None:
            materials = [self._number("materials", m, self._material) for m in mesh.materials]
            name = {"name": mesh.name} if mesh.name else {}
            return {"kind": "mesh", **name, **_arrays(mesh), "materials": materials}
        entry = {"kind": "mesh", **named}
        if mesh.name != came.name:
            entry["name"] = mesh.name
        if not has_own_materials(mesh, came):
            entry["materials"] = [
                self._number("materials", material, self._material) for material in mesh.materials
            ]
        return entry

    def _named(self, origin: FileOrigin | PrimitiveOrigin) -> dict[str, Any] | None:
        """Return the name for a mesh; None if it must be written as arrays."""
        if isinstance(origin, PrimitiveOrigin):
            return {"primitive": origin.name, "arguments": origin.arguments}
        file = self._relative(origin.path, origin.is_missing)
        if file is None:
            return None
        entry: dict[str, Any] = {"file": file}
        if origin.format is not None:
            entry["format"] = origin.format
        if origin.part is not None:
            entry["part"] = origin.part[0]
            if origin.part[1]:
                entry["occurrence"] = origin.part[1]
        if origin.crease_angle != CREASE_ANGLE:
            entry["crease_angle"] = origin.crease_angle
        return entry

    def _relative(self, path: str, may_be_missing: bool = False) -> str | None:
        """Return the path relative to the scene's folder; None if outside, or missing."""
        real = os.path.realpath(path)
        if not (is_inside(real, self._folder) and (may_be_missing or os.path.isfile(real))):
            return None
        return os.path.relpath(real, self._folder).replace(os.sep, "/")

    def _material(self, material: Material) -> dict[str, Any]:
        entry: dict[str, Any] = {}
        for name, default in parameters(Material).items():
            value = getattr(material, name)
            if name in TEXTURE_SLOTS:
                if value is not None:
                    entry[name] = self._slot(value)
            elif name == "extras":
                if value and self._is_json(value, material):
                    entry[name] = value
            elif (held := written(name, value)) != written(name, default):
                entry[name] = held
            elif name == "color" and not states_nothing(material) and not says_something(material):
                entry[name] = held  # white, but stated
        return entry

    def _slot(self, value: Texture | PlacedTexture) -> int | dict[str, Any]:
        """Return the number of a texture; for a placed one, with its placement."""
        if isinstance(value, Texture):
            return self._number("textures", value, self._texture)
        return {
            **values_of(value),
            "texture": self._number("textures", value.texture, self._texture),
        }

    def _is_json(self, extras: dict[str, Any], material: Material) -> bool:
        try:
            _compact(extras)
        except (TypeError, ValueError, RecursionError):
            self.told.append(f"material {shown(material.name)}: its extras are left out")
            return False
        return True

    def _texture(self, texture: Texture) -> dict[str, Any]:
        path, _, is_missing = image_file_of(texture)
        file = None if path is None else self._relative(path, is_missing)
        if file is None:
            content = base64.b64encode(bytes(encode_png(texture.pixels))).decode("ascii")
            entry = {"png": content}
        else:
            entry = {"file": file}
        for name, default in parameters(Texture).items():
            if name != "pixels" and getattr(texture, name) != default:
                entry[name] = getattr(texture, name)
        return entry

    def _collider(self, node: Node) -> dict[str, Any]:
        collider = node.collider
        if isinstance(collider, BoxCollider):
            if collider.box is None:
                return {"kind": "box"}
            low, high = plain(collider.box)
            return {"kind": "box", "low": low, "high": high}
        if isinstance(collider, SphereCollider):
            center = plain(collider.center)
            return {"kind": "sphere", "radius": collider.radius, "center": center}
        assert isinstance(collider, MeshCollider)
        if collider.mesh is None:
            return {"kind": "mesh"}
        return {"kind": "mesh", "mesh": self._number("objects", collider.mesh, self._mesh)}


def _place(placements: Placements, row: int) -> dict[str, list[Any]]:
    """Return a node's pose: non-identity parts if they give it to the bit, else the matrix."""
    if not placements.has_parts[row]:
        return {"pose": placements.poses[row, :3].ravel().tolist()}
    parts = {
        "translation": placements.poses[row, :3, 3].copy(),
        "rotation": placements.rotations[row],
        "scale": placements.scales[row],
    }
    return {
        name: part.tolist()
        for name, part in parts.items()
        if part.tobytes() != _IDENTITY[name].tobytes()
    }


def _arrays(mesh: Mesh) -> dict[str, Any]:
    arrays = {
        name.removeprefix("_given_"): _array(array)
        for name, array in mesh._arrays.items()
        if name not in VERTEX_AXES and array is not None and (len(array) or name == "positions")
    }
    groups = {name: _array(faces) for name, faces in mesh.groups.items()}
    values = {
        name: {"on": on, "array": _array(np.asarray(array))}
        for name, (array, on) in mesh.values.held().items()
    }
    angle = {} if mesh.crease_angle == SMOOTH else {"crease_angle": mesh.crease_angle}
    named = {"groups": groups, "values": values}
    return {"arrays": arrays, **{key: held for key, held in named.items() if held}, **angle}


def _array(array: np.ndarray) -> dict[str, Any]:
    content = np.ascontiguousarray(array).astype(ARRAY_TYPES[array.dtype.name], copy=False)
    data = base64.b64encode(content.tobytes()).decode("ascii")
    return {"type": array.dtype.name, "shape": list(array.shape), "base64": data}

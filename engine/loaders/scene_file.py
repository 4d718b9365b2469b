"""Scenes as engine3d writes them: a tree of nodes in JSON, and the files that it names.

In: the bytes of a file. Out: a `Document` whose ``scene`` holds the tree, with meshes, materials
and textures made; what nodes hold besides is left to whoever builds a scene of it. The objects of
the document are what shows, with the nodes' poses. docs/formats.md has the format.
"""

from __future__ import annotations

import inspect
import math
import os
import re
from typing import Any

import numpy as np

from .. import primitives
from ..environments.environment import (
    BUILT_IN,
    Environment,
    environment_of,
    named_environment,
)
from ..errors import FileFormatError, InvalidArgumentError
from ..geometry.creases import CREASE_ANGLE, SMOOTH, check_crease_angle
from ..geometry.mesh import Mesh
from ..geometry.origins import FileOrigin, remember_origin
from ..materials.colors import certainly_linear
from ..materials.material import TEXTURE_SLOTS, Material
from ..materials.textures import PlacedTexture, Texture
from .documents import Document, SceneRecord
from .images import read_image
from .json_values import JsonValue, parsed_json
from .linked_files import LinkedFileError, LinkedFiles
from .loading import document_of, parts_of, texture_of, whole_mesh
from .posed_parts import MAX_REPEATED, counts_of, document_objects
from .registry import Reader, find_reader
from .scene_tree import links_of, pose_parts, shown_parts
from .sources import Source
from .text import shown
from .warning_list import WarningList

FORMAT = "engine3d scene"
VERSION = 1
#: Keys of a file, but for ``format`` and ``version``.
LISTS = ("environments", "textures", "materials", "objects", "nodes")

# A node takes about a kilobyte, however little the file says of it.
_NODES, _BYTES_OF_A_NODE = 20_000, 32
_MAX_NAME = 4096
_MAX_COPIES = 20_000
_SIGNATURE = re.compile(rb'\A(?:\xef\xbb\xbf)?\s*\{\s*"format"\s*:\s*"engine3d scene"')
_MATERIAL_FIELDS = frozenset(inspect.signature(Material).parameters)
_ARRAYS = {name.removeprefix("_given_") for name in Mesh([])._arrays}


def read_scene_file(source: Source, split: bool = False) -> Document:
    """Read a scene.

    Parameters
    ----------
    source : Source
    split : bool
        Keep the poses apart; otherwise they are applied to what shows.

    Raises
    ------
    FileFormatError
        The file is damaged, or of a newer version; the message names the place.
    """
    root = parsed_json(source)
    _check_format(root)
    warnings = WarningList(source.path)
    for key in root.members():
        if key not in ("format", "version", "scene", *LISTS):
            warnings.add(f"{shown(key)} is not known")
    reading = _Reading(source, root, warnings)
    record = reading.record()
    parts = [part for part in shown_parts(record, source) if len(part.mesh.positions)]
    objects = document_objects(source, parts, MAX_REPEATED + source.size, split) if parts else []
    if not (objects or split):
        raise FileFormatError("no vertices in this scene", source.path)
    counts = {
        **counts_of(objects),
        "nodes": len(record.nodes),
        "materials": [material.name for material in record.materials],
    }
    told = [*warnings.messages(), *reading.told]
    return Document("e3d", objects, counts=counts, warnings=told, scene=record)


def _check_format(root: JsonValue) -> None:
    if not isinstance(root.value, dict) or root.value.get("format") != FORMAT:
        raise root.error(f'not a scene of engine3d: it does not begin with "format": "{FORMAT}"')
    version = root.need("version").value
    if type(version) is not int or version < 1:
        raise root.need("version").wrong("a version")
    if version > VERSION:
        raise root.error(f"a scene of version {version}, which a newer engine3d reads")


def _sky(entry: JsonValue) -> Environment:
    """The sky of an entry, by where the sun stands."""
    turbidity, disc = entry.get("turbidity"), entry.get("sun_disc")
    try:
        return Environment.sky(
            entry.need("sun_direction").value,
            3.0 if turbidity is None else turbidity.value,
            sun_disc=disc is None or disc.flag(),
        )
    except (InvalidArgumentError, TypeError) as error:
        raise entry.error(str(error)) from None


class _Reading:
    """Makes textures, materials and meshes, in this order."""

    def __init__(self, source: Source, root: JsonValue, warnings: WarningList) -> None:
        self._source, self._root, self._warnings = source, root, warnings
        self._files = LinkedFiles.of(source)
        self._images: dict[str, Texture] = {}
        self._meshes: dict[tuple, dict[Any, Mesh] | Exception] = {}
        self._primitives: dict[tuple[str, str], Mesh] = {}
        self._given: dict[tuple, int] = {}  # how often each part was given out
        self._materials_of: dict[Mesh, list[Material]] = {}  # as they were read
        self._copies: dict[tuple[int, int], Material] = {}
        self.told: list[str] = []  # by the files that are named
        self._vertices_left = MAX_REPEATED + source.size

    def record(self) -> SceneRecord:
        root = self._root
        environments = [self._environment(entry) for entry in root.entries("environments")]
        self._textures = [self._texture(entry) for entry in root.entries("textures")]
        self._materials = [self._material(entry) for entry in root.entries("materials")]
        objects = root.entries("objects")
        meshes = {
            number: self._mesh(entry)
            for number, entry in enumerate(objects)
            if entry.need("kind").text() == "mesh"
        }
        nodes = root.entries("nodes")
        if len(nodes) > _NODES + self._source.size // _BYTES_OF_A_NODE:
            raise root.error(f"{len(nodes)} nodes are more than the file can say something of")
        return SceneRecord(
            root.get("scene") or JsonValue({}, self._source.path),
            self._materials,
            meshes,
            objects,
            nodes,
            [pose_parts(node) for node in nodes],
            *links_of(nodes),
            environments,
        )

    def _environment(self, entry: JsonValue) -> Environment | None:
        """None, with a warning, for that of a file which can't be read."""
        if (name := entry.get("built_in")) is not None:
            if name.text() not in BUILT_IN:
                raise name.wrong(f"one of {', '.join(BUILT_IN)}")
            if name.text() == "sky" and "sun_direction" in entry.members():
                return _sky(entry)
            return named_environment(name.text())
        if (file := entry.get("file")) is not None:
            try:
                with self._files.read(self._files.find(file.text())) as source:
                    return environment_of(source)
            except (LinkedFileError, FileFormatError, OSError) as error:
                left_out = f"environment {shown(file.text())} is left out: {error}"
                self._warnings.add(f"{file.where}: {left_out}")
                return None
        pixels, name = entry.need("pixels"), entry.get("name")
        try:
            return Environment(pixels.array(), name="" if name is None else name.text())
        except InvalidArgumentError as error:
            raise pixels.error(str(error)) from None

    def _texture(self, entry: JsonValue) -> Texture:
        held = entry.members()
        numbers = [key for key in held if key in ("anisotropy", "lod_bias")]
        texts = (key for key in held if key not in ("file", "png", "wrap", *numbers))
        options: dict[str, Any] = {key: held[key].text() for key in texts}
        options |= {key: held[key].value for key in numbers}  # which Texture checks
        if (wrap := entry.get("wrap")) is not None:
            pair = isinstance(wrap.value, list)
            options["wrap"] = tuple(side.text() for side in wrap) if pair else wrap.text()
        png = entry.get("png")
        try:
            if png is None:
                return self._texture_of_file(entry.need("file"), options)
            name = f"{self._source.path}: {png.where}"
            pixels = read_image(Source(name, png.base64()))
            return Texture(pixels, **options)
        except FileFormatError:
            raise
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None

    def _texture_of_file(self, file: JsonValue, options: dict[str, Any]) -> Texture:
        name = file.text()
        if name not in self._images:
            self._images[name] = self._image(name, file)
        image = self._images[name]
        texture = Texture(image.pixels, **options)
        texture._path, texture._is_missing = image._path, image._is_missing
        return texture

    def _image(self, name: str, file: JsonValue) -> Texture:
        """The image of a file, or one that keeps its place, with a warning."""
        try:
            with self._files.read(self._files.find(name)) as source:
                return texture_of(source)
        except (LinkedFileError, FileFormatError, OSError) as error:
            self._warnings.add(f"{file.where}: texture {shown(name)} is left out: {error}")
        image = Texture(np.full((1, 1, 3), 255, np.uint8))
        image._path, image._is_missing = self._place_of(name), True
        return image

    def _material(self, entry: JsonValue) -> Material:
        values = {key: held.value for key, held in entry.members().items()}
        for slot in TEXTURE_SLOTS:
            if slot in values:
                values[slot] = self._slot(entry.need(slot))
        if values.get("attenuation_distance", 0) is None:
            values["attenuation_distance"] = math.inf
        try:
            with certainly_linear():
                if not values.keys() <= _MATERIAL_FIELDS:
                    return Material(**values)  # which says what it does not know
                material = Material()
                for key, value in values.items():
                    setattr(material, key, value)
                return material
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None

    def _slot(self, entry: JsonValue) -> Texture | PlacedTexture:
        """A texture by its number, or one that is placed."""
        if not isinstance(entry.value, dict):
            return self._textures[entry.index(len(self._textures), "textures")]
        values = {key: held.value for key, held in entry.members().items()}
        number = entry.need("texture").index(len(self._textures), "textures")
        try:
            return PlacedTexture(**{**values, "texture": self._textures[number]})
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None

    def _mesh(self, entry: JsonValue) -> Mesh:
        if entry.get("file") is not None:
            mesh = self._mesh_of_file(entry)
        elif entry.get("primitive") is not None:
            mesh = self._primitive(entry)
        else:
            mesh = self._mesh_of_arrays(entry)
        try:
            if (materials := entry.get("materials")) is not None:
                mesh.materials = self._chosen(materials)
        except InvalidArgumentError as error:
            raise entry.error(str(error)) from None
        if (name := entry.get("name")) is not None:
            mesh.name = name.text()
        return mesh

    def _chosen(self, materials: JsonValue) -> list[Material]:
        count = len(self._materials)
        return [self._materials[number.index(count, "materials")] for number in materials]

    def _mesh_of_arrays(self, entry: JsonValue) -> Mesh:
        held = entry.need("arrays")
        for key in held.members():
            if key not in _ARRAYS:
                raise held.error(f"meshes have no array {shown(key)}")
        arrays = {key: value.array() for key, value in held.members().items()}
        groups = entry.get("groups")
        materials = entry.get("materials")
        chosen = None if materials is None else self._chosen(materials)
        try:
            angle = _crease_angle(entry, SMOOTH)
            mesh = Mesh(arrays.pop("positions", ()), **arrays, materials=chosen, crease_angle=angle)
            if groups is not None:
                mesh.groups = {key: value.array() for key, value in groups.members().items()}
        except InvalidArgumentError as error:
            raise entry.error(str(error)) from None
        return mesh

    def _primitive(self, entry: JsonValue) -> Mesh:
        name = entry.need("primitive")
        if name.text() not in primitives.__all__:
            raise name.wrong(f"one of {', '.join(primitives.__all__)}")
        given = entry.get("arguments")
        members = {} if given is None else given.members()
        arguments = {key: value.value for key, value in members.items()}
        self._vertices_left -= _vertices_of(arguments)
        if self._vertices_left < 0:
            raise entry.error("more vertices of primitives than such a file may ask for")
        key = name.value, repr(arguments)
        if key in self._primitives:  # made once: scenes hold thousands that are alike
            return self._repeated(self._primitives[key])
        try:
            mesh = getattr(primitives, name.value)(**arguments)
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None
        self._primitives[key], self._materials_of[mesh] = mesh, mesh.materials
        return mesh

    def _repeated(self, mesh: Mesh) -> Mesh:
        """A primitive that is like another one, with arrays that both share."""
        return mesh._twin([m._twin() for m in self._materials_of[mesh]], _name_in_file(mesh))

    def _mesh_of_file(self, entry: JsonValue) -> Mesh:
        """A mesh of a file, or an empty one that keeps its place, with a warning."""
        name, part = entry.need("file").text(), None
        if (text := entry.get("part")) is not None:
            place = entry.get("occurrence")
            part = text.text(), 0 if place is None else place.index(2**31, "parts")
        format = None if entry.get("format") is None else entry.need("format").text()
        try:
            angle = _crease_angle(entry, CREASE_ANGLE)
            return self._part(name, format, part, angle)
        except (LinkedFileError, FileFormatError, OSError) as error:
            self._warnings.add(f"{entry.where}: mesh {shown(name)} is left out: {error}")
        except InvalidArgumentError as error:
            raise entry.error(str(error)) from None
        mesh = Mesh([], name=part[0] if part else "")
        path = self._place_of(name)
        if path is not None:
            remember_origin(mesh, FileOrigin(path, format, part, True, angle))
        return mesh

    def _part(
        self, name: str, format: str | None, part: tuple[str, int] | None, crease_angle: float
    ) -> Mesh:
        """A part of a file, or all of it; each file is read once, and each mesh given out once."""
        key = name, format, part is not None, crease_angle
        if key not in self._meshes:
            try:
                self._meshes[key] = self._read(*key)
            except (LinkedFileError, FileFormatError, OSError) as error:
                self._meshes[key] = error
        found = self._meshes[key]
        if isinstance(found, Exception):
            raise found.with_traceback(None)
        mesh = found.get(part)
        if mesh is None:
            raise LinkedFileError(f"it has no part {shown(part[0])} number {part[1]}")
        times = self._given[key, part] = self._given.get((key, part), -1) + 1
        return self._twin(mesh, times) if times else mesh

    def _twin(self, mesh: Mesh, times: int) -> Mesh:
        """A mesh that is used once more: parts of a file share materials only if all are new."""
        materials = [self._material_copy(m, times) for m in self._materials_of[mesh]]
        return mesh._twin(materials, _name_in_file(mesh))

    def _material_copy(self, material: Material, times: int) -> Material:
        key = id(material), times
        if key not in self._copies:
            if len(self._copies) >= _MAX_COPIES:
                raise FileFormatError(f"more than {_MAX_COPIES} materials of repeated files")
            self._copies[key] = material._twin()
        return self._copies[key]

    def _read(
        self, name: str, format: str | None, split: bool, crease_angle: float
    ) -> dict[Any, Mesh]:
        with self._files.read(self._files.find(name)) as source:
            source = source._replace(crease_angle=crease_angle, root=self._source.root)
            if find_reader(source, "mesh", format).read is read_scene_file:
                raise FileFormatError("a scene within a scene is not read", source.path)
            document = document_of(source, format, split=split)
            self.told += document.warnings
            parts: dict[Any, Mesh] = (
                dict(parts_of(document, source, format))
                if split
                else {None: whole_mesh(document, source, format)}
            )
            self._materials_of.update((mesh, mesh.materials) for mesh in parts.values())
            return parts

    def _place_of(self, name: str) -> str | None:
        """Where a file would be that was not found, if it has a place."""
        folder = self._source.folder
        if folder is None or "\0" in name or len(name) > _MAX_NAME:
            return None
        return os.path.abspath(os.path.join(folder, name))


def _name_in_file(mesh: Mesh) -> str:
    """The name that a mesh came with, whatever it is called by now."""
    return mesh.name if mesh._origin is None else mesh._origin.name


def _crease_angle(entry: JsonValue, usual: float) -> float:
    angle = entry.get("crease_angle")
    return usual if angle is None else check_crease_angle(angle.value)


def _vertices_of(arguments: dict[str, Any]) -> int:
    """About how many vertices a primitive has."""
    segments = arguments.get("segments", 1)
    counts = segments if isinstance(segments, list) else [segments]
    whole = [count for count in counts if type(count) is int and count > 0]
    subdivisions = arguments.get("subdivisions", 0)
    if type(subdivisions) is int and 0 < subdivisions < 32:
        whole.append(4**subdivisions * 10)
    return math.prod(count + 1 for count in whole)


def _is_scene(head: bytes) -> bool:
    return _SIGNATURE.match(head) is not None


READERS = (Reader("e3d", "engine3d scene", "mesh", (".json",), read_scene_file, _is_scene),)

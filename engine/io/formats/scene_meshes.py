"""The meshes of a scene file: from other files, primitives, or embedded arrays.

In: entries of the file's list of objects. Out: meshes, or an error that names the place.
"""

from __future__ import annotations

import math
from typing import Any

from ...errors import FileFormatError, InvalidArgumentError
from ...model import primitives
from ...model.geometry.creases import CREASE_ANGLE, SMOOTH, check_crease_angle
from ...model.geometry.derived import arrays_of
from ...model.geometry.mesh import Mesh
from ...model.geometry.origins import FileOrigin, remember_origin
from ...model.geometry.twins import twin_of
from ...model.geometry.values import Values
from ...model.materials.linear_colors import floats_are_linear
from ...model.materials.material import Material, copy_of
from ..reading.json_values import JsonValue
from ..reading.linked_files import LinkedFileError, LinkedFiles
from ..reading.posed_parts import MAX_REPEATED
from ..reading.sources import Source
from ..reading.text import shown
from ..reading.warning_list import WarningList
from .scene_looks import SceneLooks, place_of
from .scene_parts import PartsOfFiles, name_in_file

_ARRAYS = {name.removeprefix("_given_") for name in arrays_of(Mesh([]))}


class SceneMeshes:
    """Builds the meshes of a scene file; those of other files come from ``parts``."""

    def __init__(
        self, source: Source, looks: SceneLooks, files: LinkedFiles, warnings: WarningList
    ) -> None:
        self._source, self._looks, self._warnings = source, looks, warnings
        self.parts = PartsOfFiles(source, files)
        self._primitives: dict[
            tuple[str, str], tuple[Mesh, list[Material]]
        ] = {}  # with their materials
        self._vertices_left = MAX_REPEATED + source.size

    def mesh(self, entry: JsonValue) -> Mesh:
        """Return the mesh of an entry."""
        if entry.get("file") is not None:
            mesh = self._mesh_of_file(entry)
        elif entry.get("primitive") is not None:
            mesh = self._primitive(entry)
        else:
            mesh = self._mesh_of_arrays(entry)
        try:
            if (materials := entry.get("materials")) is not None:
                mesh.materials = self._looks.chosen(materials)
        except InvalidArgumentError as error:
            raise entry.error(str(error)) from None
        if (name := entry.get("name")) is not None:
            mesh.name = name.text()
        return mesh

    def _mesh_of_arrays(self, entry: JsonValue) -> Mesh:
        held = entry.need("arrays")
        for key in held.members():
            if key not in _ARRAYS:
                raise held.error(f"meshes have no array {shown(key)}")
        arrays = {key: value.array() for key, value in held.members().items()}
        groups = entry.get("groups")
        materials = entry.get("materials")
        chosen = None if materials is None else self._looks.chosen(materials)
        try:
            angle = _crease_angle(entry, SMOOTH)
            with floats_are_linear():
                mesh = Mesh(
                    arrays.pop("positions", ()),
                    **arrays,
                    materials=chosen,
                    crease_angle=angle,
                    name="",
                )
            values = entry.get("values")
            if values is not None:
                mesh.values = {key: _values(held) for key, held in values.members().items()}
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
        if key in self._primitives:  # cached: scenes may contain thousands of equal ones
            made, materials = self._primitives[key]
            return twin_of(made, [copy_of(one) for one in materials], name_in_file(made))
        try:
            mesh = getattr(primitives, name.value)(**arguments)
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None
        self._primitives[key] = mesh, mesh.materials
        return mesh

    def _mesh_of_file(self, entry: JsonValue) -> Mesh:
        """Return a mesh of a file, or an empty placeholder with a warning."""
        name, part = entry.need("file").text(), None
        if (text := entry.get("part")) is not None:
            place = entry.get("occurrence")
            part = text.text(), 0 if place is None else place.index(2**31, "parts")
        format = None if entry.get("format") is None else entry.need("format").text()
        try:
            angle = _crease_angle(entry, CREASE_ANGLE)
            return self.parts.part(name, format, part, angle)
        except (LinkedFileError, FileFormatError, OSError) as error:
            self._warnings.add(f"{entry.where}: mesh {shown(name)} is left out: {error}")
        except InvalidArgumentError as error:
            raise entry.error(str(error)) from None
        mesh = Mesh([], name=part[0] if part else "")
        path = place_of(self._source, name)
        if path is not None:
            remember_origin(mesh, FileOrigin(path, format, part, True, angle))
        return mesh


def _values(entry: JsonValue) -> Values:
    on: Any = entry.need("on").text()
    return Values(entry.need("array").array(), on)


def _crease_angle(entry: JsonValue, usual: float) -> float:
    angle = entry.get("crease_angle")
    return usual if angle is None else check_crease_angle(angle.value)


def _vertices_of(arguments: dict[str, Any]) -> int:
    """Return the approximate number of vertices of a primitive."""
    segments = arguments.get("segments", 1)
    counts = segments if isinstance(segments, list) else [segments]
    whole = [count for count in counts if type(count) is int and count > 0]
    subdivisions = arguments.get("subdivisions", 0)
    if type(subdivisions) is int and 0 < subdivisions < 32:
        whole.append(4**subdivisions * 10)
    return math.prod(count + 1 for count in whole)

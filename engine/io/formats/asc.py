"""3D Studio ASCII (.asc): the printed listing of a scene's objects, lights and cameras.

In: the bytes of a file. Out: a `Document` with one object for each tri-mesh. Page marks and empty
lines may occur anywhere, also inside lists; a control-Z ends the file. Edge flags (AB, BC, CA)
become visible edges, smoothing groups become normals: faces without one are flat. Coordinates are
unchanged, with +Z up. The format has no material definitions: a name such as ``r255g128b0a0`` is a
colour, other materials are plain.
"""

from __future__ import annotations

import math
import re
from typing import Any, NoReturn

import numpy as np

from ...errors import FileFormatError
from ..reading.documents import CameraRecord, Document, LightRecord
from ..reading.linked_textures import give_companion_texture
from ..reading.number_arrays import parse_float
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from ..reading.text import decoded, shown, text_lines
from ..reading.warning_list import WarningList
from .asc_meshes import (
    FACES,
    MATERIAL,
    SMOOTHING,
    UNNAMED,
    VERTICES,
    MeshRecord,
    material_of,
    object_of,
)

_END_OF_FILE = b"\x1a"
_NUMBER = r"\s*(\S+)"
_POINT = rf"X:{_NUMBER}\s+Y:{_NUMBER}\s+Z:{_NUMBER}"
_COLOR = rf"Red={_NUMBER}\s+Green={_NUMBER}\s+Blue={_NUMBER}"
_VERTEX = re.compile(rf"Vertex\s+(\d+)\s*:\s*{_POINT}(?:\s+U:{_NUMBER}\s+V:{_NUMBER})?\s*$")
_CORNERS = rf"A:{_NUMBER}\s+B:{_NUMBER}\s+C:{_NUMBER}"
_FLAGS = rf"AB:{_NUMBER}\s+BC:{_NUMBER}\s+CA:{_NUMBER}"
_FACE = re.compile(rf"Face\s+(\d+)\s*:\s*{_CORNERS}(?:\s+{_FLAGS})?\s*$")
_TRI_MESH = re.compile(r"Tri-mesh,\s*Vertices:\s*(\S+)\s+Faces:\s*(\S+)\s*$")
_PAGE = re.compile(r"Page\s+\d+$")
_CAMERA = re.compile(r"Camera\s*\(\s*([^\s)]+)\s*mm\s*\)")

# 3D Studio's lens table (15 mm: 115 degrees ... 50 mm: 46 degrees) gives the angle of the diagonal
# of 35 mm film, 43.27 mm, which 3D Studio applied to the width of its 4:3 pictures.
_FILM = 43.27
_ASPECT = 4 / 3
_UP = (0.0, 0.0, 1.0)
_MAX_OBJECTS = 5000


def read_asc(source: Source, split: bool = False) -> Document:
    """Read a 3D Studio ASCII file, as `Reader.read`; each tri-mesh is always one object.

    With ``split``, coordinates far from the origin are moved near it.
    """
    parser = _Parser(source)
    parser.parse()
    materials = [material_of(name) for name in parser.material_names]
    warnings = parser.warnings
    objects = [object_of(record, materials, split) for record in parser.meshes]
    meshes = [entry.mesh for entry in objects]
    if any(mesh.uvs is not None for mesh in meshes):
        painted = {id(m): m for mesh in meshes for m in mesh.materials}.values()
        give_companion_texture(source, list(painted), warnings)
    return Document(
        "asc",
        objects,
        parser.lights,
        parser.cameras,
        _counts(parser),
        warnings.messages(),
    )


class _Parser:
    """Parses the lines in one pass; each line belongs to the last named object.

    C reads vertices, faces and statements about faces, up to the first other line.
    """

    def __init__(self, source: Source) -> None:
        if _END_OF_FILE in source.data:
            source = source._replace(content=source.data.partition(_END_OF_FILE)[0])
        self._text = text_lines(source)
        self._path = source.path
        # The line number at the byte counted up to.
        self._number, self._counted = 1, 0
        self._name = ""
        self._mesh: MeshRecord | None = None
        self._item: LightRecord | CameraRecord | None = None
        # By text, the meaning of lines about faces; and the last warned line, and its place.
        self._materials: dict[bytes, int] = {}
        self._groups: dict[bytes, int] = {}
        self._warned = 1, 0
        self.warnings = WarningList(source.path)
        self.meshes: list[MeshRecord] = []
        self.lights: list[LightRecord] = []
        self.cameras: list[CameraRecord] = []
        self.material_names: dict[str, int] = {}

    def parse(self) -> None:
        place = 0
        while place < len(self._text):
            if self._mesh is not None:
                place = self._mesh.rows.read(place)
            if place < len(self._text):
                end = self._text.index(b"\n", place)
                self._number += self._text.count(b"\n", self._counted, place)
                self._counted = place
                self._read_line(decoded(self._text[place:end]).strip())
                place = end + 1
        self._finish_mesh()
        if not self.meshes:
            raise FileFormatError("no tri-mesh in it: not a 3D Studio ASCII model", self._path)

    def _read_line(self, line: str) -> None:
        if line.startswith("Vertex "):
            self._read_vertex(line)
        elif line.startswith("Face "):
            self._read_face(line)
        elif line and not self._read_other(line) and not _PAGE.match(line):
            self.warnings.add(f"{shown(line)} is not understood", self._number)

    def _read_vertex(self, line: str) -> None:
        if line.startswith("Vertex list"):
            return
        mesh, match = self._open_mesh(line), _VERTEX.match(line)
        if match is None:
            self._fail(f"not a whole vertex: {shown(line)}")
        count = mesh.count(VERTICES)
        self._check_number(match[1], count, mesh.vertex_count, "vertex", "vertices")
        has_uv = match[5] is not None
        numbers = [self._float(match[k]) for k in range(2, 7 if has_uv else 5)]
        mesh.rows.add(VERTICES, numbers if has_uv else [*numbers, 0, 0], has_uv)

    def _read_face(self, line: str) -> None:
        mesh = self._open_mesh(line)
        if line.startswith("Face list"):
            return
        match = _FACE.match(line)
        if match is None:
            self._fail(f"not a whole face: {shown(line)}")
        self._check_number(match[1], mesh.count(FACES), mesh.face_count, "face", "faces")
        corners = [self._index(match[k], mesh.count(VERTICES)) for k in (2, 3, 4)]
        mesh.rows.add(FACES, [*corners, *(match[k] != "0" for k in (5, 6, 7))])

    def _read_other(self, line: str) -> bool:
        """Read a line that is not a vertex or a face; return False for unknown content."""
        keyword, _, rest = line.partition(":")
        rest = rest.strip()
        if keyword == "Named object":
            self._finish_mesh()
            self._item = None
            self._name = rest.strip('"')
        elif keyword in ("Material", "Smoothing"):
            self._open_mesh(keyword)
        elif keyword.startswith("Tri-mesh"):
            self._start_mesh(line)
        elif line == "Mapped":
            self._open_mesh(line).is_mapped = True
        else:
            return self._read_light_or_camera(line, keyword, rest)
        return True

    def _start_mesh(self, line: str) -> None:
        self._finish_mesh()
        match = _TRI_MESH.match(line)
        if match is None:
            self._fail(f"not a whole tri-mesh line: {shown(line)}")
        counts = [self._count(match[k]) for k in (1, 2)]
        self._mesh = MeshRecord(self._text, self._name, self._number, *counts)

    def _finish_mesh(self) -> None:
        mesh, self._mesh = self._mesh, None
        if mesh is None:
            return
        for found, announced, what in (
            (mesh.count(VERTICES), mesh.vertex_count, "vertices"),
            (mesh.count(FACES), mesh.face_count, "faces"),
        ):
            if found != announced:
                raise FileFormatError(
                    f"{announced} {what} announced for {shown(mesh.name)}, {found} are there",
                    self._path,
                    mesh.line,
                )
        self._take_marks(mesh)
        mesh.is_mapped |= mesh.rows.count(VERTICES)[1] > 0
        if not mesh.face_count:
            self.warnings.add(f"tri-mesh {shown(mesh.name)} without faces is left out", mesh.line)
        elif len(self.meshes) >= _MAX_OBJECTS:
            raise FileFormatError(f"more than {_MAX_OBJECTS} objects", self._path, mesh.line)
        else:
            self.meshes.append(mesh)

    def _take_marks(self, mesh: MeshRecord) -> None:
        """Apply statements about a mesh's faces; most of them repeat."""
        marks = mesh.rows.take_marks()
        if not len(marks):
            return
        for form, known, read in (
            (MATERIAL, self._materials, self._read_material),
            (SMOOTHING, self._groups, self._read_groups),
        ):
            chosen = marks[marks["form"] == form]
            places = zip(chosen["start"].tolist(), chosen["end"].tolist(), strict=True)
            said = [
                known[text] if (text := self._text[start:end]) in known else read(text, start)
                for start, end in places
            ]
            # A statement before the first face applies to no face.
            has_face = chosen["rows"] > 0
            mesh.said[form] = chosen["rows"][has_face] - 1, np.array(said, np.int64)[has_face]

    def _read_material(self, text: bytes, place: int) -> int:
        name = decoded(text).strip().strip('"')
        number = self.material_names.setdefault(name, len(self.material_names))
        self._materials[text] = number if name else UNNAMED
        return self._materials[text]

    def _read_groups(self, text: bytes, place: int) -> int:
        """Return a line's smoothing groups as bits; cached if all of them are valid."""
        groups, is_sound = 0, True
        for word in decoded(text).replace(",", " ").split():
            digits = word.lstrip("0")
            if not (
                digits.isascii() and digits.isdigit() and len(digits) < 3 and int(digits) <= 32
            ):
                is_sound = False
                self._warn_of_group(word, place)
            else:
                groups |= 1 << (int(digits) - 1)
        if is_sound:
            self._groups[text] = groups
        return groups

    def _warn_of_group(self, word: str, place: int) -> None:
        number, counted = self._warned
        number += self._text.count(b"\n", counted, place)
        self._warned = number, place
        self.warnings.add(f"smoothing group {shown(word)} is left out", number)

    def _read_light_or_camera(self, line: str, keyword: str, rest: str) -> bool:
        camera = _CAMERA.match(line)
        if line in ("Direct light", "Spotlight"):
            self._item = LightRecord("point", name=self._name)
            self.lights.append(self._item)
        elif camera is not None:
            yfov = self._field_of_view(camera[1])
            self._item = CameraRecord((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), yfov, _UP, 0.0, self._name)
            self.cameras.append(self._item)
        elif keyword == "Ambient light color":
            color = self._color(rest)
            if any(color):
                self.lights.append(LightRecord("ambient", color=color, name="ambient"))
        elif self._item is None:
            return False
        elif keyword == "Position":
            self._item.position = self._point(rest)
        elif isinstance(self._item, CameraRecord):
            return self._read_camera(self._item, keyword, rest)
        else:
            return self._read_light(self._item, keyword, rest)
        return True

    def _read_camera(self, camera: CameraRecord, keyword: str, rest: str) -> bool:
        if keyword == "Target":
            camera.target = self._point(rest)
        elif keyword == "Bank angle":
            camera.roll = math.radians(self._first_float(rest))
        else:
            return False
        return True

    def _read_light(self, light: LightRecord, keyword: str, rest: str) -> bool:
        if keyword == "Light color":
            light.color = self._color(rest)
        elif keyword == "Spotlight to":
            light.kind = "spot"
            light.target = self._point(rest)
        elif keyword == "Falloff size":
            light.angle = math.radians(self._first_float(rest))
        else:
            return keyword == "Hotspot size"
        return True

    def _open_mesh(self, line: str) -> MeshRecord:
        if self._mesh is None:
            self._fail(f"{shown(line)} outside a tri-mesh")
        return self._mesh

    def _check_number(self, word: str, expected: int, announced: int, one: str, many: str) -> None:
        if expected >= announced:
            self._fail(f"more {many} than the {announced} announced")
        if word.lstrip("0") != str(expected).lstrip("0"):
            self._fail(f"{one} {shown(word)} where {one} {expected} is due")

    def _count(self, word: str) -> int:
        if not (word.isascii() and word.isdigit() and len(word) < 12):
            self._fail(f"not a count: {shown(word)}")
        return int(word)

    def _index(self, word: str, count: int) -> int:
        if not (word.isascii() and word.isdigit()):
            self._fail(f"not a vertex index: {shown(word)}")
        if len(word) > 10 or int(word) >= count:
            self._fail(f"vertex index out of range, there are {count}: {shown(word)}")
        return int(word)

    def _float(self, word: str) -> float:
        try:
            return parse_float(word.encode())
        except ValueError:
            self._fail(f"not a number: {shown(word)}")

    def _first_float(self, rest: str) -> float:
        value = self._float((rest.split() or [""])[0])
        return value if math.isfinite(value) else 0.0

    def _point(self, rest: str) -> tuple[float, float, float]:
        return self._three(re.match(_POINT, rest), rest)

    def _color(self, rest: str) -> tuple[float, float, float]:
        red, green, blue = self._three(re.match(_COLOR, rest), rest)
        return max(0.0, red), max(0.0, green), max(0.0, blue)

    def _three(self, match: re.Match[str] | None, rest: str) -> tuple[float, float, float]:
        if match is None:
            self._fail(f"three numbers are missing: {shown(rest)}")
        x, y, z = (self._float(match[k]) for k in (1, 2, 3))
        if not all(map(math.isfinite, (x, y, z))):
            self._fail(f"not a finite number: {shown(rest)}")
        return x, y, z

    def _field_of_view(self, word: str) -> float:
        """Return the vertical field of view in radians for a lens in millimetres."""
        lens = self._float(word)
        if not (math.isfinite(lens) and lens > 0):
            self._fail(f"not a lens: {shown(word)}")
        return 2 * math.atan(_FILM / 2 / lens / _ASPECT)

    def _fail(self, message: str) -> NoReturn:
        raise FileFormatError(message, self._path, self._number)


def _counts(parser: _Parser) -> dict[str, Any]:
    return {
        "vertices": sum(mesh.vertex_count for mesh in parser.meshes),
        "uvs": sum(mesh.vertex_count for mesh in parser.meshes if mesh.is_mapped),
        "normals": 0,
        "faces": sum(mesh.face_count for mesh in parser.meshes),
        "triangles": sum(mesh.face_count for mesh in parser.meshes),
        "lines": 0,
        "points": 0,
        "objects": [mesh.name for mesh in parser.meshes],
        "groups": [],
        "materials": [name for name in parser.material_names if name],
        "lights": [light.name for light in parser.lights],
        "cameras": [camera.name for camera in parser.cameras],
    }


def _resembles_asc(head: bytes, size: int) -> bool:
    return head.lstrip().startswith((b"Ambient light color", b"Named object"))


READERS = (
    Reader(
        "asc", "3D Studio ASCII", "mesh", (".asc",), read_asc, resembles=_resembles_asc, up="+Z"
    ),
)

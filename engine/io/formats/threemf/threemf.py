"""3MF, the 3D Manufacturing Format: meshes for printers, with colours and textures.

In: a ZIP package of XML. Out: a `Document` with an object for each mesh in the build, placed by
items and nested components. Coordinates are the file's, in `Document.unit`, with +Z up; parts in
other units are scaled to the first part's.
"""

from __future__ import annotations

import posixpath

import numpy as np

from ....errors import FileFormatError
from ....model.geometry.mesh import Mesh
from ...reading.documents import Document
from ...reading.posed_parts import MAX_REPEATED, PosedPart, counts_of, document_objects
from ...reading.reader_registry import Reader
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList
from ...reading.xml_events import Attributes, read_xml
from ...reading.zip_archives import ZIP, ZipArchive
from .threemf_blocks import cut_lists
from .threemf_meshes import MeshBuilder
from .threemf_model import UNITS, ModelParser, ModelPart, ObjectRecord, Placement

_MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_RELATIONS = "_rels/.rels"
# Components may contain components, and each may be placed many times.
_MOST_DEPTH = 32
_MOST_PLACED = 1 << 16
# Parts up to these sizes, absolute and relative to the file, are read into memory as a whole.
_AT_ONCE, _RATIO_AT_ONCE = 4 << 20, 16


def read_3mf(source: Source, split: bool = False) -> Document:
    """Read a 3MF file, as `Reader.read`; each placed mesh is an object."""
    if source.head(len(ZIP)) != ZIP:
        raise FileFormatError("not a 3mf file", source.path)
    warnings = WarningList(source.path)
    package = _Package(source, warnings, split)
    parts = package.placed()
    objects = document_objects(source, parts, MAX_REPEATED + source.size, split)
    counts = counts_of(objects)
    names = {m.name: None for part in parts for m in part.mesh.materials if m.name}
    counts["materials"] = list(names)
    return Document("3mf", objects, counts=counts, warnings=warnings.messages(), unit=package.unit)


class _Package:
    """The parts of a file, each read once, with their meshes."""

    def __init__(self, source: Source, warnings: WarningList, split: bool) -> None:
        self._source, self._warnings, self._split = source, warnings, split
        self._archive = ZipArchive(source)
        self._parts: dict[str, tuple[ModelPart, MeshBuilder]] = {}
        self._meshes: dict[int, tuple[Mesh, np.ndarray | None]] = {}
        self._root = self._root_path()
        self._first = self._part(self._root)[0]
        self._placed: list[PosedPart] = []
        self._steps = 0
        self.unit = UNITS[self._first.unit][1]

    def _root_path(self) -> str:
        """Return the part with the build: the one the package names, or its only model."""
        found: list[str] = []

        def begin(name: str, attributes: Attributes, place: int) -> None:
            if attributes.get("Type") == _MODEL_TYPE:
                found.append(attributes.get("Target", ""))

        if _RELATIONS in self._archive:
            pieces = self._archive.pieces(_RELATIONS)
            read_xml(pieces, begin, lambda name: None, self._source.path, _RELATIONS)
        found += [name for name in self._archive.names if name.lower().endswith(".model")]
        if not found:
            raise FileFormatError("no 3MF file: there is no model in it", self._source.path)
        return found[0]

    def _part(self, path: str) -> tuple[ModelPart, MeshBuilder]:
        path = posixpath.normpath("/" + path.lstrip("/"))
        key = path.lower()
        if key not in self._parts:
            pieces = self._archive.pieces(path)
            lists: dict[int, np.ndarray] = {}
            if self._archive.size(path) <= _AT_ONCE + _RATIO_AT_ONCE * self._source.size:
                text, lists = cut_lists(b"".join(pieces))
                pieces = iter([text])
            parser = ModelParser(self._warnings, lists)
            read_xml(pieces, parser.begin, parser.end, self._source.path, path.lstrip("/"))
            part = parser.part
            builder = MeshBuilder(part, self._archive, self._source, self._warnings)
            self._parts[key] = part, builder
        return self._parts[key]

    def placed(self) -> list[PosedPart]:
        """Return the meshes that the build places; all meshes if it is empty."""
        items = self._first.items
        if not items:
            within = {c.object for entry in self._first.objects.values() for c in entry.components}
            items = [Placement(n, np.eye(4), "") for n in self._first.objects if n not in within]
        for item in items:
            self._place(item, np.eye(4), self._root, 1.0, 0)
        return self._placed

    def _place(
        self, placement: Placement, pose: np.ndarray, path: str, scale: float, depth: int
    ) -> None:
        """Add the meshes of a placement; ``scale`` belongs to the placing part."""
        path = placement.path or path
        part, builder = self._part(path)
        record = part.objects.get(placement.object)
        if record is None:
            raise FileFormatError(f"there is no object {placement.object}", self._source.path)
        self._steps += 1
        if depth > _MOST_DEPTH or self._steps > _MOST_PLACED:
            raise FileFormatError(
                f"object {shown(record.name)}: components are nested more than {_MOST_DEPTH} deep, "
                f"or place more than {_MOST_PLACED} objects",
                self._source.path,
            )
        own = UNITS[part.unit][0] / UNITS[self._first.unit][0]
        pose = pose @ placement.pose @ np.diag([own / scale] * 3 + [1.0])
        if record.positions:
            self._placed.append(self._posed(record, builder, pose))
        for component in record.components:
            self._place(component, pose, path, own, depth + 1)

    def _posed(self, record: ObjectRecord, builder: MeshBuilder, pose: np.ndarray) -> PosedPart:
        if id(record) not in self._meshes:
            self._meshes[id(record)] = builder.mesh(record, self._split)
        mesh, back = self._meshes[id(record)]
        return PosedPart(record.name, mesh, pose if back is None else pose @ back)


def _resembles(head: bytes, size: int) -> bool:
    """Return whether the file is a ZIP archive: no other format detected by content is one."""
    return head.startswith(ZIP)


READERS = (
    Reader(
        "3mf", "3D Manufacturing Format", "mesh", (".3mf",), read_3mf, resembles=_resembles, up="+Z"
    ),
)

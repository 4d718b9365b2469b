"""The parts of model files that a scene file refers to, each file read once.

In: the name of a file, and of a part. Out: a mesh; a repeated request gets another mesh that shares
its arrays. Parts of a file share materials only while each is requested for the first time.
"""

from __future__ import annotations

from typing import TypeAlias

from ...errors import FileFormatError
from ...model.geometry.mesh import Mesh
from ...model.geometry.origins import noted_origin
from ...model.geometry.twins import twin_of
from ...model.materials.material import Material, copy_of
from ..reading.linked_files import LinkedFileError, LinkedFiles
from ..reading.loading import document_of, parts_of, whole_mesh
from ..reading.reader_registry import find_reader
from ..reading.sources import Source
from ..reading.text import shown

_MAX_COPIES = 20_000
# A file's name, its format, whether parts are wanted, and the crease angle.
_Key: TypeAlias = tuple[str, str | None, bool, float]
# A part's name, and its index among parts with that name; None for the whole file.
_Part: TypeAlias = tuple[str, int] | None


class PartsOfFiles:
    """Meshes of the files that a scene refers to; ``told`` collects their readers' warnings."""

    def __init__(self, source: Source, files: LinkedFiles) -> None:
        self._source, self._files = source, files
        self._meshes: dict[_Key, dict[_Part, Mesh] | Exception] = {}
        self._given: dict[tuple[_Key, _Part], int] = {}  # how often each part was returned
        self._materials_of: dict[Mesh, list[Material]] = {}  # as they were read
        self._copies: dict[tuple[int, int], Material] = {}
        self.told: list[str] = []

    def part(self, name: str, format: str | None, part: _Part, crease_angle: float) -> Mesh:
        """Return a part of a file, or all of it, without reading a file twice."""
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
            assert part is not None  # the whole file always exists
            raise LinkedFileError(f"it has no part {shown(part[0])} number {part[1]}")
        times = self._given[key, part] = self._given.get((key, part), -1) + 1
        return self._twin(mesh, times) if times else mesh

    def _twin(self, mesh: Mesh, times: int) -> Mesh:
        """Return a mesh for a repeated use; parts share materials only on first use."""
        materials = [self._material_copy(m, times) for m in self._materials_of[mesh]]
        return twin_of(mesh, materials, name_in_file(mesh))

    def _material_copy(self, material: Material, times: int) -> Material:
        key = id(material), times
        if key not in self._copies:
            if len(self._copies) >= _MAX_COPIES:
                raise FileFormatError(f"more than {_MAX_COPIES} materials of repeated files")
            self._copies[key] = copy_of(material)
        return self._copies[key]

    def _read(
        self, name: str, format: str | None, split: bool, crease_angle: float
    ) -> dict[_Part, Mesh]:
        with self._files.read(self._files.find(name)) as source:
            source = source._replace(crease_angle=crease_angle, root=self._source.root)
            if find_reader(source, "mesh", format).name == "e3d":
                raise FileFormatError("a scene within a scene is not read", source.path)
            document = document_of(source, format, split=split)
            self.told += document.warnings
            parts: dict[_Part, Mesh] = (
                dict(parts_of(document, source, format).items())
                if split
                else {None: whole_mesh(document, source, format)}
            )
            self._materials_of.update((mesh, mesh.materials) for mesh in parts.values())
            return parts


def name_in_file(mesh: Mesh) -> str:
    """Return the name that a mesh had in its file."""
    came = noted_origin(mesh)
    return mesh.name if came is None else came.name

"""Writer of STL: the triangles of a mesh and their normals, binary or text."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.files.atomic_write import Files
from ...model.geometry.mesh import Mesh
from ...model.geometry.normals import face_area_vectors, unit_vectors
from ..writing.losses import lost_parts
from ..writing.rows import write_float_rows
from ..writing.writer_registry import Writer
from ..writing.written_names import encoded, line_text, renamed

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = b"STL written by engine3d".ljust(80)
_BLOCK = 1 << 14
_TEXT = (
    b"facet normal %s %s %s\nouter loop\n"
    b"vertex %s %s %s\nvertex %s %s %s\nvertex %s %s %s\nendloop\nendfacet\n"
)


def write_stl(mesh: Mesh, path: str, files: Files, ascii: bool = False) -> list[str]:
    """Write an STL file; return a line for each loss."""
    facets = np.zeros(len(mesh.faces), _FACET)
    facets["normal"] = unit_vectors(face_area_vectors(mesh.positions, mesh.faces))
    facets["corners"] = mesh.positions[mesh.faces]
    told: list[str] = []
    file = files.create(path)
    if ascii:
        name = line_text(mesh.name)
        told += renamed("solids", [mesh.name], [name])
        _write_text(file, encoded(name), facets)
    else:
        file.write(_HEADER + len(facets).to_bytes(4, "little"))
        file.write(facets.tobytes())
    parts = ("uvs", "uvs1", "tangents", "colors", "materials", "lines", "points", "groups")
    return told + lost_parts(mesh, "stl", *parts, "values", "normals", "edge_visible")


def _write_text(file: Any, name: bytes, facets: np.ndarray) -> None:
    file.write(b"solid " + name + b"\n")
    between = _TEXT.split(b"%s")
    for start in range(0, len(facets), _BLOCK):
        block = facets[start : start + _BLOCK]
        numbers = np.concatenate([block["normal"], block["corners"].reshape(-1, 9)], axis=1)
        write_float_rows(file, between, numbers)
    file.write(b"endsolid " + name + b"\n")


WRITERS = (Writer("stl", "STL", (".stl",), write_stl, ("ascii",)),)

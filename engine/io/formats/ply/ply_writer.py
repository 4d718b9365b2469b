"""Writer of PLY: vertices with attributes; polygons, lines and points.

Faces are written as their original polygons. ``position_id`` is our own property: vertices with the
same number are one point of the surface. Binary files are little-endian.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....base.files.atomic_write import Files
from ....model.geometry.mesh import Mesh
from ...writing.losses import lost_parts, not_held
from ...writing.outlines import Outlines, polygon_outlines
from ...writing.rows import float_words
from ...writing.writer_registry import Writer
from .ply_header import OWN_COMMENT

_TYPES = {"<f4": "float", "u1": "uchar", "<i4": "int"}
_BLOCK = 1 << 15


def write_ply(mesh: Mesh, path: str, files: Files, ascii: bool = False) -> list[str]:
    """Write a PLY file; return a line for each loss."""
    has_elements = len(mesh.faces) or len(mesh.lines)
    # Vertices alone are points.
    chosen = slice(None) if has_elements or not len(mesh.points) else mesh.points
    columns = [(name, code, values[chosen]) for name, code, values in _columns(mesh)]
    outlines = polygon_outlines(mesh)
    header = _header(mesh, columns, outlines, "ascii" if ascii else "binary_little_endian")
    file = files.create(path)
    file.write(header.encode())
    (_write_text if ascii else _write_binary)(file, columns, outlines, mesh.lines)
    points = ["points"] if has_elements else []
    lost = lost_parts(mesh, "ply", "uvs1", "tangents", "materials", *points, "groups")
    if outlines.lost_edges:
        lost += not_held("ply", [f"the hidden edges of {outlines.lost_edges} triangles"])
    return lost


def _columns(mesh: Mesh) -> list[tuple[str, str, np.ndarray]]:
    """Return name, type and values of each vertex property."""
    groups: list[tuple[tuple[str, ...], str, np.ndarray]]
    groups = [(("x", "y", "z"), "<f4", mesh.positions)]
    if mesh.has_normals:
        groups.append((("nx", "ny", "nz"), "<f4", mesh.normals))
    if mesh.uvs is not None:
        groups.append((("s", "t"), "<f4", mesh.uvs))
    if mesh.colors is not None:
        code = "u1" if mesh.colors.dtype == np.uint8 else "<f4"
        groups.append((("red", "green", "blue", "alpha"), code, mesh.colors))
    if mesh.position_ids is not None:
        groups.append((("position_id",), "<i4", mesh.position_ids[:, np.newaxis]))
    return [
        (name, code, values[:, column])
        for names, code, values in groups
        for column, name in enumerate(names)
    ]


def _header(mesh: Mesh, columns: Any, outlines: Outlines, encoding: str) -> str:
    lines = ["ply", f"format {encoding} 1.0", OWN_COMMENT.decode()]
    lines.append(f"element vertex {len(columns[0][2])}")
    lines += [f"property {_TYPES[code]} {name}" for name, code, _ in columns]
    if len(outlines.sizes):
        count_type = "uchar" if outlines.sizes.max() < 256 else "int"
        lines.append(f"element face {len(outlines.sizes)}")
        lines.append(f"property list {count_type} int vertex_indices")
    if len(mesh.lines):
        lines.append(f"element edge {len(mesh.lines)}")
        lines += ["property int vertex1", "property int vertex2"]
    return "\n".join([*lines, "end_header", ""])


def _write_binary(file: Any, columns: Any, outlines: Outlines, lines: np.ndarray) -> None:
    rows = np.empty(len(columns[0][2]), [(name, code) for name, code, _ in columns])
    for name, _, values in columns:
        rows[name] = values
    file.write(rows.tobytes())
    if len(outlines.sizes):
        file.write(_face_bytes(outlines))
    file.write(np.asarray(lines, "<i4").tobytes())


def _face_bytes(outlines: Outlines) -> bytes:
    """Return rows of a count and that many indices."""
    sizes = outlines.sizes.astype(np.int64)
    count_code = np.dtype("u1" if sizes.max() < 256 else "<i4")
    lengths = count_code.itemsize + 4 * sizes
    starts = np.cumsum(lengths) - lengths
    data = np.empty(int(lengths.sum()), np.uint8)
    _put(data, starts, sizes.astype(count_code))
    within = np.arange(len(outlines.corners)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    places = np.repeat(starts + count_code.itemsize, sizes) + 4 * within
    _put(data, places, outlines.corners.astype("<i4"))
    return data.tobytes()


def _put(data: np.ndarray, places: np.ndarray, numbers: np.ndarray) -> None:
    """Store numbers at byte offsets."""
    size = numbers.itemsize
    octets = np.ascontiguousarray(numbers).view(np.uint8).reshape(-1, size)
    for octet in range(size):
        data[places + octet] = octets[:, octet]


def _write_text(file: Any, columns: Any, outlines: Outlines, lines: np.ndarray) -> None:
    count = len(columns[0][2])
    for start in range(0, count, _BLOCK):
        words = [_words(code, values[start : start + _BLOCK]) for _, code, values in columns]
        rows = (b" ".join(row) + b"\n" for row in zip(*words, strict=True))
        file.write(b"".join(rows))
    ends = np.cumsum(outlines.sizes).tolist()
    corners = outlines.corners.astype("S11").tolist()
    begin = 0
    for end in ends:
        file.write(b"%d %s\n" % (end - begin, b" ".join(corners[begin:end])))
        begin = end
    file.write(b"".join(b"%d %d\n" % tuple(line) for line in lines.tolist()))


def _words(code: str, values: np.ndarray) -> list[bytes]:
    return float_words(values) if code == "<f4" else values.astype("S11").tolist()


WRITERS = (Writer("ply", "Stanford PLY", (".ply",), write_ply, ("ascii",)),)

"""Writer of PLY: vertices with attributes; polygons, lines and points; numbers by name.

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
from .ply_vertices import UV_NAMES
from .written_columns import Column, kinds_of, packed, written_values

_BLOCK = 1 << 15


def write_ply(mesh: Mesh, path: str, files: Files, ascii: bool = False) -> list[str]:
    """Write a PLY file; return a line for each loss."""
    has_elements = len(mesh.faces) or len(mesh.lines)
    # Vertices alone are points.
    points = None if has_elements or not len(mesh.points) else mesh.points
    columns = _columns(mesh, slice(None) if points is None else points)
    values = written_values(mesh, [column.name for column in columns], points)
    columns += values.vertices
    is_cut = mesh.edge_visible is not None
    kinds = kinds_of(values.faces, len(mesh.faces)) if is_cut else None
    outlines = polygon_outlines(mesh, kinds)
    own = [one._replace(values=one.values[outlines.first_faces]) for one in values.faces]
    header = _header(mesh, columns, outlines, own, "ascii" if ascii else "binary_little_endian")
    file = files.create(path)
    file.write(header.encode())
    (_write_text if ascii else _write_binary)(file, columns, outlines, own, mesh.lines)
    lost_points = ["points"] if has_elements else []
    lost = lost_parts(mesh, "ply", "uvs1", "tangents", "materials", *lost_points, "groups")
    lost += not_held("ply", values.lost)
    if outlines.lost_edges:
        lost += not_held("ply", [f"the hidden edges of {outlines.lost_edges} triangles"])
    return lost


def _columns(mesh: Mesh, chosen: Any) -> list[Column]:
    """Return the vertex properties besides the mesh's numbers."""
    groups: list[tuple[tuple[str, ...], str, np.ndarray]]
    groups = [(("x", "y", "z"), "<f4", mesh.positions)]
    if mesh.has_normals:
        groups.append((("nx", "ny", "nz"), "<f4", mesh.normals))
    if mesh.uvs is not None:
        free = (pair for pair in UV_NAMES if not mesh.values.keys() & pair)
        groups.append((next(free, UV_NAMES[0]), "<f4", mesh.uvs))
    if mesh.colors is not None:
        code = "u1" if mesh.colors.dtype == np.uint8 else "<f4"
        groups.append((("red", "green", "blue", "alpha"), code, mesh.colors))
    if mesh.position_ids is not None:
        groups.append((("position_id",), "<i4", mesh.position_ids[:, np.newaxis]))
    return [
        Column(name, code, values[chosen, column])
        for names, code, values in groups
        for column, name in enumerate(names)
    ]


def _header(
    mesh: Mesh, columns: list[Column], outlines: Outlines, own: list[Column], encoding: str
) -> str:
    lines = ["ply", f"format {encoding} 1.0", OWN_COMMENT.decode()]
    lines.append(f"element vertex {len(columns[0].values)}")
    lines += [column.line for column in columns]
    if len(outlines.sizes):
        count_type = "uchar" if outlines.sizes.max() < 256 else "int"
        lines.append(f"element face {len(outlines.sizes)}")
        lines.append(f"property list {count_type} int vertex_indices")
        lines += [column.line for column in own]
    if len(mesh.lines):
        lines.append(f"element edge {len(mesh.lines)}")
        lines += ["property int vertex1", "property int vertex2"]
    return "\n".join([*lines, "end_header", ""])


def _write_binary(
    file: Any, columns: list[Column], outlines: Outlines, own: list[Column], lines: np.ndarray
) -> None:
    file.write(packed(columns, len(columns[0].values)).tobytes())
    if len(outlines.sizes):
        file.write(_face_bytes(outlines, own))
    file.write(np.asarray(lines, "<i4").tobytes())


def _face_bytes(outlines: Outlines, own: list[Column]) -> bytes:
    """Return rows of a count, that many indices, and a face's own numbers."""
    sizes = outlines.sizes.astype(np.int64)
    count_code = np.dtype("u1" if sizes.max() < 256 else "<i4")
    rows = packed(own, len(sizes))
    lengths = count_code.itemsize + 4 * sizes + rows.itemsize
    starts = np.cumsum(lengths) - lengths
    data = np.empty(int(lengths.sum()), np.uint8)
    _put(data, starts, sizes.astype(count_code))
    within = np.arange(len(outlines.corners)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    places = np.repeat(starts + count_code.itemsize, sizes) + 4 * within
    _put(data, places, outlines.corners.astype("<i4"))
    if own:
        _put(data, starts + count_code.itemsize + 4 * sizes, rows)
    return data.tobytes()


def _put(data: np.ndarray, places: np.ndarray, numbers: np.ndarray) -> None:
    """Store numbers at byte offsets."""
    size = numbers.itemsize
    octets = np.ascontiguousarray(numbers).view(np.uint8).reshape(-1, size)
    for octet in range(size):
        data[places + octet] = octets[:, octet]


def _write_text(
    file: Any, columns: list[Column], outlines: Outlines, own: list[Column], lines: np.ndarray
) -> None:
    count = len(columns[0].values)
    for start in range(0, count, _BLOCK):
        words = [_words(column, start) for column in columns]
        rows = (b" ".join(row) + b"\n" for row in zip(*words, strict=True))
        file.write(b"".join(rows))
    ends = np.cumsum(outlines.sizes).tolist()
    corners = outlines.corners.astype("S11").tolist()
    begin = 0
    for start in range(0, len(ends), _BLOCK):
        words = [_words(column, start) for column in own]
        for number, end in enumerate(ends[start : start + _BLOCK]):
            rest = b" ".join(word[number] for word in words)
            row = b"%d %s %s" % (end - begin, b" ".join(corners[begin:end]), rest)
            file.write(row.rstrip() + b"\n")
            begin = end
    file.write(b"".join(b"%d %d\n" % tuple(line) for line in lines.tolist()))


def _words(column: Column, start: int) -> list[bytes]:
    """Return the text of some rows of a property."""
    values = column.values[start : start + _BLOCK]
    flat = values.reshape(-1)
    if column.code == "<f4":
        words = float_words(flat)
    elif column.code == "<f8":
        words = [repr(number).encode() for number in flat.tolist()]
    else:
        words = [b"%d" % number for number in flat.tolist()]
    if not column.is_list:
        return words
    width = values.shape[1]
    starts = range(0, len(words), width)
    return [b"%d %s" % (width, b" ".join(words[k : k + width])) for k in starts]


WRITERS = (Writer("ply", "Stanford PLY", (".ply",), write_ply, ("ascii",)),)

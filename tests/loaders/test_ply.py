"""PLY: encodings, properties, elements, and files that lie about what they hold."""

import struct
import time
import tracemalloc

import numpy as np
import pytest

from engine3d.errors import Engine3DWarning, FileFormatError
from engine3d.loaders import load_document, load_mesh

SQUARE = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]
XYZ = ["property float x", "property float y", "property float z"]
FACE = "property list uchar int vertex_indices"


def ply(*header, rows=(), encoding="ascii"):
    return "\n".join(["ply", f"format {encoding} 1.0", *header, "end_header", *rows, ""])


def square_ply(vertex=(), face=(FACE,), rows=SQUARE, faces=("4 0 1 2 3",)):
    header = [f"element vertex {len(rows)}", *XYZ, *vertex, f"element face {len(faces)}", *face]
    return ply(*header, rows=[*rows, *faces])


def binary(order, faces, count_type="uchar", index_type="int"):
    """A PLY of five vertices, its doubles and lists in one byte order."""
    name = {"<": "little", ">": "big"}[order]
    header = ["element vertex 5", "property double x", "property double y", "property double z"]
    header += [
        f"element face {len(faces)}",
        f"property list {count_type} {index_type} vertex_index",
    ]
    text = ply(*header, encoding=f"binary_{name}_endian").encode()
    points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 0]
    codes = {"uchar": "B", "ushort": "H", "uint": "I", "int": "i", "double": "d"}
    body = [struct.pack(f"{order}15d", *points)]
    for face in faces:
        codes_of_row = codes[count_type] + str(len(face)) + codes[index_type]
        body.append(struct.pack(order + codes_of_row, len(face), *face))
    return text + b"".join(body)


@pytest.fixture
def load(write):
    return lambda content: load_mesh(write("a.ply", content))


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize("count_type", ["uchar", "ushort", "uint", "int"])
@pytest.mark.parametrize("index_type", ["int", "uint", "ushort", "double"])
@pytest.mark.parametrize("faces", [[(0, 1, 2), (0, 2, 3)], [(0, 1, 4), (1, 2, 3, 4), (3, 0, 4)]])
def test_binary(load, order, count_type, index_type, faces):
    mesh = load(binary(order, faces, count_type, index_type))
    assert len(mesh.faces) == sum(len(face) - 2 for face in faces)
    assert mesh.positions[:4, :2].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert mesh.polygons.max() == len(faces) - 1
    assert (mesh.normals == [0, 0, 1]).all()


def test_quads_hide_their_diagonal(load):
    mesh = load(square_ply())
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.edge_visible.tolist() == [[True, True, False], [False, True, True]]


@pytest.mark.parametrize("names", ["s t", "u v", "texture_u texture_v"])
def test_texture_coordinates(load, names):
    rows = [f"{row} {row[:3]}" for row in SQUARE]
    mesh = load(square_ply([f"property float {name}" for name in names.split()], rows=rows))
    assert mesh.uvs.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]


def test_colors_are_display_values(load):
    names = ("red", "green", "blue", "alpha")
    rows = [f"{row} 255 128 0 7" for row in SQUARE]
    mesh = load(square_ply([f"property uchar {name}" for name in names], rows=rows))
    assert mesh.colors.dtype == np.uint8
    assert mesh.colors[0].tolist() == [255, 128, 0, 7]
    rows = [f"{row} 0.5 nan -1" for row in SQUARE]
    mesh = load(square_ply([f"property float {name}" for name in names[:3]], rows=rows))
    assert mesh.colors.dtype == np.float32
    assert mesh.colors[0].tolist() == pytest.approx([0.21404, 1, 0, 1], abs=1e-5)


def test_wide_colors_are_scaled(load):
    rows = [f"{row} 65535 257 0" for row in SQUARE]
    mesh = load(square_ply([f"property ushort {name}" for name in "rgb"], rows=rows))
    assert mesh.colors[0].tolist() == [255, 1, 0, 255]


def test_normals_without_direction_are_computed(load):
    rows = [f"{row} {'0 0 0' if row == SQUARE[2] else '0 1 0'}" for row in SQUARE]
    mesh = load(square_ply([f"property float n{axis}" for axis in "xyz"], rows=rows))
    assert mesh.normals.tolist() == [[0, 1, 0], [0, 1, 0], [0, 0, 1], [0, 1, 0]]


def test_corner_texture_coordinates_split_vertices(load):
    face = (FACE, "property list uchar float texcoord")
    rows = ["3 0 1 2 6 0 0 1 0 1 1", "3 0 2 3 6 .5 .5 1 1 0 1"]
    mesh = load(square_ply(face=face, faces=rows))
    assert len(mesh.positions) == 5
    assert mesh.uvs[mesh.faces].tolist() == [
        [[0, 0], [1, 0], [1, 1]],
        [[0.5, 0.5], [1, 1], [0, 1]],
    ]
    assert len(np.unique(mesh.position_ids)) == 4


def test_face_colors_split_vertices(load):
    face = (FACE, *(f"property uchar {name}" for name in ("red", "green", "blue")))
    mesh = load(square_ply(face=face, faces=["3 0 1 2 255 0 0", "3 0 2 3 0 0 255"]))
    assert mesh.colors[mesh.faces[0]].tolist() == [[255, 0, 0, 255]] * 3
    assert mesh.colors[mesh.faces[1]].tolist() == [[0, 0, 255, 255]] * 3


def test_images_and_their_numbers(load, write):
    for name, red in (("a.tga", 255), ("b.tga", 7)):
        head = struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, 1, 1, 24, 0)
        write(name, head + bytes([0, 0, red]))
    face = (FACE, "property list uchar float texcoord", "property int texnumber")
    text = square_ply(face=face, faces=["3 0 1 2 6 0 0 1 0 1 1 1", "3 0 2 3 6 0 0 1 1 0 1 0"])
    text = text.replace("1.0\n", "1.0\ncomment TextureFile a.tga\ncomment TextureFile b.tga\n")
    mesh = load(text)
    assert [m.texture.pixels[0, 0, 0] for m in mesh.materials] == [255, 7]
    assert mesh.material_ids.tolist() == [1, 0]


def test_an_image_outside_the_folder_is_refused(load):
    vertex = ("property float s", "property float t")
    text = square_ply(vertex, rows=[f"{row} 0 0" for row in SQUARE])
    with pytest.warns(UserWarning, match="refused"):
        mesh = load(text.replace("1.0\n", "1.0\ncomment TextureFile ../x.png\n", 1))
    assert mesh.materials[0].texture is None


def test_points_and_edges(load):
    mesh = load(ply("element vertex 3", *XYZ, rows=SQUARE[:3]))
    assert mesh.points.tolist() == [0, 1, 2]
    header = ["element vertex 4", *XYZ, "element edge 2", "property int vertex1"]
    mesh = load(ply(*header, "property int vertex2", rows=[*SQUARE, "0 2", "2 3"]))
    assert mesh.positions[mesh.lines].tolist() == [[[0, 0, 0], [1, 1, 0]], [[1, 1, 0], [0, 1, 0]]]
    assert len(mesh.points) == 0


def test_strips(load):
    header = ["element vertex 4", *XYZ, "element tristrips 1"]
    header += ["property list int int vertex_indices"]
    mesh = load(ply(*header, rows=[*SQUARE, "8 0 1 3 2 -1 0 1 2"]))
    assert mesh.faces.tolist() == [[0, 1, 3], [1, 2, 3], [0, 1, 2]]


@pytest.mark.parametrize("line_end", ["\r\n", "\r"])
def test_line_ends(load, write, line_end):
    assert len(load(square_ply().replace("\n", line_end)).faces) == 2
    header, _, body = binary("<", [(0, 1, 2)]).partition(b"end_header\n")
    header = header.replace(b"\n", line_end.encode())
    # The body begins with a byte that looks like a line feed.
    body = struct.pack("<d", 0).replace(b"\0", b"\n", 1) + body[8:]
    mesh = load(header + b"end_header" + line_end.encode() + body)
    assert mesh.faces.tolist() == [[0, 1, 2]]


def test_comments_and_words_for_infinity_in_the_body(load):
    rows = ["0 0 0", "comment here", "1 0 0", "", "obj_info x", "1.#INF -1.#IND 1e-5", "0 1 0"]
    mesh = load(ply("element vertex 4", *XYZ, rows=rows))
    assert np.isposinf(mesh.positions[2, 0])
    assert np.isnan(mesh.positions[2, 1])
    assert mesh.bounds[1].tolist() == [1, 1, 0]


def test_counts(write):
    document = load_document(write("a.ply", square_ply()))
    assert document.format == "ply"
    assert document.counts["faces"] == 1
    assert document.counts["triangles"] == 2
    assert document.counts["elements"] == ["vertex", "face"]


def test_header_lines_without_a_keyword_are_left_out(write):
    """Such as the name of the program that wrote the file."""
    text = square_ply().replace("element face", "Created by Blender3D 2.0\nelement face")
    path = write("a.ply", text)
    with pytest.warns(Engine3DWarning, match=r"a\.ply:7: not a header line, left out: 'Created by"):
        assert len(load_mesh(path).faces) == 2


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (square_ply(faces=["3 0 1 4"]), r"a\.ply:14: face 0: vertex index 4 is out of range"),
        (square_ply(faces=["3 0 1 2", "3 0 1 1.5"]), r"a\.ply:15: face 1: vertex index 1\.5"),
        (square_ply(faces=["3 0 1 2", "4 0 1 2"]), r"a\.ply:15: the file ends before the 2 rows"),
        (square_ply(faces=["3 0 1 2 3"]), r"a\.ply:14: 1 numbers more than the header announces"),
        (square_ply(faces=["-3 0 1 2"]), r"a\.ply:14: face 0: the length of a list"),
        (square_ply(faces=["1e300 0 1 2"]), r"a\.ply:14: the file ends"),
        (square_ply(faces=["nan 0 1 2"]), r"a\.ply:14: face 0: the length of a list"),
        (square_ply(rows=[*SQUARE[:3], "0 1 x"]), r"a\.ply:13: not a number: 'x'"),
        (square_ply(rows=[*SQUARE[:3], "0 1 1_0"]), r"a\.ply:13: not a number: '1_0'"),
        (ply("element vertex 99999999999999", *XYZ), "the file ends before the 99999999999999"),
        (ply("element nothing 99999999999999"), "no vertices"),
        (ply("element vertex 1", "property float x", rows=["1"]), "no x, y and z"),
        (ply("elephant vertex 1"), "no vertices"),
        ("ply\nelement vertex 0\nend_header\n", "no format line"),
        ("ply\nformat ascii 1.0\n", "no end_header"),
        ("ply\nformat binary 1.0\nend_header\n", r"a\.ply:2: unknown format 'binary'"),
    ],
)
def test_errors_name_file_and_place(load, content, message):
    with pytest.raises(FileFormatError, match=message):
        load(content)


@pytest.mark.parametrize("length", [2**31 - 1, 2**32 - 1])
def test_a_list_that_is_longer_than_the_file(load, length):
    data = binary("<", [(0, 1, 2), (0, 1, 2)], "uint")
    with pytest.raises(FileFormatError, match="the file ends before the 2 rows"):
        load(data[:-16] + struct.pack("<I", length) + data[-12:])


def test_mixed_polygons_are_fast(load):
    faces = [(0, 1, 2), (0, 1, 2, 3)] * 50_000
    data = binary("<", faces)
    start = time.process_time()
    assert len(load(data).faces) == 150_000
    assert time.process_time() - start < 5


def test_memory_for_polygons_is_bounded(write):
    """Indices of one byte: nothing else makes as much of a file."""
    count = 100_000
    polygon = bytes([5, *range(5)])
    header = b"ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\n"
    header += b"property float y\nproperty float z\nelement face %d\n" % count
    header += b"property list uchar uchar vertex_indices\nend_header\n"
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.9, 0.5, 0)], "<f4")
    path = write("a.ply", header + corners.tobytes() + polygon * (count - 1) + b"\3\0\1\2\0\0")
    load_mesh(path)
    tracemalloc.start()
    try:
        assert len(load_mesh(path).faces) == 3 * (count - 1) + 1
        assert tracemalloc.get_traced_memory()[1] < 40 * path.stat().st_size
    finally:
        tracemalloc.stop()

"""OFF: its prefixes, counts wherever they stand, colours, and damaged files."""

import pytest

from engine3d.errors import FileFormatError
from engine3d.loaders import load_document, load_mesh

ROWS = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]


def off(head="OFF\n4 1 0", rows=ROWS, faces=("4 0 1 2 3",)):
    return "\n".join([head, *rows, *faces, ""])


@pytest.fixture
def load(write):
    return lambda content: load_mesh(write("a.off", content))


@pytest.mark.parametrize(
    "head",
    ["OFF\n4 1 0", "OFF 4 1 0", "# by hand\nOFF # here\n\n4 1 4 # counts\n", "4 1 0", "OFF\n4 1"],
)
def test_counts_and_comments(load, head):
    mesh = load(off(head))
    assert len(mesh.positions) == 4
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.edge_visible.sum() == 4


def test_normals_colors_and_texture_coordinates(load):
    rows = [f"{row} 0 1 0 255 0 9 255 {row[:3]}" for row in ROWS]
    mesh = load(off("STCNOFF\n4 1 0", rows))
    assert mesh.normals[0].tolist() == [0, 1, 0]
    assert mesh.colors[0].tolist() == [255, 0, 9, 255]
    assert mesh.uvs.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.mark.parametrize("head", ["OFF\n4 1 0", "COFF\n4 1 0"])
@pytest.mark.parametrize("color", ["1 0.5 0", "1 0.5 0 1", "255 128 0"])
def test_vertex_colors(load, head, color):
    mesh = load(off(head, [f"{row} {color}" for row in ROWS]))
    assert mesh.colors[0].tolist() == [255, 128, 0, 255]


def test_face_colors_split_vertices(load):
    mesh = load(off("OFF 4 2 0", faces=["3 0 1 2 255 0 0", "3 0 2 3"]))
    assert len(mesh.positions) == 6
    assert mesh.colors[mesh.faces[0, 0]].tolist() == [255, 0, 0, 255]
    assert mesh.colors[mesh.faces[1, 0]].tolist() == [255, 255, 255, 255]


def test_vertices_alone_are_points(load, write):
    assert load(off("OFF 4 0 0", faces=())).points.tolist() == [0, 1, 2, 3]
    document = load_document(write("a.off", off()))
    assert (document.format, document.counts["faces"], document.counts["triangles"]) == (
        "off",
        1,
        2,
    )


def test_the_format_is_recognised_by_its_first_word(write):
    assert len(load_mesh(write("model", off())).faces) == 2


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "no counts"),
        ("OFF", "no counts"),
        (off("OFF\nfour 1 0"), r"a\.off:2: not counts of vertices and faces: 'four 1 0'"),
        (off("OFF\n99999999999999 1 0"), "the file ends before its 99999999999999 vertices do"),
        (off("OFF\n4 9999 0"), r"a\.off:7: the file ends before its 9999 faces do"),
        (off("OFF\n0 0 0"), "no vertices"),
        (off("nOFF\n4 1 0"), "three-dimensional"),
        (b"OFF BINARY\n\0\0\0\4", "binary OFF"),
        (off("\nOFF\n4 1 0", [*ROWS[:3], "0 x 0"]), r"a\.off:7: not a number: 'x'"),
        (off(rows=[*ROWS[:3], "0 1"]), r"a\.off:6: a vertex of 2 numbers, 3 are expected"),
        (off("NOFF\n4 1 0"), r"a\.off:3: a vertex of 3 numbers, 6 are expected"),
        (off(faces=["4 0 1 2 4"]), r"a\.off:7: vertex index out of range: '4 0 1 2 4'"),
        (off(faces=["3 0 1 nan"]), r"a\.off:7: vertex index out of range"),
        (off(faces=["4 0 1 2"]), r"a\.off:7: not a face: '4 0 1 2'"),
        (off(faces=["-1 0 1 2"]), r"a\.off:7: not a face"),
    ],
)
def test_errors_name_file_and_place(load, content, message):
    with pytest.raises(FileFormatError, match=message):
        load(content)

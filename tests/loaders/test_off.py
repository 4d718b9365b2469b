"""OFF: its prefixes, counts wherever they stand, colours, and damaged files."""

import itertools
import warnings

import pytest

from engine3d.errors import FileFormatError
from engine3d.loaders import load_document, load_mesh

ROWS = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]


def off(head="OFF\n4 1 0", rows=ROWS, faces=("4 0 1 2 3",)):
    return "\n".join([head, *rows, *faces, ""])


def quietly(data):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load_mesh(data, format="off")


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


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
FACES = [(0, 1, 2), (0, 2, 3)]
PREFIXES = [
    "".join(parts) for parts in itertools.product(*[("", p) for p in ("ST", "C", "N", "4", "n")])
]


def written(prefix, behind_keyword, between_counts, edges, line_end):
    """A square with all that the prefix announces, counts and lines as asked for."""
    rows = []
    for x, y, z in SQUARE:
        row = [2 * x, 2 * y, 2 * z, 2] if "4" in prefix else [x, y, z]
        row += [0, 0, 1] * ("N" in prefix) + [255, 0, 0, 255] * ("C" in prefix)
        rows.append(row + [x, y] * ("ST" in prefix))
    rows += [(3, *face) for face in FACES]
    head = f"{prefix}OFF"
    if prefix.endswith("n"):
        head, behind_keyword = f"{head}{behind_keyword}3", behind_keyword or " "
    counts = between_counts.join(["4", "2", *["0"] * edges])
    lines = [" ".join(map(str, row)) for row in rows]
    return f"{head}{behind_keyword}{counts}\n{line_end.join(lines)}\n".encode()


@pytest.mark.parametrize("prefix", PREFIXES)
@pytest.mark.parametrize("behind_keyword", ["", " ", "\n", "\t", "\r\n", "\n# why\n\n"])
def test_headers_in_whatever_lines(prefix, behind_keyword):
    for between, edges, end in itertools.product(" \n", (0, 1), ("\n", "\r\n", "\n\n", " ")):
        if end == " " and not edges:
            continue  # the first number would be that of edges
        mesh = load_mesh(written(prefix, behind_keyword, between, edges, end), format="off")
        assert mesh.positions.tolist() == [list(place) for place in SQUARE]
        assert mesh.faces.tolist() == [list(face) for face in FACES]
        assert (mesh.colors is not None) == ("C" in prefix)
        assert (mesh.uvs is not None) == ("ST" in prefix)


@pytest.mark.parametrize(
    ("colors", "expected"),
    [
        ("255 51 0 1", [255, 51, 0, 255]),
        ("255 51 0 0.2", [255, 51, 0, 51]),
        ("255 51 0 51", [255, 51, 0, 51]),
        ("1 0.2 0 0.2", [255, 51, 0, 51]),
        ("1 0.2 0 255", [255, 51, 0, 255]),
    ],
)
def test_alphas_have_a_range_of_their_own(colors, expected):
    rows = "".join(f"{x} {y} {z} {colors}\n" for x, y, z in SQUARE)
    mesh = load_mesh(f"COFF\n4 1 0\n{rows}3 0 1 2\n".encode())
    assert mesh.colors[0].tolist() == expected


def test_what_is_no_colour_of_a_face_is_told():
    rows = "".join(f"{x} {y} {z}\n" for x, y, z in SQUARE)
    mesh = quietly(f"OFF\n4 1 0\n{rows}3 0 1 2 7\n".encode())
    assert mesh.warnings[0].endswith("what stands behind the corners of 1 faces is left out")


def test_what_is_wrong_of_numbers_that_keep_to_no_lines():
    rows = " ".join(f"{x} {y} {z}" for x, y, z in SQUARE)
    with pytest.raises(FileFormatError, match="the file ends before its 4 vertices do"):
        load_mesh(f"OFF\n4 1 0\n{rows}\n3 0 1 9\n".encode(), format="off")


def test_four_dimensions_are_refused():
    with pytest.raises(FileFormatError, match="only three-dimensional OFF files"):
        load_mesh(b"nOFF 4\n1 0 0\n0 0 0 0\n")

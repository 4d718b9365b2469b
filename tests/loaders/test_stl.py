"""STL: both forms, told apart whatever they begin with; welding; damaged files."""

import math
import struct

import numpy as np
import pytest

from engine3d.errors import Engine3DWarning, FileFormatError
from engine3d.loaders import load_document, load_mesh

TRIANGLE = """  facet normal 0 0 1
    outer loop
      vertex 0 0 0
      vertex {x} 0 0
      vertex 0 1 0
    endloop
  endfacet
"""
TEXT = f"solid part\n{TRIANGLE.format(x=1)}endsolid part\n"
SQUARE = [[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]]


def binary(triangles, header=b"made by hand", count=None, attribute=0):
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *np.ravel(triangle), attribute) for triangle in triangles
    )
    count = len(triangles) if count is None else count
    return header.ljust(80, b" ") + struct.pack("<I", count) + body


@pytest.fixture
def load(write):
    return lambda content: load_mesh(write("a.stl", content))


def test_text(load):
    mesh = load(TEXT)
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert mesh.faces.tolist() == [[0, 1, 2]]
    assert mesh.groups["part"].tolist() == [0]


def test_text_in_other_letters_and_line_ends(load):
    mesh = load(TEXT.upper().replace("\n", "\r\n").replace("0 1 0", "+0.0E+00\t1.e0 -0 "))
    assert len(mesh.positions) == 3
    assert mesh.faces.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("header", [b"made by hand", b"solid trap", b"solid\nfacet normal 0 0 1"])
def test_binary_whatever_its_header_says(load, header):
    mesh = load(binary(SQUARE, header, attribute=31))
    assert len(mesh.positions) == 4
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert (mesh.normals == [0, 0, 1]).all()


def test_only_an_angle_of_zero_makes_facets_flat(load):
    mesh = load(TEXT)
    assert not mesh.materials[0].flat_shading
    assert mesh.crease_angle == math.radians(35)


def test_vertices_are_welded_by_their_exact_position(load):
    near = np.nextafter(np.float32(1), np.float32(2))
    triangles = [*SQUARE, [(near, 0, 0), (-0.0, 0, 0), (5, 5, 5)]]
    mesh = load(binary(triangles))
    assert len(mesh.positions) == 6
    assert mesh.faces[2].tolist() == [4, 0, 5]


def test_polygons_keep_their_diagonals_hidden(load):
    mesh = load(TEXT.replace("vertex 1 0 0\n", "vertex 1 0 0\nvertex 1 1 0\n"))
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.edge_visible.sum() == 4


def test_facets_of_fewer_corners_are_left_out_and_told_of(load):
    line = "      vertex 1 0 0\n"
    text = f"solid part\n{TRIANGLE.format(x=1)}{TRIANGLE.format(x=1).replace(line, '')}endsolid\n"
    with pytest.warns(Engine3DWarning, match="1 facets of fewer than three corners are left out"):
        assert len(load(text).faces) == 1


def test_solids_are_objects(write):
    path = write("a.stl", TEXT + TEXT.replace("part", "").replace("1 0 0", "2 0 0"))
    document = load_document(path)
    assert [entry.name for entry in document.objects] == ["part", "a"]
    assert [len(entry.mesh.positions) for entry in document.objects] == [3, 3]
    assert document.counts["triangles"] == 2
    assert list(load_mesh(path).groups) == ["part"]


def test_bytes_behind_the_last_triangle(load):
    with pytest.warns(UserWarning, match="7 bytes behind"):
        assert len(load(binary(SQUARE, b"solid x") + bytes(7)).faces) == 2


@pytest.mark.parametrize("start", [b"\xef\xbb\xbf", b"\xef\xbb\xbf\n ", b"\n\t"])
def test_text_may_begin_with_a_mark_and_blanks(load, start):
    mesh = load(start + TEXT.encode())
    assert (mesh.faces == load(TEXT).faces).all()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "too short"),
        (binary(SQUARE)[:-1], r"ends after 1 of 2 triangles \(at byte 183\)"),
        (binary(SQUARE, count=2**32 - 1), "ends after 2 of 4294967295"),
        (binary([]), "no triangles"),
        ("solid\nendsolid\n", "no triangles"),
        (
            TEXT.replace("vertex 1 0 0", "vertex 1 0 o"),
            r"a\.stl:5: not three numbers: 'vertex 1 0 o'",
        ),
        (TEXT.replace("vertex 1 0 0", "vertex 1 0"), r"a\.stl:5: not three numbers"),
        (TEXT.replace("vertex 1 0 0", "vertex"), r"a\.stl:5: not three numbers"),
        (TEXT.replace("vertex 1 0 0", "vertex 1 0 0 0"), r"a\.stl:5: not three numbers"),
        (TEXT.replace("0\n", "\n", 1).replace("vertex 1", "vertex 1 0"), "not three numbers"),
        (TEXT.replace("vertex 1", "vortex 1"), r"a\.stl:5: not a line of an STL file"),
        (TEXT[: TEXT.index("endloop")], r"a\.stl:7: the file ends within a facet"),
    ],
)
def test_errors_name_file_and_place(load, content, message):
    with pytest.raises(FileFormatError, match=message):
        load(content)


def test_more_facets_than_there_are_numbers(tmp_path):
    """A file with holes, which takes no room on the disk."""
    path, count = tmp_path / "a.stl", 1 << 31
    with path.open("wb") as file:
        file.write(bytes(80) + count.to_bytes(4, "little"))
        try:
            file.truncate(84 + 50 * count)
        except OSError as error:
            pytest.skip(f"no file of 100 GB fits here: {error}")
    with pytest.raises(FileFormatError, match=r"a\.stl: more rows than 32 bits number"):
        load_mesh(path)


FACETS = TRIANGLE.format(x=1) + TRIANGLE.format(x=2)
USUAL = f"solid part\n{FACETS}endsolid part\n"
SPELLINGS = {
    "end solid": lambda text: text.replace("endsolid", "end solid"),
    "end_solid": lambda text: text.replace("endsolid", "END_SOLID"),
    "endsolid of no name": lambda text: text.replace("endsolid part", "endsolid"),
    "endsolid of a joined name": lambda text: text.replace("endsolid part", "endsolidpart"),
    "endsolid;": lambda text: text.replace("endsolid part", "endsolid;"),
    "end": lambda text: text.replace("endsolid part", "end"),
    "no endsolid": lambda text: text.replace("endsolid part\n", ""),
    "end facet": lambda text: text.replace("endfacet", "end facet"),
    "no endfacet": lambda text: text.replace("endfacet\n", "\n"),
    "end loop": lambda text: text.replace("endloop", "end  loop"),
    "no endloop": lambda text: text.replace("endloop\n", "\n"),
    "outerloop": lambda text: text.replace("outer loop", "outerloop"),
    "facetnormal": lambda text: text.replace("facet normal", "FacetNormal"),
    "vertex1": lambda text: text.replace("vertex ", "vertex"),
    "solid1": lambda text: text.replace("solid part", "solid1", 1),
    "no solid": lambda text: text.replace("solid part\n", "", 1),
    "one line": lambda text: text.replace("\n", " "),
    "a facet in a line": lambda text: text.replace("\n  ", " ").replace(" facet", "\nfacet"),
    "some facets in a line": lambda text: text.replace("\n  ", " ", 5),
    "a comment": lambda text: text.replace("outer", "# of no use\nouter", 1),
    "a colour": lambda text: text.replace("outer", "color 0.5 0.5 1\nouter"),
    "padding": lambda text: text + "\0\0\0",
    "ctrl-Z": lambda text: text + "\x1a",
    "as usual": lambda text: text,
}


@pytest.mark.parametrize("change", SPELLINGS.values(), ids=SPELLINGS.keys())
@pytest.mark.parametrize("letters", [str, str.upper])
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
@pytest.mark.filterwarnings("ignore:.*lines that are no part of STL")
def test_text_in_other_spellings(load, change, letters, line_end):
    mesh = load(letters(change(USUAL)).replace("\n", line_end))
    np.testing.assert_array_equal(mesh.positions, load(USUAL).positions)
    np.testing.assert_array_equal(mesh.faces, load(USUAL).faces)


def test_names_that_hold_keywords(load):
    text = USUAL.replace("part", "vertex 1 facet normal 0 outer loop")
    assert list(load(text).groups) == ["vertex 1 facet normal 0 outer loop"]

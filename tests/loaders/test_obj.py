"""OBJ, feature by feature."""

import numpy as np
import pytest

from engine3d.errors import Engine3DWarning, FileAccessError, FileFormatError
from engine3d.loaders import load_mesh

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def corner_positions(mesh):
    return mesh.positions[mesh.faces].tolist()


def test_triangle(obj_mesh):
    mesh = obj_mesh(TRIANGLE + "f 1 2 3\n")
    assert corner_positions(mesh) == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    assert mesh.edge_visible is None
    assert mesh.uvs is None
    assert mesh.colors is None
    assert not mesh.has_normals
    assert mesh.name == "model"
    assert mesh.warnings == []


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_line_ends_and_byte_order_mark(obj_mesh, end, mark):
    text = "# box\nv 0 0 0\n\nv 1 0 0\nv 0 1 0\nf 1 2 3"
    mesh = obj_mesh(mark + text.replace("\n", end).encode())
    assert len(mesh.faces) == 1


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_utf16_is_decoded_if_it_says_so(obj_mesh, encoding):
    data = (TRIANGLE + "f 1 2 3\n").encode(encoding)
    if encoding == "utf-16":
        assert len(obj_mesh(data).faces) == 1
    else:
        with pytest.raises(FileFormatError, match="not a text file"):
            obj_mesh(data)


def test_blanks_tabs_and_leading_blanks(obj_mesh):
    mesh = obj_mesh("  v\t0  0 0 \n\tv 1 0 0\nv 0 1 0\n   f   1\t2  3  \n")
    assert len(mesh.faces) == 1


def test_comments_anywhere(obj_mesh):
    mesh = obj_mesh("#v 9 9 9\nv 0 0 0 # origin\nv 1 0 0#x\nv 0 1 0\nf 1 2 3 # f 1 2 4\n  # end\n")
    assert len(mesh.positions) == 3


def test_a_comment_that_ends_in_a_backslash_swallows_nothing(obj_mesh):
    assert len(obj_mesh("# C:\\models\\\n" + TRIANGLE + "f 1 2 3\n").faces) == 1


def test_continued_lines(obj_mesh):
    mesh = obj_mesh(SQUARE + "f 1 2 \\\n3 \\\r\n 4\n")
    assert len(mesh.faces) == 2


def test_line_numbers_count_continued_lines(obj_mesh):
    with pytest.raises(FileFormatError, match=r"model\.obj:7: vertex index out of range"):
        obj_mesh(TRIANGLE + "f 1 \\\n 2 \\\n 3\nf 1 2 4\n")


def test_negative_indices_count_back_from_where_they_stand(obj_mesh):
    mesh = obj_mesh(TRIANGLE + "f -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n")
    assert corner_positions(mesh)[1] == [[5, 0, 0], [6, 0, 0], [5, 1, 0]]


def test_vertices_may_follow_their_faces(obj_mesh):
    assert len(obj_mesh("f 1 2 3\n" + TRIANGLE).faces) == 1


@pytest.mark.parametrize(
    ("face", "message"),
    [
        ("f 1 2 4", "out of range, there are 3: '4'"),
        ("f 1 2 0", "out of range"),
        ("f -4 2 3", "out of range"),
        ("f 1 2 99999999999999999999999", "out of range"),
        ("f 1 2 4294967297", "out of range"),
        ("f 1 2 x", "not a vertex index: 'x'"),
        ("f 1 2 1.5", "not a vertex index"),
        ("f 1 2 --1", "not a vertex index"),
        ("f 1 2 -", "not a vertex index"),
        ("f 1/1/1/1 2 3", "at most three"),
        ("f /1 2 3", "without a vertex index"),
    ],
)
def test_bad_indices_name_file_and_line(obj_mesh, face, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        obj_mesh(TRIANGLE + face + "\n")
    assert str(caught.value).startswith(caught.value.path + ":4: ")
    assert caught.value.line == 4


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("v 1 2", "vertex with 2 numbers"),
        ("v 1 2 x", "not a number: 'x'"),
        ("v 1,0 2 3", "not a number: '1,0'"),
        ("vn 1", "normal with 1 numbers"),
        ("vt", "texture coordinate with 0"),
    ],
)
def test_bad_numbers_name_file_and_line(obj_mesh, line, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        obj_mesh(TRIANGLE + line + "\n")
    assert caught.value.line == 4


def test_numbers_as_they_are_written(obj_mesh):
    mesh = obj_mesh("v +1.5e0 .5 -1.\nv 1E2 -0 1e-400\nv 1e400 nan -1.#IND\n")
    assert mesh.positions[0].tolist() == [1.5, 0.5, -1]
    assert mesh.positions[1].tolist() == [100, 0, 0]
    assert np.isinf(mesh.positions[2, 0])
    assert np.isnan(mesh.positions[2, 1:]).all()


def test_quads_and_hidden_diagonals(obj_mesh):
    mesh = obj_mesh(SQUARE + "f 1 2 3 4\n")
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.edge_visible.tolist() == [[True, True, False], [False, True, True]]
    assert mesh.edges().tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert mesh.polygons.tolist() == [0, 0]


def test_a_concave_quad_is_cut_from_its_reflex_corner(obj_mesh):
    mesh = obj_mesh("v 0 0 0\nv 2 0 0\nv .4 .4 0\nv 0 2 0\nf 1 2 3 4\nf 4 1 2 3\n")
    assert (mesh.face_normals[:, 2] == 1).all()
    assert [sorted(face) for face in mesh.faces.tolist()].count([0, 1, 2]) == 2


def test_triangles_keep_their_order(obj_mesh):
    mesh = obj_mesh(SQUARE + "f 1 2 3\nf 1 2 3 4\nf 2 3 4\nf 4 3 2 1\n")
    assert mesh.faces.tolist()[:4] == [[0, 1, 2], [0, 1, 2], [0, 2, 3], [1, 2, 3]]
    assert len(mesh.faces) == 6


def test_corners_are_welded_and_split(obj_mesh):
    text = SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\n"
    mesh = obj_mesh(text + "f 1/1 2/2 3/3\nf 1/1 3/5 4/4\n")
    assert len(mesh.positions) == 5
    assert mesh.uvs[mesh.faces[1]].tolist() == [[0, 0], [0.5, 0.5], [0, 1]]
    assert mesh.position_ids.tolist() == [0, 1, 2, 2, 3]
    assert mesh.edges().tolist()[:3] == [[0, 1], [1, 2], [2, 0]]
    assert len(mesh.edges()) == 5
    assert (mesh.normals == [0, 0, 1]).all()


def test_unused_positions_are_left_out(obj_mesh):
    mesh = obj_mesh("v 9 9 9\n" + TRIANGLE + "v 8 8 8\nf 2 3 4\n")
    assert len(mesh.positions) == 3
    assert mesh.bounds[1].tolist() == [1, 1, 0]


@pytest.mark.parametrize("corner", ["1/1/1", "1//1", "1/1", "1", "1/1/", "1/", "1//"])
def test_corner_forms(obj_mesh, corner):
    mesh = obj_mesh(TRIANGLE + "vt .5 .5\nvn 0 0 1\n" + f"f {corner} 2 3\n")
    assert len(mesh.faces) == 1
    assert (mesh.uvs is not None) == corner.startswith("1/1")


def test_missing_uvs_are_zero_and_missing_normals_computed(obj_mesh):
    text = TRIANGLE + "vt .5 .5\nvn 1 0 0\nf 1/1/1 2 3\n"
    mesh = obj_mesh(text)
    first, second, _ = mesh.faces[0]
    assert mesh.uvs[first].tolist() == [0.5, 0.5]
    assert mesh.uvs[second].tolist() == [0, 0]
    assert mesh.normals[first].tolist() == [1, 0, 0]
    assert mesh.normals[second].tolist() == [0, 0, 1]


@pytest.mark.parametrize("normal", ["0 0 0", "nan 0 1", "1e999 0 0", "1e300 0 0", "1e-40 0 0"])
def test_normals_without_a_direction_count_as_missing(obj_mesh, normal):
    mesh = obj_mesh(TRIANGLE + f"vn {normal}\nvn 1 0 0\nf 1//1 2//2 3//1\n")
    assert sorted(mesh.normals.tolist()) == [[0, 0, 1], [0, 0, 1], [1, 0, 0]]


def test_texture_coordinates_that_are_not_finite_are_zero(obj_mesh):
    mesh = obj_mesh(TRIANGLE + "vt nan 1\nvt 1e300 0\nvt 1 1\nf 1/1 2/2 3/3\n")
    assert mesh.uvs.tolist() == [[0, 1], [0, 0], [1, 1]]


def test_uv_and_normal_indices_out_of_range_are_warned_of(write):
    path = write("model.obj", TRIANGLE + "vt 0 0\nf 1/1 2/2 3/9\n")
    with pytest.warns(Engine3DWarning, match=r"model\.obj:5: texture coordinate index"):
        mesh = load_mesh(path)
    assert len(mesh.faces) == 1
    assert "2 corners" in mesh.warnings[0]


def test_points_and_polylines(obj_mesh, obj_document):
    text = SQUARE + "v 5 5 5\nl 1 2 3\nl 3/1 4\np 5 1\nf 1 2 3\n"
    mesh = obj_mesh(text)
    assert mesh.positions[mesh.lines].tolist() == [
        [[0, 0, 0], [1, 0, 0]],
        [[1, 0, 0], [1, 1, 0]],
        [[1, 1, 0], [0, 1, 0]],
    ]
    assert mesh.positions[mesh.points].tolist() == [[5, 5, 5], [0, 0, 0]]
    counts = obj_document(text).counts
    assert (counts["lines"], counts["points"]) == (2, 2)


def test_vertices_alone_are_a_point_cloud(obj_mesh):
    mesh = obj_mesh(TRIANGLE)
    assert mesh.points.tolist() == [0, 1, 2]


def test_faces_of_two_corners_are_left_out(obj_mesh):
    mesh = obj_mesh(TRIANGLE + "f 1 2\nf 1\nf\nf 1 2 3\n")
    assert len(mesh.faces) == 1
    assert "3 faces of fewer than three corners" in mesh.warnings[0]


def test_vertex_colors_are_srgb_bytes(obj_mesh):
    mesh = obj_mesh("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n")
    assert mesh.colors.dtype == np.uint8
    assert mesh.colors.tolist() == [[255, 128, 0, 255], [255] * 4, [0, 0, 255, 255]]


def test_vertex_colors_of_0_to_255(obj_mesh):
    mesh = obj_mesh("v 0 0 0 255 128 0\nv 1 0 0 1 1 1\nv 0 1 0 nan 0 0\nf 1 2 3\n")
    assert mesh.colors.tolist() == [[255, 128, 0, 255], [1, 1, 1, 255], [255] * 4]


def test_a_fourth_coordinate_is_no_color(obj_mesh):
    mesh = obj_mesh("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n")
    assert mesh.colors is None


def test_without_smoothing_statements_all_is_smooth(obj_mesh):
    mesh = obj_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n")
    assert not mesh.has_normals
    assert len(mesh.positions) == 4


def patches(height):
    """Two quads side by side that share no vertex; the second goes up to ``height``."""
    left = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    right = f"v 1 -0 0\nv 2 0 {height}\nv 2 1 {height}\nv 1 1 0\n"
    return left + right + "f 1 2 3 4\nf 5 6 7 8\n"


def test_patches_that_meet_smoothly_show_no_seam(obj_mesh):
    mesh = obj_mesh(patches(0.2))
    assert not mesh.has_normals
    assert len(mesh.positions) == 8
    assert np.array_equal(mesh.normals[1], mesh.normals[4])
    assert len(mesh.edges()) == 7


def test_patches_that_meet_at_an_angle_keep_their_edge(obj_mesh):
    mesh = obj_mesh(patches(5))
    assert mesh.normals[1].tolist() == [0, 0, 1]
    assert mesh.normals[4, 0] < -0.9


@pytest.mark.parametrize("off", ["off", "0"])
def test_smoothing_off_is_flat(obj_mesh, off):
    mesh = obj_mesh(f"s {off}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n")
    assert mesh.has_normals
    assert len(mesh.positions) == 6
    assert np.array_equal(mesh.normals[mesh.faces[:, 0]], mesh.face_normals)
    assert len(mesh.edges()) == 5


def test_a_flat_quad_has_one_normal(obj_mesh):
    mesh = obj_mesh("s off\nv 0 0 0\nv 1 0 0\nv 1 1 .3\nv 0 1 0\nf 1 2 3 4\n")
    assert len(mesh.positions) == 4
    assert len(np.unique(mesh.normals, axis=0)) == 1


def test_smoothing_groups_part_the_normals(obj_mesh):
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\n"
    mesh = obj_mesh(text + "s 1\nf 1 2 3\ns 2\nf 1 4 2\ns 1\nf 2 1 5\n")
    first, second, third = mesh.normals[mesh.faces]
    assert (first == [0, 0, 1]).all()
    assert (second == [0, 1, 0]).all()
    assert (third == [0, 0, -1]).all() or (third == [0, 0, 1]).all()


def test_groups_name_triangles(obj_mesh):
    mesh = obj_mesh(SQUARE + "f 1 2 3\ng a b\nf 1 2 3 4\ng a\nf 2 3 4\ng empty\n")
    assert {name: faces.tolist() for name, faces in mesh.groups.items()} == {
        "a": [1, 2, 3],
        "b": [1, 2],
    }


def test_objects_become_meshes_of_their_own(obj_document, obj_mesh):
    text = SQUARE + "f 1 2 3\no left side\nf 1 3 4\nl 1 2\no left side\nf 2 3 4\no none\n"
    document = obj_document(text)
    assert [(name, len(mesh.faces)) for name, mesh, _ in document.objects] == [
        ("model", 1),
        ("left side", 1),
        ("left side", 1),
    ]
    assert [len(mesh.lines) for _, mesh, _ in document.objects] == [0, 1, 0]
    assert len(document.objects[0].mesh.positions) == 3
    assert len(obj_mesh(text).faces) == 3
    assert document.counts["objects"] == ["left side", "none"]


def test_unknown_statements_are_warned_of_once(obj_mesh):
    mesh = obj_mesh(TRIANGLE + "cstype bezier\ncurv 1 2\ncurv 2 3\ncall rm.obj\nf 1 2 3\n")
    assert [w.split(": ", 1)[1] for w in mesh.warnings] == [
        "'cstype' is not understood; 1 statements left out",
        "'curv' is not understood; 2 statements left out",
        "'call' is not understood; 1 statements left out",
    ]


def test_a_flood_of_warnings_is_cut_off(obj_mesh):
    mesh = obj_mesh(TRIANGLE + "".join(f"word{k} x\n" for k in range(1000)))
    assert len(mesh.warnings) < 50
    assert "970 more warnings" in mesh.warnings[-1]


@pytest.mark.parametrize("content", [b"", b"# nothing\n", b"f 1 2 3\n", b"hello"])
def test_a_file_without_geometry_is_an_error(obj_mesh, content):
    with pytest.raises(FileFormatError, match=r"model\.obj"):
        obj_mesh(content)


def test_binary_content_is_an_error(obj_mesh):
    with pytest.raises(FileFormatError, match="not a text file"):
        obj_mesh(b"\x80\x00\x01\x02")


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileAccessError, match="No such file"):
        load_mesh(tmp_path / "none.obj")
    with pytest.raises(FileAccessError, match="not a regular file|Is a directory"):
        load_mesh(tmp_path)
    with pytest.raises(OSError, match="null"):
        load_mesh("/dev/null")
    with pytest.raises(FileAccessError):
        load_mesh("a\0b.obj")


def test_meshes_larger_than_any_index_type_of_16_bits(obj_mesh):
    count = 70_000
    text = "".join(f"v {k} 0 0\n" for k in range(count)) + f"f 1 2 {count}\nf {count} 3 1\n"
    mesh = obj_mesh(text)
    assert mesh.positions[mesh.faces[0, 2], 0] == count - 1

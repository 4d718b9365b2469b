"""Meshes: checks of every array, derived arrays, versions, joining."""

import sys

import numpy as np
import pytest

from engine3d import PerspectiveCamera, Scene, linalg, linear, look_at, render, uv_sphere
from engine3d.errors import InvalidArgumentError
from engine3d.extras.lod import simplify
from engine3d.model.geometry.mesh import Mesh
from engine3d.model.materials.material import Material
from engine3d.rendering.draw_list.native_handles import MeshNeeds, native_mesh

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
HALVES = [(0, 1, 2), (0, 2, 3)]
DIAGONAL_HIDDEN = [(True, True, False), (False, True, True)]


def square(**options) -> Mesh:
    return Mesh(SQUARE, HALVES, **options)


def test_arrays_have_fixed_types_and_are_read_only():
    mesh = square(uvs=np.zeros((4, 2)), edge_visible=DIAGONAL_HIDDEN, lines=[(0, 1)], points=[3])
    expected = {
        "positions": np.float32,
        "faces": np.int32,
        "normals": np.float32,
        "uvs": np.float32,
        "material_ids": np.int32,
        "lines": np.int32,
        "points": np.int32,
        "edge_visible": np.bool_,
    }
    for name, dtype in expected.items():
        array = getattr(mesh, name)
        assert array.dtype == dtype, name
        assert array.flags.c_contiguous
        assert not array.flags.writeable


def test_a_mesh_does_not_share_writable_memory():
    positions = np.array(SQUARE, np.float32)
    mesh = Mesh(positions, HALVES)
    positions[:] = 9
    assert mesh.positions.max() == 1


def test_an_empty_mesh_is_allowed():
    mesh = Mesh([])
    assert mesh.positions.shape == (0, 3)
    assert mesh.faces.shape == (0, 3)
    assert mesh.normals.shape == (0, 3)
    assert mesh.edges().shape == (0, 2)
    assert mesh.polygons.shape == (0,)
    assert mesh.bounds.tolist() == [[0, 0, 0], [0, 0, 0]]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"faces": [(0, 1, 4)]}, "index 4, but there are 4 vertices"),
        ({"faces": [(0, 1, -1)]}, "index -1"),
        ({"faces": [(0, 1)]}, "shape"),
        ({"faces": [(0.0, 1.0, 2.0)]}, "integers"),
        ({"faces": [(0, 1, 2**40)]}, "1099511627776"),
        ({"lines": [(0, 4)]}, "lines"),
        ({"points": [4]}, "points"),
        ({"uvs": [(0, 0)]}, "uvs has 1 rows for 4 vertices"),
        ({"normals": np.zeros((3, 3))}, "normals"),
        ({"colors": np.zeros((4, 2), np.uint8)}, "colors"),
        ({"colors": np.full((4, 3), 256)}, "0..255, but one is 256"),
        ({"faces": HALVES, "material_ids": [0, 1]}, "material_ids"),
        ({"faces": HALVES, "edge_visible": [(True, True, True)]}, "edge_visible"),
        ({"materials": ["red"]}, "Material"),
    ],
)
def test_wrong_arguments_are_refused(arguments, message):
    with pytest.raises(InvalidArgumentError, match=message):
        Mesh(SQUARE, **arguments)


def test_positions_must_be_an_array_of_points():
    for value in ([(0, 0)], "abc", [(0, 0, 0), (1, 1)], None):
        with pytest.raises(InvalidArgumentError):
            Mesh(value)


def test_colors_of_three_components_get_alpha():
    mesh = square(colors=np.full((4, 3), 7, np.uint8))
    assert mesh.colors[0].tolist() == [7, 7, 7, 255]
    mesh = square(colors=linear(np.full((4, 3), 0.5)))
    assert mesh.colors.dtype == np.float32
    assert mesh.colors[0].tolist() == [0.5, 0.5, 0.5, 1]


def test_assigning_replaces_derives_anew_and_raises_the_version():
    mesh = square()
    assert mesh.bounds.tolist() == [[0, 0, 0], [1, 1, 0]]
    before = mesh.version
    mesh.positions = np.array(SQUARE) * 2
    assert mesh.version > before
    assert mesh.bounds[1].tolist() == [2, 2, 0]


def test_assigning_checks_against_what_is_there():
    mesh = square(uvs=np.zeros((4, 2)))
    with pytest.raises(InvalidArgumentError, match="uvs"):
        mesh.positions = np.zeros((5, 3))
    with pytest.raises(InvalidArgumentError):
        mesh.faces = [(0, 1, 4)]
    mesh = square()
    with pytest.raises(InvalidArgumentError, match="faces"):
        mesh.positions = np.zeros((3, 3))
    assert len(mesh.positions) == 4


@pytest.mark.parametrize("materials", [Material(), [None], ["red"]])
def test_materials_are_a_list_of_them(materials):
    with pytest.raises(InvalidArgumentError, match="Material"):
        square(materials=materials)


def test_material_ids_start_again_when_the_number_of_faces_changes():
    mesh = square(materials=[Material(), Material()], material_ids=[0, 1])
    mesh.faces = [(0, 1, 2)]
    assert mesh.material_ids.tolist() == [0]
    with pytest.raises(InvalidArgumentError):
        mesh.material_ids = [2]
    mesh.material_ids = [1]
    with pytest.raises(InvalidArgumentError, match="material"):
        mesh.materials = [Material()]


def test_bounds_leave_out_what_is_not_finite():
    mesh = Mesh([(0, 0, 0), (np.nan, 5, 5), (1, 2, np.inf), (1, 1, 1)])
    assert mesh.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]


def test_given_normals_are_kept():
    mesh = square(normals=[(1, 0, 0)] * 4)
    assert mesh.has_normals
    assert mesh.normals[0].tolist() == [1, 0, 0]
    mesh.normals = None
    assert not mesh.has_normals
    assert mesh.normals[0].tolist() == [0, 0, 1]


def test_each_edge_appears_once_in_order():
    assert square().edges().tolist() == [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]


def test_hidden_edges_are_left_out():
    mesh = square(edge_visible=DIAGONAL_HIDDEN)
    assert mesh.edges().tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]


def test_an_edge_visible_in_one_face_is_visible():
    mesh = square(edge_visible=[(True, True, False), (True, True, True)])
    assert [0, 2] in mesh.edges().tolist()


def test_edges_across_a_seam_are_one():
    positions = [*SQUARE, SQUARE[0], SQUARE[2]]
    mesh = Mesh(positions, [(0, 1, 2), (4, 5, 3)], position_ids=[0, 1, 2, 3, 0, 2])
    assert mesh.edges().tolist() == [[0, 1], [1, 2], [2, 0], [5, 3], [3, 4]]


def test_degenerate_edges_are_left_out():
    assert Mesh(SQUARE, [(0, 0, 1)]).edges().tolist() == [[0, 1]]


def test_triangles_joined_by_hidden_edges_are_one_polygon():
    assert square().polygons.tolist() == [0, 1]
    assert square(edge_visible=DIAGONAL_HIDDEN).polygons.tolist() == [0, 0]


def test_a_diagonal_hidden_on_one_side_joins_nothing():
    mesh = square(edge_visible=[(True, True, False), (True, True, True)])
    assert mesh.polygons.tolist() == [0, 1]


def test_polygons_need_not_be_fans():
    # An ear-clipped pentagon whose third triangle joins the two before it.
    faces = [(0, 1, 2), (2, 3, 4), (0, 2, 4), (5, 6, 7)]
    visible = [(1, 1, 0), (1, 1, 0), (0, 0, 1), (1, 1, 1)]
    mesh = Mesh(np.random.default_rng(1).random((8, 3)), faces, edge_visible=np.array(visible) > 0)
    assert mesh.polygons.tolist() == [0, 0, 0, 1]


def test_faces_that_stand_apart_are_no_polygon():
    faces = [(0, 1, 2), (4, 5, 6), (0, 2, 3)]
    visible = [(1, 1, 0), (1, 1, 1), (0, 1, 1)]
    mesh = Mesh(np.zeros((7, 3)), faces, edge_visible=np.array(visible) > 0)
    assert mesh.polygons.tolist() == [0, 1, 2]


def test_concatenation_moves_indices_and_fills_in():
    red, blue = Material(name="red"), Material(name="blue")
    first = square(materials=[red], uvs=np.ones((4, 2)), edge_visible=DIAGONAL_HIDDEN, points=[0])
    first.groups["all"] = np.array([0, 1], np.int32)
    second = Mesh(
        np.array(SQUARE) + 1,
        HALVES,
        materials=[blue, red],
        material_ids=[0, 1],
        lines=[(0, 3)],
        colors=np.zeros((4, 4), np.uint8),
        position_ids=[0, 1, 2, 0],
    )
    second.groups["all"] = np.array([1], np.int32)
    mesh = Mesh.concatenate([first, second], name="both")
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]
    assert mesh.materials == [red, blue]
    assert mesh.material_ids.tolist() == [0, 0, 1, 0]
    assert mesh.lines.tolist() == [[4, 7]]
    assert mesh.points.tolist() == [0]
    assert mesh.uvs[0].tolist() == [1, 1]
    assert mesh.uvs[4].tolist() == [0, 0]
    assert mesh.colors[0].tolist() == [255] * 4
    assert mesh.edge_visible[2].tolist() == [True] * 3
    assert mesh.position_ids.tolist() == [0, 1, 2, 3, 4, 5, 6, 4]
    assert mesh.groups["all"].tolist() == [0, 1, 3]
    assert mesh.name == "both"


def test_concatenating_bytes_and_floats_gives_linear_light():
    first = square(colors=np.full((4, 4), 255, np.uint8))
    second = square(colors=linear(np.full((4, 3), 0.5, np.float32)))
    colors = Mesh.concatenate([first, second]).colors
    assert colors.dtype == np.float32
    assert colors[[0, 4]].tolist() == [[1, 1, 1, 1], [0.5, 0.5, 0.5, 1]]


def test_concatenating_nothing_gives_an_empty_mesh():
    assert len(Mesh.concatenate([]).positions) == 0


def test_only_other_arrays_make_the_core_cut_a_mesh_again():
    mesh = Mesh(np.eye(3), [(0, 1, 2)])
    made = native_mesh(mesh, MeshNeeds(), 1)
    mesh.materials = [Material(color=(1, 0, 0))]
    assert native_mesh(mesh, MeshNeeds(), 1) is made
    for name, value in (
        ("positions", 2 * np.eye(3)),
        ("faces", [(0, 2, 1)]),
        ("normals", np.eye(3)),
    ):
        setattr(mesh, name, value)
        renewed = native_mesh(mesh, MeshNeeds(), 1)
        assert renewed is not made
        made = renewed


def test_only_meshes_are_joined():
    with pytest.raises(InvalidArgumentError, match="meshes must be several Mesh, not Mesh"):
        Mesh.concatenate(Mesh(np.eye(3)))
    with pytest.raises(InvalidArgumentError, match="meshes must be Mesh, not int"):
        Mesh.concatenate([square(), 5])
    assert len(Mesh.concatenate(square() for _ in range(3)).faces) == 6


@pytest.mark.parametrize(
    ("package", "extra", "use"),
    [
        ("trimesh", "formats", lambda mesh: mesh.to_trimesh()),
        ("fast_simplification", "detail", lambda mesh: simplify(mesh, 0.5)),
    ],
    ids=["to_trimesh", "simplify"],
)
def test_an_optional_package_that_is_missing_is_named(monkeypatch, package, extra, use):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=rf"engine3d\[{extra}\]"):
        use(square())


def test_groups_are_names_and_indices_of_faces():
    mesh = square()
    mesh.groups = {"half": [1], "none": ()}
    assert mesh.groups["half"].tolist() == [1] and mesh.groups["half"].dtype == np.int32
    wrong = [5, [], {"half": [2]}, {"half": [-1]}, {"half": [0.5]}, {"half": "a"}, {3: [0]}]
    for groups in wrong:
        with pytest.raises(InvalidArgumentError, match="group"):
            mesh.groups = groups
    assert list(mesh.groups) == ["half", "none"]
    mesh.faces = mesh.faces[:, [1, 2, 0]]
    assert list(mesh.groups) == ["half", "none"]
    mesh.faces = mesh.faces[:1]
    assert mesh.groups == {}


def directed_volume(mesh):
    """Six times the volume, positive where the fronts of the faces are outside."""
    a, b, c = mesh.positions[mesh.faces].astype(np.float64).transpose(1, 0, 2)
    return float((a * np.cross(b, c)).sum())


def test_meshes_are_joined_at_their_poses():
    ball = uv_sphere(1.0, (8, 5))
    ball.groups = {"half": np.arange(20)}
    triangle = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])  # without normals
    turn = linalg.rotation_axis((1, 2, 3), 0.7)
    squeezed = linalg.multiply(turn, linalg.scaling((1, 2, 0.5)))
    mirror = np.diag([-1.0, 1, 1, 1])
    parts = ((5, 0, 0), (0, 0, 1, 1), 2.0)
    meshes, poses = [ball, ball, ball, triangle, ball], [squeezed, mirror, parts, turn, np.eye(4)]
    joined = Mesh.concatenate(meshes, "crowd", poses=poses)
    assert joined.name == "crowd" and len(joined.faces) == 4 * len(ball.faces) + 1
    assert joined.groups["half"].tolist()[:1] == [0] and len(joined.groups["half"]) == 80
    start = 0
    for mesh, pose in zip(meshes, poses, strict=True):
        matrix = linalg.compose(*pose) if pose is parts else pose
        end = start + len(mesh.positions)
        expected = linalg.transform_points(matrix, mesh.positions).astype(np.float32)
        assert np.array_equal(joined.positions[start:end], expected)
        normals = mesh.normals.astype(np.float64) @ np.linalg.inv(matrix[:3, :3])
        normals /= np.linalg.norm(normals, axis=1)[:, np.newaxis]
        np.testing.assert_allclose(joined.normals[start:end], normals, atol=1e-6)
        start = end
    volume = directed_volume(ball)
    for number, factor in ((0, 1), (1, 1), (2, 8)):
        part = Mesh(joined.positions, joined.faces[number * len(ball.faces) :][: len(ball.faces)])
        assert directed_volume(part) == pytest.approx(factor * volume, rel=1e-5)
        assert directed_volume(part) > 0


def test_a_joined_mesh_gives_the_picture_of_its_parts():
    box = uv_sphere(0.6, (12, 8))
    box.materials = [Material(color=(200, 60, 20))]
    random = np.random.default_rng(1)
    poses = [linalg.compose(random.normal(size=3), random.normal(size=4), s)
             for s in (0.5, (1, -1, 1), (0.3, 0.9, 1.2), -0.7)]  # fmt: skip
    apart, joined = Scene(), Scene()
    for pose in poses:
        apart.add(box, pose=pose)
    joined.add(Mesh.concatenate([box] * 4, poses=poses))
    view = PerspectiveCamera(), look_at((0, 0, 5), (0, 0, 0))
    pictures = [
        render(scene, view, size=(96, 72), look="plain").color.astype(int)
        for scene in (apart, joined)
    ]
    differs = np.abs(pictures[0] - pictures[1]).max(axis=2) > 2  # positions are rounded once more
    assert differs.mean() < 0.01 and pictures[0].std() > 10


def test_poses_of_joined_meshes_are_checked():
    mesh = square()
    for poses, message in (
        ([np.eye(4)], "1 poses for 2 meshes"),
        (5, "poses must be several"),
        ([np.eye(4), np.ones((4, 4))], r"poses\[1\] must be affine"),
        ([np.eye(4), np.eye(3)], "poses"),
        ([np.eye(4), np.full((4, 4), np.nan)], r"poses\[1\] must be finite"),
        ([np.eye(4), ((0, 0, 0), (0, 0, 0, 0), 1)], "quaternion"),
        ([np.eye(4), "pose"], "poses"),
    ):
        with pytest.raises(InvalidArgumentError, match=message):
            Mesh.concatenate([mesh, mesh], poses=poses)
    assert len(Mesh.concatenate([], poses=[]).faces) == 0
    empty = Mesh.concatenate([mesh], poses=np.zeros((1, 4, 4)) + np.diag([1.0, 1, 0, 1]))
    assert (empty.positions[:, 2] == 0).all()


def test_uvs1_and_tangents_are_joined_and_posed():
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    tangents = [(1, 0, 0, 1)] * 3
    mesh = Mesh(corners, [(0, 1, 2)], uvs1=[(0, 0), (1, 0), (0, 1)], tangents=tangents)
    turned = np.array([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1.0]])
    mirrored = np.diag([-2.0, 1, 1, 1])
    joined = Mesh.concatenate([mesh, Mesh(corners), mesh], poses=[turned, np.eye(4), mirrored])
    assert joined.tangents[:3].tolist() == [[0, 1, 0, 1]] * 3
    assert joined.tangents[3:6].tolist() == [[0, 0, 0, 0]] * 3
    assert joined.tangents[6:].tolist() == [[-1, 0, 0, -1]] * 3
    assert joined.uvs1[6:].tolist() == [[0, 0], [1, 0], [0, 1]]
    with pytest.raises(InvalidArgumentError, match=r"tangents must have shape \(N, 4\)"):
        Mesh(corners, tangents=corners)

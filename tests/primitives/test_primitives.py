"""The primitives: counts, closedness, winding, normals, texture coordinates, hidden diagonals."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.errors import InvalidArgumentError

SKEWED = [
    (-1, -1, -1), (1.5, -1, -1), (1, 1, -1.5), (-1, 1, -1),
    (-1, -1.2, 1), (1, -1, 1), (1, 1.3, 1), (-1, 1, 1.1),
]  # fmt: skip
CLOSED = {
    "box": lambda: e3d.box((1.0, 2.0, 3.0)),
    "hexahedron": lambda: e3d.primitives.hexahedron(SKEWED),
    "uv_sphere": lambda: e3d.uv_sphere(2.0, (7, 5)),
    "uv_sphere, coarsest": lambda: e3d.uv_sphere(1.0, (3, 2)),
    "uv_sphere, default": lambda: e3d.uv_sphere(),
    "icosahedron": lambda: e3d.icosphere(1.0, 0),
    "icosphere": lambda: e3d.icosphere(0.7, 3),
    "cylinder": lambda: e3d.cylinder(0.5, 2.0, 9),
    "torus": lambda: e3d.torus(1.0, 0.3, (12, 7)),
}
OPEN = {
    "plane": lambda: e3d.plane((2.0, 3.0), (4, 5)),
    "quad": lambda: e3d.primitives.quad((0, 0, 0), (2, 0, 0), (2, 1, 0.5), (0, 1, 0)),
}
EVERY = {**CLOSED, **OPEN}
CONVEX = sorted(set(CLOSED) - {"torus"})


def shape(name):
    return EVERY[name]()


def welded(mesh):
    """Faces over unique positions, and the number of those."""
    positions, index = np.unique(mesh.positions, axis=0, return_inverse=True)
    return index.reshape(-1)[mesh.faces], len(positions)


def face_normals(mesh):
    a, b, c = mesh.positions[mesh.faces].astype(np.float64).transpose(1, 0, 2)
    return np.cross(b - a, c - a)


@pytest.mark.parametrize("name", CLOSED)
def test_closed_shapes_are_watertight(name):
    faces, _ = welded(shape(name))
    directed = faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    assert len(np.unique(directed, axis=0)) == len(directed)
    assert {tuple(edge) for edge in directed} == {tuple(edge) for edge in directed[:, ::-1]}


@pytest.mark.parametrize("name", CLOSED)
def test_euler_characteristic(name):
    faces, vertices = welded(shape(name))
    assert vertices - len(faces) * 3 // 2 + len(faces) == (0 if name == "torus" else 2)


@pytest.mark.parametrize("name", CLOSED)
def test_position_ids_tell_which_vertices_are_one_point(name):
    mesh = shape(name)
    _, index = np.unique(mesh.positions, axis=0, return_inverse=True)
    pairs = np.unique(np.stack((index.reshape(-1), mesh.position_ids)), axis=1)
    assert pairs.shape[1] == len(np.unique(index)) == len(np.unique(mesh.position_ids))


@pytest.mark.parametrize("name", CONVEX)
def test_faces_of_convex_shapes_look_away_from_the_centre(name):
    mesh = shape(name)
    centres = mesh.positions[mesh.faces].mean(axis=1)
    assert np.all(np.sum(face_normals(mesh) * centres, axis=1) > 0.0)


@pytest.mark.parametrize("name", EVERY)
def test_normals_are_unit_vectors_on_the_front_of_their_faces(name):
    mesh = shape(name)
    assert mesh.has_normals
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-6)
    along = np.sum(face_normals(mesh)[:, np.newaxis] * mesh.normals[mesh.faces], axis=2)
    assert np.all(along > 0.0)


@pytest.mark.parametrize("name", EVERY)
def test_texture_coordinates_lie_in_the_texture_and_do_not_mirror_it(name):
    mesh = shape(name)
    assert mesh.uvs.min() >= 0.0 and mesh.uvs[:, 1].max() <= 1.0
    assert mesh.uvs[:, 0].max() <= (1.2 if "ico" in name else 1.0)
    a, b, c = mesh.uvs[mesh.faces].astype(np.float64).transpose(1, 0, 2)
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert np.all(area > 0.0)


@pytest.mark.parametrize("name", EVERY)
def test_every_vertex_is_used_and_no_triangle_is_empty(name):
    mesh = shape(name)
    assert len(np.unique(mesh.faces)) == len(mesh.positions)
    assert np.all(np.linalg.norm(face_normals(mesh), axis=1) > 1e-6)


@pytest.mark.parametrize("name", EVERY)
def test_edges_are_the_sides_of_quads_and_each_is_there_once(name):
    mesh = shape(name)
    expected = {
        "box": 12,
        "hexahedron": 12,
        "uv_sphere": 7 * 4 + 7 * 5,
        "uv_sphere, coarsest": 3 + 6,
        "uv_sphere, default": 32 * 15 + 32 * 16,
        "cylinder": 27,
        "torus": 2 * 12 * 7,
        "plane": 5 * 5 + 4 * 6,
        "quad": 4,
        "icosahedron": 30,
        "icosphere": 30 * 4**3,
    }
    assert len(mesh.edges()) == expected[name]


def test_counts_of_vertices_and_triangles():
    def counts(mesh):
        return len(mesh.positions), len(mesh.faces)

    assert counts(e3d.box()) == (24, 12)
    assert counts(e3d.primitives.quad()) == (4, 2)
    assert counts(e3d.plane()) == (4, 2)
    assert counts(e3d.plane(segments=(4, 5))) == (30, 40)
    assert counts(e3d.uv_sphere(segments=(32, 16))) == (2 * 32 + 15 * 33, 2 * 32 * 15)
    assert counts(e3d.cylinder(segments=9)) == (40, 36)
    assert counts(e3d.torus(segments=(48, 24))) == (49 * 25, 2 * 48 * 24)
    for subdivisions in range(5):
        mesh = e3d.icosphere(subdivisions=subdivisions)
        assert len(mesh.faces) == 20 * 4**subdivisions
        assert welded(mesh)[1] == 10 * 4**subdivisions + 2


def test_bounds_are_what_was_asked_for():
    np.testing.assert_array_equal(e3d.box((1, 2, 4)).bounds, [[-0.5, -1, -2], [0.5, 1, 2]])
    np.testing.assert_array_equal(e3d.box(2).bounds, [[-1, -1, -1], [1, 1, 1]])
    np.testing.assert_array_equal(e3d.plane((2, 6)).bounds, [[-1, 0, -3], [1, 0, 3]])
    np.testing.assert_array_equal(e3d.uv_sphere(2.0).bounds, [[-2] * 3, [2] * 3])
    np.testing.assert_array_equal(e3d.cylinder(2, 3, 8).bounds, [[-2, -1.5, -2], [2, 1.5, 2]])
    np.testing.assert_allclose(e3d.torus(2, 1).bounds, [[-3, -3, -1], [3, 3, 1]])


@pytest.mark.parametrize("name", ["uv_sphere", "icosphere"])
def test_sphere_vertices_lie_on_the_sphere_and_normals_are_radial(name):
    mesh = {"uv_sphere": e3d.uv_sphere(3.0), "icosphere": e3d.icosphere(3.0, 4)}[name]
    np.testing.assert_allclose(np.linalg.norm(mesh.positions, axis=1), 3.0, rtol=1e-6)
    np.testing.assert_allclose(mesh.positions, 3.0 * mesh.normals, atol=1e-6)


@pytest.mark.parametrize("mesh", [e3d.uv_sphere(1.0, (64, 32)), e3d.icosphere(1.0, 3)])
def test_sphere_textures_are_maps_whose_middle_faces_the_viewer(mesh):
    u, v = mesh.uvs.astype(np.float64).T
    beside_poles = np.abs(mesh.positions[:, 1]) < 0.999
    longitude, latitude = (u - 0.5) * 2.0 * math.pi, (v - 0.5) * math.pi
    expected = np.stack(
        (
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
            np.cos(latitude) * np.cos(longitude),
        ),
        axis=1,
    )
    np.testing.assert_allclose(mesh.positions[beside_poles], expected[beside_poles], atol=2e-6)


def test_uv_sphere_is_symmetric_to_the_bit():
    positions = {tuple(p) for p in e3d.uv_sphere(1.0, (32, 16)).positions.tolist()}
    for x, y, z in positions:
        for mirrored in ((-x, y, z), (x, -y, z), (x, y, -z), (z, y, x)):
            assert mirrored in positions


def test_quad_of_skew_corners_has_one_normal():
    mesh = e3d.primitives.quad((0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 0))
    assert len(np.unique(mesh.normals, axis=0)) == 1


def test_default_shapes_fit_a_unit_cube():
    for make in (
        e3d.box,
        e3d.plane,
        e3d.primitives.quad,
        e3d.uv_sphere,
        e3d.icosphere,
        e3d.cylinder,
    ):
        assert np.abs(make().bounds).max() == pytest.approx(0.5, abs=1e-3)
    assert np.abs(e3d.torus().bounds).max() == pytest.approx(0.5)


@pytest.mark.parametrize(
    "call",
    [
        lambda: e3d.box((1, 2)),
        lambda: e3d.box((1, 0, 1)),
        lambda: e3d.box("wide"),
        lambda: e3d.box(math.nan),
        lambda: e3d.plane((1, -1)),
        lambda: e3d.plane(segments=0),
        lambda: e3d.plane(segments=(1, 2, 3)),
        lambda: e3d.primitives.quad((0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)),
        lambda: e3d.primitives.quad((0, 0), (1, 0), (1, 1), (0, 1)),
        lambda: e3d.primitives.quad((0, 0, math.inf)),
        lambda: e3d.uv_sphere(0.0),
        lambda: e3d.uv_sphere(segments=(2, 2)),
        lambda: e3d.uv_sphere(segments=(3, 1)),
        lambda: e3d.uv_sphere(segments=(8.5, 4)),
        lambda: e3d.uv_sphere(segments=10**6),
        lambda: e3d.icosphere(subdivisions=-1),
        lambda: e3d.icosphere(subdivisions=10),
        lambda: e3d.cylinder(height=-1.0),
        lambda: e3d.cylinder(segments=2),
        lambda: e3d.torus(1.0, 1.0),
        lambda: e3d.torus(segments=(3, 2)),
    ],
)
def test_bad_arguments_are_named(call):
    with pytest.raises(InvalidArgumentError):
        call()


def test_segments_say_what_is_counted():
    with pytest.raises(InvalidArgumentError, match="wedges around and bands from pole .*, not 12"):
        e3d.uv_sphere(segments=12)


def test_a_hexahedron_of_the_corners_of_a_box_is_that_box():
    corners = [(x, y, z) for z in (-0.5, 0.5) for x, y in ((-1, -2), (1, -2), (1, 2), (-1, 2))]
    made, box = e3d.primitives.hexahedron(corners), e3d.box((2, 4, 1))
    for name in ("positions", "faces", "normals", "uvs", "edge_visible"):
        assert np.array_equal(getattr(made, name), getattr(box, name)), name
    assert np.array_equal(made.edges(), box.edges())


def test_a_hexahedron_may_be_a_pyramid():
    base = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]
    back_left, back_right, front_right, front_left = base
    tip = (0, 2, 0)
    mesh = e3d.primitives.hexahedron(
        [back_left, back_right, tip, tip, front_left, front_right, tip, tip]
    )
    assert mesh.bounds.tolist() == [[-1, 0, -1], [1, 2, 1]]
    slope = mesh.normals[16]  # of the front
    assert slope[1] > 0 and slope[2] > 0 and slope[0] == 0


@pytest.mark.parametrize(
    "corners", [np.zeros((8, 3)), np.zeros((8, 2)), np.full((8, 3), np.nan), "box", [[0, 0, 0]]]
)
def test_a_hexahedron_needs_eight_points(corners):
    with pytest.raises(InvalidArgumentError, match="corners"):
        e3d.primitives.hexahedron(corners)

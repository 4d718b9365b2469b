"""Computed normals: weights, seams, degenerate and curved polygons."""

import numpy as np
import pytest

from engine3d.errors import InvalidArgumentError
from engine3d.model.geometry.mesh import Mesh
from engine3d.model.geometry.normals import face_normals, smooth_sums, vertex_normals

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], np.float32)
CUBE_QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def halves(quads, other_diagonal=()):
    faces = []
    for number, (a, b, c, d) in enumerate(quads):
        if number in other_diagonal:
            faces += [(b, c, d), (b, d, a)]
        else:
            faces += [(a, b, c), (a, c, d)]
    return np.array(faces, np.int32)


def test_a_cubes_corners_point_along_its_diagonals_however_it_is_cut():
    outward = np.sign(CUBE - 0.5) / np.sqrt(3)
    for other_diagonal in ((), (0, 3), (0, 1, 2, 3, 4, 5)):
        normals = vertex_normals(CUBE, halves(CUBE_QUADS, other_diagonal))
        assert np.allclose(normals, outward, atol=1e-6)


def angle_weighted_sums(positions, faces, groups, count):
    """What `smooth_sums` promises, with the library's arc cosine."""
    corners = positions[faces].astype(np.float64)
    ab, ac = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normals = np.cross(ab, ac)
    normals /= np.sqrt((normals**2).sum(axis=1, keepdims=True))
    sums = np.zeros((count, 3))
    for k in range(3):
        onward, back = (corners[:, (k + step) % 3] - corners[:, k] for step in (1, 2))
        scale = np.sqrt((onward**2).sum(axis=1) * (back**2).sum(axis=1))
        angles = np.arccos((onward * back).sum(axis=1) / scale)
        np.add.at(sums, groups[:, k], angles[:, np.newaxis] * normals)
    return sums


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_sums_weigh_by_angle(dtype):
    """Against an independent sum; more faces than are added up at a time."""
    random = np.random.default_rng(3)
    positions = random.standard_normal((500, 3)).astype(dtype)
    faces = np.array([random.permutation(500)[:3] for _ in range(1000)], np.int32)
    faces = np.tile(faces, (70, 1))
    groups = random.integers(0, 40, faces.shape)
    sums = smooth_sums(positions, faces, groups, 40)
    assert np.allclose(sums, angle_weighted_sums(positions, faces, groups, 40), atol=2e-3)


def test_angles_are_exact_enough():
    """A triangle whose corners are in groups of their own adds its three angles."""
    random = np.random.default_rng(3)
    triangles = random.standard_normal((1000, 3, 3))
    faces = np.arange(3000).reshape(1000, 3)
    sums = smooth_sums(triangles.reshape(-1, 3), faces, faces, 3000)
    angles = np.sqrt((sums**2).sum(axis=1)).reshape(1000, 3)
    assert np.allclose(angles.sum(axis=1), np.pi, atol=1e-7)
    ab, ac = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    cosine = (ab * ac).sum(axis=1) / np.sqrt((ab * ab).sum(axis=1) * (ac * ac).sum(axis=1))
    assert np.allclose(angles[:, 0], np.arccos(cosine), atol=1e-7)


@pytest.mark.parametrize("wrong", [-1, 3])
def test_indices_out_of_range_are_refused(wrong):
    positions, face = np.eye(3), np.array([(0, 1, 2)])
    with pytest.raises(InvalidArgumentError, match="out of range"):
        smooth_sums(positions, np.array([(0, 1, wrong)]), face, 3)
    with pytest.raises(InvalidArgumentError, match="out of range"):
        smooth_sums(positions, face, np.array([(0, 1, wrong)]), 3)


def test_unused_and_degenerate_vertices_get_zero_never_nan():
    positions = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0), (5, 5, 5), (np.nan, 0, 0)], np.float32)
    normals = vertex_normals(positions, np.array([(0, 1, 2), (0, 1, 4)]))
    assert normals.tolist() == [[0, 0, 0]] * 5


def test_infinite_vertices_do_not_spoil_their_neighbours():
    positions = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (np.inf, 0, 0)], np.float32)
    normals = vertex_normals(positions, np.array([(0, 1, 2), (0, 1, 3)]))
    assert normals[0].tolist() == [0, 0, 1]


def test_tiny_and_huge_triangles_have_unit_normals():
    triangle = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    for scale in (1e-30, 1e30):
        normals = vertex_normals(triangle * np.float32(scale), np.array([(0, 1, 2)]))
        assert normals.tolist() == [[0, 0, 1]] * 3


def test_vertices_of_one_point_share_their_normal():
    positions = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0), (0, 0, 1), (1, 0, 0)])
    faces = np.array([(0, 1, 2), (3, 4, 5)])
    normals = vertex_normals(positions, faces, np.array([0, 1, 2, 0, 3, 1]))
    assert normals[0].tolist() == normals[3].tolist()
    assert normals[1].tolist() == normals[5].tolist()
    assert np.allclose(normals[0], np.array([0, 1, 1]) / np.sqrt(2))


def test_a_polygon_has_one_face_normal():
    bent = [(0, 0, 0), (1, 0, 0), (1, 1, 0.2), (0, 1, 0)]
    visible = [(True, True, False), (False, True, True)]
    mesh = Mesh(bent, [(0, 1, 2), (0, 2, 3)], edge_visible=visible)
    assert mesh.face_normals[0].tolist() == mesh.face_normals[1].tolist()
    apart = Mesh(bent, [(0, 1, 2), (0, 2, 3)]).face_normals
    assert apart[0].tolist() != apart[1].tolist()


def test_a_closed_patch_of_hidden_edges_keeps_its_own_normals():
    faces = halves(CUBE_QUADS)
    mesh = Mesh(CUBE, faces, edge_visible=np.zeros((12, 3), bool))
    assert mesh.polygons.tolist() == [0] * 12
    assert np.array_equal(mesh.face_normals, face_normals(CUBE, faces))


def test_the_same_input_gives_the_same_bytes():
    random = np.random.default_rng(7)
    positions = random.random((500, 3)).astype(np.float32)
    faces = random.integers(0, 500, (1000, 3))
    assert vertex_normals(positions, faces).tobytes() == vertex_normals(positions, faces).tobytes()

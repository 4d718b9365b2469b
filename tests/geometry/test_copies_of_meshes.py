"""Meshes that are copied, moved, or made of polygons."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linalg

STAR = [
    (math.cos(k * math.pi / 5) * (1 + k % 2), math.sin(k * math.pi / 5) * (1 + k % 2), 0)
    for k in range(10)
]


def volume(mesh):
    a, b, c = np.moveaxis(mesh.positions[mesh.faces].astype(float), 1, 0)
    return float((a * np.cross(b, c)).sum() / 6)


def area(mesh):
    a, b, c = np.moveaxis(mesh.positions[mesh.faces].astype(float), 1, 0)
    return np.cross(b - a, c - a).sum(axis=0) / 2


def test_a_copy_changes_alone():
    mesh = e3d.box(1.0)
    mesh.groups = {"top": [0, 1]}
    copied = mesh.copy()
    assert copied.faces is mesh.faces and copied.name == mesh.name
    copied.materials[0].color = (0.2, 0.3, 0.4)
    copied.positions = copied.positions * 2
    copied.groups = {}
    assert mesh.materials[0].color == e3d.Material().color
    assert mesh.bounds.tolist() == [[-0.5] * 3, [0.5] * 3] and "top" in mesh.groups


def test_a_copy_shares_textures():
    texture = e3d.Texture(np.zeros((2, 2, 4), np.uint8))
    mesh = e3d.box(1.0)
    mesh.materials = [e3d.Material(texture=texture)]
    assert mesh.copy().materials[0].texture is texture


@pytest.mark.parametrize("mirrors", [1, -1])
def test_a_transformed_mesh_is_what_its_node_would_show(mirrors):
    rng = np.random.default_rng(3)
    mesh = e3d.uv_sphere(1.0, (12, 8)).with_tangents()
    matrix = linalg.multiply(
        linalg.rotation_x(0.4), linalg.multiply(linalg.scaling((mirrors, 2, 0.5)), np.eye(4))
    )
    matrix[:3, 3] = rng.normal(size=3)
    moved = mesh.transformed(matrix)
    assert np.allclose(moved.positions, linalg.transform_points(matrix, mesh.positions), atol=1e-6)
    assert volume(moved) == pytest.approx(volume(mesh), rel=1e-5)  # of a factor of 1, outside out
    turned = mesh.normals @ np.linalg.inv(matrix[:3, :3])
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    assert np.allclose(moved.normals, turned, atol=1e-5)
    assert (moved.tangents[:, 3] == mirrors * mesh.tangents[:, 3]).all()
    assert moved.materials[0] is mesh.materials[0]


def test_a_mesh_that_is_not_moved_is_another_one():
    mesh = e3d.box(1.0)
    assert mesh.transformed(np.eye(4)) is not mesh


@pytest.mark.parametrize("matrix", [np.eye(4), linalg.scaling((-1, 2, 3))], ids=["stays", "moves"])
def test_a_transformed_mesh_has_values_of_its_own(matrix):
    mesh = e3d.box(1.0)
    mesh.values = {"heat": np.arange(len(mesh.positions)), "load": np.ones(len(mesh.faces))}
    moved = mesh.transformed(matrix)
    assert moved.values["heat"].tolist() == mesh.values["heat"].tolist()
    assert [moved.values.on(name) for name in ("heat", "load")] == ["vertices", "faces"]
    del moved.values["heat"]
    assert list(mesh.values) == ["heat", "load"]


@pytest.mark.parametrize(
    ("matrix", "told"),
    [
        (np.zeros((3, 3)), "matrix"),
        (np.diag([1.0, 1, 1, 2]), "affine"),
        (np.diag([1.0, 1, 0, 1]), "inverse|singular"),
    ],
)
def test_matrices_that_move_nothing(matrix, told):
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        e3d.box(1.0).transformed(matrix)


def test_what_bends_moves_with_its_node():
    mesh = e3d.Mesh(np.eye(3), [[0, 1, 2]], joints=[[0]] * 3, weights=[[1.0]] * 3)
    with pytest.raises(e3d.InvalidArgumentError, match="joints"):
        mesh.transformed(linalg.translation((1, 0, 0)))


def test_a_concave_polygon_keeps_its_area_and_outline():
    mesh = e3d.Mesh.from_polygons(STAR, [range(10)], name="star")
    expected = sum(
        a[0] * b[1] - b[0] * a[1] for a, b in zip(STAR, STAR[1:] + STAR[:1], strict=True)
    )
    assert area(mesh)[2] == pytest.approx(expected / 2, rel=1e-6)
    assert (np.cross(*np.diff(mesh.positions[mesh.faces], axis=1).swapaxes(0, 1))[:, 2] > 0).all()
    assert len(mesh.faces) == 8 and len(mesh.edges()) == 10 and mesh.name == "star"
    assert mesh.polygons.tolist() == [0] * 8


def test_polygons_of_several_lengths_and_materials():
    box = [
        (0, 3, 2, 1),
        (4, 5, 6, 7),
        (0, 1, 5, 4),
        (2, 3, 7, 6),
        (1, 2, 6, 5),
        (3, 0, 4),
        (7, 3, 4),
    ]
    corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    materials = [e3d.Material(), e3d.Material(color=(1, 0, 0))]
    ids = [0, 0, 0, 0, 1, 1, 1]
    mesh = e3d.Mesh.from_polygons(corners, box, materials=materials, material_ids=ids)
    assert volume(mesh) == pytest.approx(1.0) and len(mesh.faces) == 12
    assert mesh.material_ids.tolist() == [0] * 8 + [1] * 4
    assert e3d.Mesh.from_polygons(corners, np.array(box[:4])).faces.shape == (8, 3)
    assert len(e3d.Mesh.from_polygons(corners, []).faces) == 0


@pytest.mark.parametrize(
    ("polygons", "told"),
    [([[0, 1]], "2 corners"), ([[0, 1, 9]], "index 9"), (5, "polygons"), ([["a"]], "polygons")],
)
def test_lists_that_are_no_polygons(polygons, told):
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        e3d.Mesh.from_polygons(np.eye(3), polygons)

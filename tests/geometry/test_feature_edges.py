"""Which edges of meshes are features: sharp ones and borders, of faceted meshes."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.geometry.derived import derived


def edges_of(mesh, what="faceted_edges"):
    return derived(mesh, what)


def welded(mesh):
    """Return a mesh of the same triangles that has neither normals nor split vertices."""
    places, numbers = np.unique(mesh.positions, axis=0, return_inverse=True)
    return e3d.Mesh(places, numbers.reshape(-1)[mesh.faces])


def bumpy(amount, steps=24):
    sphere = welded(e3d.uv_sphere(1.0, (steps, steps // 2)))
    rng = np.random.default_rng(4)
    scale = 1.0 + amount * rng.normal(size=(len(sphere.positions), 1))
    return e3d.Mesh((sphere.positions * scale).astype(np.float32), sphere.faces)


@pytest.mark.parametrize("strip", [False, True])
def test_a_box_has_twelve(strip):
    mesh = welded(e3d.box()) if strip else e3d.box()
    edges = edges_of(mesh)
    assert len(edges) == 12 and edges.dtype == np.int32
    ends = mesh.positions[edges]
    np.testing.assert_allclose(np.abs(ends[:, 1] - ends[:, 0]).sum(1), 1.0)


def test_a_cylinder_has_its_rims_and_a_plane_its_border():
    cylinder = e3d.cylinder(0.5, 1.0)
    ends = cylinder.positions[edges_of(cylinder)]
    assert len(ends) and (ends[:, 0, 1] == ends[:, 1, 1]).all()
    assert len(edges_of(e3d.plane((2.0, 2.0), 5))) == 20


@pytest.mark.parametrize("mesh", [e3d.uv_sphere(), e3d.torus(), bumpy(0.03), bumpy(0.1)])
def test_smooth_and_organic_shapes_have_none(mesh):
    assert len(edges_of(mesh)) == 0


def test_all_feature_edges_of_organic_shapes_are_found_on_request():
    assert len(edges_of(bumpy(0.3), "feature_edges")) > 50


def test_edges_across_which_normals_do_not_break_are_none():
    rough = welded(e3d.uv_sphere(1.0, (8, 4)))  # its faces meet at 45 degrees
    assert len(edges_of(rough)) > 20
    smooth = e3d.Mesh(rough.positions, rough.faces, normals=rough.positions)
    assert len(edges_of(smooth)) == 0


def test_diagonals_of_polygons_and_seams_are_none():
    quad = [(0, 0, 0), (1, 0, 0), (1, 1, 0.9), (0, 1, 0)]  # bent at its diagonal
    mesh = e3d.Mesh.from_polygons(quad, [(0, 1, 2, 3)])
    assert len(edges_of(mesh)) == 4
    split = e3d.plane((2.0, 2.0), 2)
    rows = np.arange(len(split.positions)).repeat(2)
    seam = e3d.Mesh(split.positions[rows], 2 * split.faces)
    assert len(edges_of(seam)) == 8


def test_large_meshes_are_judged_by_parts_of_them():
    fine = e3d.box((1.0, 1.0, 1.0))
    parts = [fine] * 2500
    poses = [
        np.array(((1, 0, 0, 2 * k), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))) for k in range(2500)
    ]
    boxes = e3d.Mesh.concatenate(parts, poses=poses)
    assert len(edges_of(boxes)) == 12 * 2500
    many = e3d.Mesh.concatenate([bumpy(0.1, 96)] * 3)
    assert len(many.faces) > 20_000 and len(edges_of(many)) == 0


def test_edges_are_found_anew_when_the_mesh_changes():
    mesh = welded(e3d.box())
    before = edges_of(mesh)
    assert edges_of(mesh) is before
    mesh.faces = mesh.faces[2:]
    assert len(edges_of(mesh)) == 12 and edges_of(mesh) is not before


def test_empty_and_damaged_meshes_have_none():
    assert len(edges_of(e3d.Mesh(np.zeros((0, 3))))) == 0
    assert len(edges_of(e3d.Mesh(np.zeros((3, 3)), [(0, 1, 2)]))) <= 3

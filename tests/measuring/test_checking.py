"""Faults of surfaces: made on purpose, and found."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.measuring import check


def ball():
    return e3d.icosphere(1.0, 2)


def changed(mesh, faces):
    return e3d.Mesh(mesh.positions, faces)


@pytest.mark.parametrize("mesh", [e3d.box(), ball(), e3d.torus(), e3d.cylinder(), e3d.uv_sphere()])
def test_primitives_have_no_faults(mesh):
    assert not check(mesh).any


@pytest.mark.parametrize("seed", range(5))
def test_turned_faces_are_found(seed):
    mesh = ball()
    faces = mesh.faces.copy()
    turned = np.sort(np.random.default_rng(seed).choice(len(faces), 20, replace=False))
    faces[turned] = faces[turned, ::-1]
    np.testing.assert_array_equal(check(changed(mesh, faces)).flipped, turned)


def test_missing_faces_leave_open_edges():
    mesh = ball()
    found = check(changed(mesh, mesh.faces[1:]))
    corners = mesh.positions[mesh.faces[0]]
    assert len(found.open_edges) == 3
    assert set(map(tuple, found.open_edges.reshape(-1, 3))) == set(
        map(tuple, corners.astype(np.float64))
    )


def test_double_and_flat_faces_are_found():
    mesh = ball()
    count = len(mesh.faces)
    faces = np.concatenate([mesh.faces, mesh.faces[:2, [1, 2, 0]], [[0, 0, 1]]])
    found = check(changed(mesh, faces))
    np.testing.assert_array_equal(found.duplicate, [count, count + 1])
    np.testing.assert_array_equal(found.degenerate, [count + 2])
    assert not len(found.open_edges) and not len(found.flipped)


def test_three_faces_at_an_edge_are_no_manifold():
    fins = e3d.Mesh(
        [(0, 0, 0), (0, 0, 1), (1, 0, 0), (-1, 1, 0), (-1, -1, 0)],
        [(0, 1, 2), (0, 1, 3), (0, 1, 4)],
    )
    found = check(fins)
    np.testing.assert_array_equal(found.non_manifold_edges, [[(0, 0, 0), (0, 0, 1)]])
    assert len(found.open_edges) == 6


def test_faces_that_are_not_finite_are_counted():
    with pytest.warns(e3d.Engine3DWarning):
        mesh = e3d.Mesh([(0, 0, 0), (1, 0, 0), (0, np.nan, 0)], [(0, 1, 2)])
    found = check(mesh)
    assert (found.faces, found.not_finite, found.any) == (1, 1, True)

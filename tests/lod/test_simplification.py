"""Simplified meshes: their counts, their distance from the old surface, no cracks at borders."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.errors import InvalidArgumentError

pytest.importorskip("fast_simplification", reason="needs the optional fast-simplification")


def border(mesh):
    """The positions on edges that only one face has."""
    points, number = np.unique(mesh.positions, axis=0, return_inverse=True)
    edges = np.sort(
        number.reshape(-1)[mesh.faces][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1
    )
    found, count = np.unique(edges, axis=0, return_counts=True)
    return points[np.unique(found[count == 1])]


@pytest.mark.parametrize("ratio", [0.5, 0.2])
def test_a_sphere(ratio):
    mesh = e3d.icosphere(1.0, 4)
    coarse, error = e3d.detail.simplify(mesh, ratio)
    assert 0.8 * ratio * len(mesh.faces) < len(coarse.faces) < 1.3 * ratio * len(mesh.faces)
    corners = coarse.positions[coarse.faces].astype(np.float64)
    inside = 1.0 - np.sqrt((corners.mean(axis=1) ** 2).sum(axis=1)).min()
    assert 0.0 < error < 0.05 and error < 4 * inside
    lengths = np.sqrt((coarse.normals**2).sum(axis=1))
    assert np.allclose(lengths, 1.0, atol=1e-5)
    assert len(border(coarse)) == 0  # the seam is closed


def test_a_plane_has_no_error_and_keeps_its_border():
    mesh = e3d.plane((2, 2), 16)
    coarse, error = e3d.detail.simplify(mesh, 0.2)
    assert len(coarse.faces) < 0.6 * len(mesh.faces)
    assert error < 1e-6
    assert np.array_equal(border(coarse), border(mesh))
    a, b, c = coarse.positions[coarse.faces].astype(np.float64).transpose(1, 0, 2)
    area = 0.5 * np.cross(b - a, c - a)[:, 1]
    assert (area > 0).all() and area.sum() == pytest.approx(4.0)


def test_materials_stay_apart_without_cracks():
    mesh = e3d.plane((2, 2), 16)
    middle = mesh.positions[mesh.faces].mean(axis=1)[:, 0]
    mesh.materials = [e3d.Material(name="left"), e3d.Material(name="right")]
    mesh.material_ids = (middle > 0).astype(np.int32)
    coarse, _ = e3d.detail.simplify(mesh, 0.2)
    assert [material.name for material in coarse.materials] == ["left", "right"]
    for material, sign in ((0, -1), (1, 1)):
        corners = coarse.positions[coarse.faces[coarse.material_ids == material]]
        assert (corners[..., 0] * sign > -1e-6).all()
    assert np.array_equal(border(coarse), border(mesh))


def test_everything_kept_and_nothing_there():
    mesh = e3d.box()
    same, error = e3d.detail.simplify(mesh, 1.0)
    assert len(same.faces) == 12 and error == 0.0
    hard, error = e3d.detail.simplify(mesh, 0.1)  # all of its vertices lie on borders
    assert len(hard.faces) == 12 and error == 0.0
    empty, error = e3d.detail.simplify(e3d.Mesh(np.zeros((0, 3))), 0.5)
    assert len(empty.faces) == 0 and error == 0.0


@pytest.mark.parametrize("ratio", [0.0, -1.0, 1.5, math.nan])
def test_bad_ratios(ratio):
    with pytest.raises(InvalidArgumentError, match="ratio"):
        e3d.detail.simplify(e3d.box(), ratio)


def test_levels_are_made_of_a_mesh():
    spheres = e3d.detail.DetailedInstances(e3d.uv_sphere(1.0, (40, 20)), [(0, 0, 0, 1.0)])
    counts = [len(mesh.faces) for mesh, _ in spheres.levels]
    errors = [error for _, error in spheres.levels]
    assert len(counts) > 2 and counts == sorted(counts, reverse=True)
    assert errors[0] == 0.0 and errors == sorted(errors) and errors[-1] > 0

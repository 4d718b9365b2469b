"""Coarser districts: the same ground, nothing that shows, the same bytes everywhere."""

import hashlib

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d

GROUND = ("asphalt", "stone", "marking", "gravel", "grass", "water")


@pytest.fixture(scope="module")
def world():
    return e3d.worlds.city(400_000, seed=5)


@pytest.fixture(scope="module")
def levels(world):
    return world.levels()


def test_each_level_has_fewer_triangles(world, levels):
    assert levels[0] == (world.districts, 0.0)
    counts = [sum(len(mesh.faces) for mesh in meshes) for meshes, _ in levels]
    assert counts[1] < 0.6 * counts[0] and counts[2] < 0.75 * counts[1]
    errors = [error for _, error in levels]
    assert errors == sorted(errors) and errors[1] <= 0.3
    assert len({len(meshes) for meshes, _ in levels}) == 1
    for meshes, error in levels:
        for fine, mesh in zip(world.districts, meshes, strict=True):
            assert mesh.materials == fine.materials
            assert np.abs(mesh.bounds - fine.bounds).max() <= error


def flat_triangles(mesh):
    """The triangles of the ground's materials that lie flat, sorted: (N, 9)."""
    numbers = [k for k, material in enumerate(mesh.materials) if material.name in GROUND]
    corners = mesh.positions[mesh.faces[np.isin(mesh.material_ids, numbers)]]
    rows = corners[np.ptp(corners[:, :, 1], axis=1) == 0].reshape(-1, 9)
    return rows[np.lexsort(rows.T)]


def test_the_ground_stays(levels):
    """So districts of different levels meet without cracks."""
    for number, fine in enumerate(levels[0][0]):
        ground = flat_triangles(fine)
        assert len(ground) > 0
        for meshes, _ in levels[1:]:
            np.testing.assert_array_equal(flat_triangles(meshes[number]), ground)


@pytest.mark.parametrize("seed", range(4))
def test_nobody_sees_it_from_where_it_is_chosen(world, levels, seed):
    """From above, with levels mixed: few pixels change, and nothing shows through."""
    random = np.random.default_rng(seed)
    scene = e3d.Scene(background=None, ambient=e3d.linear(0.5, 0.5, 0.5))
    scene.add(e3d.DirectionalLight((-0.5, -0.8, -0.4)))
    detailed = e3d.detail.DetailedMeshes(levels)
    group = detailed.add_to(scene)
    camera = e3d.PerspectiveCamera(0.7, znear=5.0, zfar=3000.0)
    side = random.uniform(-250, 250, 2)
    pose = e3d.look_at((side[0], 230.0, side[1]), random.uniform(-40, 40, 3) * (1, 0, 1))
    size = (360, 240)
    outputs = ("color", "depth", "object_id")
    fine = render(scene, (camera, pose), size=size, outputs=outputs)
    assert detailed.update(camera, pose, size)
    assert len(set(detailed.level)) > 1
    frame = render(scene, (camera, pose), size=size, outputs=outputs)
    assert frame.stats["triangles"] < 0.8 * fine.stats["triangles"]
    ids = {place.id for place in group.children}
    assert set(np.unique(frame.object_id)) <= {-1, *ids}
    covered = np.pad(fine.object_id >= 0, 1, mode="edge")
    inside = np.all([covered[y : y + 240, x : x + 360] for y in range(3) for x in range(3)], axis=0)
    assert inside.mean() > 0.5 and (frame.object_id[inside] >= 0).all()
    difference = np.abs(frame.color.astype(int) - fine.color).max(axis=2)
    assert (difference > 40).mean() < 0.03 and difference.mean() < 4
    near = np.abs(frame.depth - fine.depth) > 3.0
    assert near.mean() < 0.02


def test_the_same_bytes_on_every_machine(levels):
    digest = hashlib.sha256()
    for meshes, _ in levels[1:]:
        for mesh in meshes:
            for name in ("positions", "faces", "normals", "uvs", "material_ids"):
                digest.update(np.ascontiguousarray(getattr(mesh, name)).tobytes())
    assert digest.hexdigest()[:16] == "cb122fc0a4809517"

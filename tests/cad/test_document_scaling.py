"""Documents in another unit of length."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.io.cad.document_scaling import scale_document
from engine3d.io.scenes.scene_loading import scene_from_document
from engine3d.loaders import load_document


def random_pose(rng):
    pose = np.eye(4)
    pose[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0] * rng.uniform(0.5, 2.0)
    pose[:3, :3] *= np.sign(np.linalg.det(pose[:3, :3]))
    pose[:3, 3] = rng.normal(size=3)
    return pose


@pytest.mark.parametrize("seed", range(4))
def test_all_places_are_scaled_once(tmp_path, seed):
    rng = np.random.default_rng(seed)
    scene, shared = e3d.Scene(), e3d.icosphere(subdivisions=1)
    parents = [None]
    for _ in range(6):
        parent = parents[rng.integers(len(parents))]
        parents.append(scene.add(shared, pose=random_pose(rng), parent=parent))
    path = tmp_path / "tree.glb"
    e3d.save_scene(scene, path)
    plain, scaled = load_document(path), load_document(path)
    scale_document(scaled, 1000.0)
    one, other = scene_from_document(plain), scene_from_document(scaled)
    assert np.allclose(np.array(other.bounds), np.array(one.bounds) * 1000.0, rtol=1e-5)
    for a, b in zip(one.nodes, other.nodes, strict=True):
        wanted = np.array(a.world_pose)
        wanted[:3, 3] *= 1000.0
        assert np.allclose(b.world_pose, wanted, rtol=1e-6, atol=1e-4)
    for a, b in zip(plain.objects, scaled.objects, strict=True):
        size = 1000.0 * np.ptp(a.mesh.bounds, axis=0)
        assert np.allclose(np.ptp(b.mesh.bounds, axis=0), size, rtol=1e-5)

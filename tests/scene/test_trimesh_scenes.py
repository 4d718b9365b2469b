"""Scenes of trimesh, drawn in one line."""

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d

trimesh = pytest.importorskip("trimesh")


def test_a_scene_is_drawn_as_its_meshes_where_they_are():
    other = trimesh.Scene()
    other.add_geometry(trimesh.creation.box(), transform=np.diag([1.0, 2.0, 1.0, 1.0]))
    expected = e3d.Scene()
    expected.add(e3d.Mesh.from_trimesh(trimesh.creation.box()), scale=(1.0, 2.0, 1.0))
    picture = render(other, size=(32, 24), mode="depth")
    assert np.array_equal(picture.color, render(expected, size=(32, 24), mode="depth").color)
    assert render(trimesh.creation.box(), size=(8, 8)).color.shape == (8, 8, 4)


def test_voxels_are_boxes():
    voxels = trimesh.creation.box().voxelized(0.5)
    frames = [
        render(thing, size=(16, 12), mode="depth")
        for thing in (voxels, trimesh.Scene([voxels]), voxels.as_boxes())
    ]
    for frame in frames[:2]:
        assert np.array_equal(frame.color, frames[2].color)


def test_a_camera_that_was_given_is_used():
    other = trimesh.Scene(trimesh.creation.box())
    pose = np.eye(4)
    pose[:3, 3] = 0.25, 0.0, 4.0
    other.camera = trimesh.scene.Camera(resolution=(40, 40), fov=(60.0, 60.0))
    other.camera_transform = pose
    frame = render(other, size=(40, 40), outputs=("depth",))
    assert frame.depth[20, 20] == pytest.approx(3.5, abs=1e-4)
    columns = np.flatnonzero((frame.depth > 0).any(axis=0))
    assert columns.mean() < 19.0  # the box is left of the middle

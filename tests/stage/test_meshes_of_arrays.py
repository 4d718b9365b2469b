"""`render` of arrays: what their shapes mean, what is told, what is refused."""

import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.meshes_of_arrays import mesh_of_arrays
from engine3d.stage.scenes_of_things import scene_of

RNG = np.random.default_rng(7)
SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int32, np.uint8])
def test_shapes_that_say_what_they_are(dtype):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        points = mesh_of_arrays(SQUARE.astype(dtype))
        faces = np.array([(0, 1, 2), (0, 2, 3)], np.int64)
        for pair in ((SQUARE.astype(dtype), faces), [SQUARE.astype(dtype), faces.astype("u4")]):
            mesh = mesh_of_arrays(pair)
            assert np.array_equal(mesh.faces, faces) and np.array_equal(mesh.positions, SQUARE)
        segments = mesh_of_arrays(RNG.random((5, 2, 3)))
        triangles = mesh_of_arrays(RNG.random((5, 3, 3)))
    assert len(points.points) == 4 and not len(points.faces)
    assert (len(segments.lines), len(segments.positions)) == (5, 10)
    assert (len(triangles.faces), len(triangles.positions)) == (5, 15)


@pytest.mark.parametrize(("most", "dtype"), [(1, float), (255, np.uint8), (255, float)])
def test_six_columns_are_points_with_colours(most, dtype):
    rows = np.concatenate([SQUARE * 3, most * np.eye(4)[:, :3]], 1).astype(dtype)
    with pytest.warns(e3d.Engine3DWarning, match=rf"points with colours from 0 to {most}$"):
        mesh = mesh_of_arrays(rows)
    assert np.array_equal(mesh.colors[:, :3], 255 * np.eye(4)[:, :3])
    with pytest.raises(e3d.InvalidArgumentError, match="colours, 0 to 1 or 0 to 255"):
        mesh_of_arrays(rows.astype(float) - 7)


@pytest.mark.parametrize("shape", [(2, 2), (3, 7), (40, 30), (5, 4)])
def test_heights_face_up(shape):
    heights = RNG.random(shape)
    with pytest.warns(e3d.Engine3DWarning, match="heights along Y, a unit apart"):
        mesh = mesh_of_arrays(heights)
    assert len(mesh.faces) == 2 * (shape[0] - 1) * (shape[1] - 1)
    a, b, c = (mesh.positions[mesh.faces[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 1] > 0).all()
    column, row = mesh.positions[:, 0].astype(int), mesh.positions[:, 2].astype(int)
    assert np.allclose(mesh.positions[:, 1], heights[row, column])
    assert np.array_equal(mesh.values["height"], heights.reshape(-1))


@pytest.mark.parametrize("seed", range(4))
def test_voxels_are_closed_bodies_of_their_volume(seed):
    voxels = np.random.default_rng(seed).random((4, 3, 5)) < 0.5
    mesh = mesh_of_arrays(voxels)
    corners = mesh.positions[mesh.faces].astype(float)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume == pytest.approx(voxels.sum())
    whole = mesh_of_arrays(np.ones((3, 3, 3), bool))
    assert len(whole.faces) == 2 * 6 * 9


@pytest.mark.parametrize(
    "array",
    [
        np.zeros((4, 4, 4)),
        np.zeros((8, 8, 3), np.uint8),
        np.zeros((4, 2)) > 0,
        np.zeros(9),
        np.zeros((3, 3), complex),
        np.array(["a", "b"]),
        (SQUARE, SQUARE),
        (SQUARE[:, :2], np.zeros((1, 3), int)),
    ],
)
def test_other_arrays_are_refused_with_what_would_do(array):
    with pytest.raises(e3d.InvalidArgumentError, match=r"shows nothing: \(N, 3\) are points"):
        e3d.render(array, size=(16, 12))


def test_an_array_is_drawn_as_its_mesh():
    voxels = RNG.random((3, 3, 3)) < 0.6
    picture = e3d.render(voxels, size=(32, 24)).color
    assert np.array_equal(picture, e3d.render(mesh_of_arrays(voxels), size=(32, 24)).color)
    assert scene_of(voxels).nodes[0].name == "voxels"
    assert mesh_of_arrays([SQUARE]) is None and mesh_of_arrays("a") is None

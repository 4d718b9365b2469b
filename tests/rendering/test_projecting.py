"""Points of the world in the picture: `Frame.project` against what frames show."""

import math
import pickle

import numpy as np
import pytest

import engine3d as e3d

CAMERAS = {
    "perspective": e3d.PerspectiveCamera(0.8),
    "orthographic": e3d.OrthographicCamera(2.0),
    "intrinsics": e3d.IntrinsicsCamera(70.0, 90.0, 40.0, 20.0),
}


def drawn(camera, outputs=("depth", "world_position")):
    scene = e3d.Scene()
    scene.add(e3d.icosphere(1.0, subdivisions=2), rotation=(0.1, 0.2, 0.3, 1.0))
    pose = e3d.look_at((1, 2, 4), (0.2, 0, 0))
    return e3d.render(scene, (camera, pose), size=(96, 64), outputs=outputs)


@pytest.mark.parametrize("kind", CAMERAS)
def test_what_pixels_show_projects_to_their_centres(kind):
    frame = drawn(CAMERAS[kind])
    rows, columns = np.nonzero(frame.depth)
    assert len(rows) > 200
    pixels, depth = frame.project(frame.world_position[rows, columns])
    assert pixels.shape == (len(rows), 2)
    np.testing.assert_allclose(pixels, np.stack([columns, rows], axis=1) + 0.5, atol=2e-3)
    np.testing.assert_allclose(depth, frame.depth[rows, columns], rtol=1e-5)


def test_one_point_and_points_that_have_no_place():
    frame = drawn(CAMERAS["perspective"])
    pixels, depth = frame.project((0.2, 0.0, 0.0))  # what the camera looks at
    np.testing.assert_allclose(pixels, (48, 32), atol=1e-9)
    assert depth == pytest.approx(math.dist((1, 2, 4), (0.2, 0, 0)))
    pixels, depth = frame.project([(1.8, 4.0, 8.0), (1, 2, 4), (np.nan, 0, 0), (0, 4, 0)])
    assert np.isnan(pixels[:3]).all()
    assert depth[0] < 0 == depth[1]
    assert pixels[3, 1] < 0  # above the picture


def test_a_frame_projects_as_it_was_drawn_and_elsewhere():
    camera = e3d.PerspectiveCamera(0.8)
    frame = drawn(camera)
    before = frame.project((0, 1, 0))[0]
    camera.yfov = 0.2
    np.testing.assert_array_equal(frame.project((0, 1, 0))[0], before)
    there = pickle.loads(pickle.dumps(frame))
    np.testing.assert_array_equal(there.project((0, 1, 0))[0], before)


@pytest.mark.parametrize("points", [(1, 2), 3.0, "abc", [(1, 2, 3, 4)]])
def test_points_of_another_shape(points):
    with pytest.raises(e3d.InvalidArgumentError, match="points must"):
        drawn(CAMERAS["perspective"]).project(points)


def test_a_frame_that_nobody_drew():
    frame = e3d.Frame((1, 1), {"color": np.zeros((1, 1, 4), np.uint8)})
    with pytest.raises(e3d.InvalidArgumentError, match="not drawn by a Renderer"):
        frame.project((0, 0, 0))

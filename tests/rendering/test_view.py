"""The matrices that a frame gets of its camera: to the bit those that linalg finds."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linalg
from engine3d.rendering._view import View

CAMERAS = (
    e3d.PerspectiveCamera(0.9, znear=0.05, zfar=100.0),
    e3d.OrthographicCamera(2.5),
    e3d.IntrinsicsCamera(500.0, 510.0, 320.0, 230.0),
    e3d.Camera(np.arange(16.0).reshape(4, 4) ** 2 + np.eye(4)),
)


def poses(count):
    """Poses of all kinds: rigid, sheared, of huge and of tiny numbers, with zeros."""
    random = np.random.default_rng(5)
    for k in range(count):
        pose = random.normal(0, 1, (4, 4)) * 10.0 ** random.integers(
            -90, 90, (4, 1) if k % 3 else ()
        )
        pose[3] = random.normal(0, 1, 4) if k % 5 == 0 else (0, 0, 0, 1)
        if k % 2:
            pose = linalg.compose(*(random.normal(0, 3, n) for n in (3, 4, 3)))
        if k % 7 == 0:
            pose[random.integers(0, 3), random.integers(0, 4)] = random.choice((0.0, -0.0))
        yield pose


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda camera: type(camera).__name__)
def test_matrices_are_those_of_linalg(camera):
    projection = camera.projection((640, 480))
    perspective = bool(projection[3, :3].any())
    inverted = 0
    for pose in poses(600):
        try:
            expected = linalg.inverse(pose)
        except e3d.InvalidArgumentError:
            with pytest.raises(e3d.InvalidArgumentError, match="no inverse"):
                View(camera, pose, 640, 480)
            continue
        inverted += 1
        view = View(camera, pose, 640, 480)
        assert view.view_from_world.tobytes() == expected.tobytes()
        product = linalg.multiply(projection, expected)
        assert view.clip_from_world.tobytes() == product.tobytes()
        towards = tuple(linalg.normalize(pose[:3, 2]).tolist())
        assert view.towards_viewer == towards
        assert view.eye == ((*pose[:3, 3].tolist(), 1.0) if perspective else (*towards, 0.0))
    assert inverted > 400


def test_a_pose_without_inverse():
    for pose in (np.zeros((4, 4)), np.diag((1.0, 1.0, 0.0, 1.0)), np.full((4, 4), np.nan)):
        with pytest.raises(e3d.InvalidArgumentError, match="no inverse"):
            View(CAMERAS[0], pose, 64, 64)


class PackedCamera(e3d.PerspectiveCamera):
    """Keeps its projection in a record, where it has no place that suits its numbers."""

    def projection(self, size):
        record = np.zeros(1, [("kind", "u1"), ("matrix", "f8", (4, 4))])
        record["matrix"] = super().projection(size)
        return record["matrix"][0]


def test_a_projection_may_lie_anywhere_in_memory():
    scene = e3d.Scene()
    scene.add(e3d.box())
    pose = e3d.look_at((1, 1, 4), (0, 0, 0))
    pictures = [
        e3d.Renderer((40, 30)).render(scene, (camera(0.7), pose)).color
        for camera in (e3d.PerspectiveCamera, PackedCamera)
    ]
    assert np.array_equal(*pictures)

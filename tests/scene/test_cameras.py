"""Projections and their arguments."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linalg


def project(camera, point, width=200, height=100):
    """The pixel coordinates (x right, y down) and z_ndc of a point in view space."""
    clip = camera.projection((width, height)) @ [*point, 1.0]
    x, y, z = clip[:3] / clip[3]
    return (x + 1) / 2 * width, (1 - y) / 2 * height, z


def test_perspective_shows_the_field_of_view():
    camera = e3d.PerspectiveCamera(math.pi / 2, znear=1, zfar=10)
    assert project(camera, (0, 0, -1)) == pytest.approx((100, 50, -1))
    assert project(camera, (0, 0, -10)) == pytest.approx((100, 50, 1))
    assert project(camera, (0, 5, -5))[1] == pytest.approx(0)
    assert project(camera, (10, 0, -5))[0] == pytest.approx(200)


def test_perspective_takes_an_aspect_of_its_own():
    camera = e3d.PerspectiveCamera(math.pi / 2, aspect=1.0)
    assert project(camera, (5, 0, -5))[0] == pytest.approx(200)


def test_perspective_without_far_plane():
    camera = e3d.PerspectiveCamera(znear=1, zfar=math.inf)
    assert project(camera, (0, 0, -1e12))[2] == pytest.approx(1)


def test_orthographic():
    camera = e3d.OrthographicCamera(2.0, znear=0, zfar=4)
    assert project(camera, (0, 2, -4)) == pytest.approx((100, 0, 1))
    assert project(camera, (4, 0, 0)) == pytest.approx((200, 50, -1))
    assert project(e3d.OrthographicCamera(2.0, xmag=1.0), (1, 0, -1))[0] == pytest.approx(200)


def test_intrinsics_follow_the_pinhole_equation():
    camera = e3d.IntrinsicsCamera(300.0, 310.0, 90.0, 40.0, znear=0.1, zfar=10)
    x, y, z = 0.3, -0.2, 2.0
    pixel = project(camera, (x, -y, -z))
    assert pixel[:2] == pytest.approx((300 * x / z + 90, 310 * y / z + 40))


def test_intrinsics_equal_perspective():
    perspective = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=10)
    focal = 50 / math.tan(0.4)
    intrinsics = e3d.IntrinsicsCamera(focal, focal, 100, 50, znear=0.1, zfar=10)
    np.testing.assert_allclose(
        intrinsics.projection((200, 100)), perspective.projection((200, 100)), atol=1e-12
    )


def test_camera_of_a_matrix():
    matrix = linalg.perspective(0.9, 2.0, 0.1, 10)
    camera = e3d.Camera(matrix)
    np.testing.assert_array_equal(camera.projection((7, 5)), matrix)
    assert not camera.matrix.flags.writeable
    assert not hasattr(e3d.PerspectiveCamera(), "matrix")


def test_assigning_counts_versions():
    camera = e3d.PerspectiveCamera()
    before = camera.version
    camera.yfov = 1.0
    assert camera.version > before


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: e3d.PerspectiveCamera(0), "yfov"),
        (lambda: e3d.PerspectiveCamera(math.pi), "yfov"),
        (lambda: e3d.PerspectiveCamera("wide"), "yfov"),
        (lambda: e3d.PerspectiveCamera(znear=0), "znear"),
        (lambda: e3d.PerspectiveCamera(znear=2, zfar=1), "znear must be less than zfar"),
        (lambda: e3d.PerspectiveCamera(zfar=math.nan), "zfar"),
        (lambda: e3d.PerspectiveCamera(aspect=0), "aspect"),
        (lambda: e3d.OrthographicCamera(-1), "ymag"),
        (lambda: e3d.OrthographicCamera(1, znear=5, zfar=5), "znear must be less"),
        (lambda: e3d.OrthographicCamera(1, zfar=math.inf), "zfar"),
        (lambda: e3d.IntrinsicsCamera(0, 1, 0, 0), "fx"),
        (lambda: e3d.IntrinsicsCamera(1, 1, math.nan, 0), "cx"),
        (lambda: e3d.Camera(np.eye(3)), r"projection must have shape \(4, 4\)"),
        (lambda: e3d.Camera(np.full((4, 4), math.inf)), "projection must be finite"),
    ],
)
def test_invalid_arguments(make, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        make()

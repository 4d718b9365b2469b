"""Lens models: pixels of directions and back, against OpenCV and the formulas of their sources."""

import copy
import math
import pickle

import numpy as np
import pytest

import engine3d as e3d

K = np.array([[300.0, 0.0, 319.5], [0.0, 310.0, 239.5], [0.0, 0.0, 1.0]])
SIZE = (640, 480)
LENSES = {
    "equidistant": e3d.FisheyeCamera(150, 150, 320, 240),
    "fisheye": e3d.FisheyeCamera(150, 155, 318, 243, (-0.02, 0.004, -0.001, 0.0001)),
    "turning": e3d.FisheyeCamera(200, 200, 320, 240, (-0.1, -0.02, 0.0, 0.0)),
    "narrow": e3d.FisheyeCamera(150, 150, 320, 240, max_angle=1.2),
    "barrel": e3d.BrownConradyCamera(350, 360, 320, 240, (-0.3, 0.1, 0.001, -0.002)),
    "pincushion": e3d.BrownConradyCamera(350, 350, 320, 240, (0.2, 0.05, 0.0, 0.0, 0.01)),
    "rational": e3d.BrownConradyCamera(
        350, 350, 320, 240, (0.1, 0.02, 0.001, -0.002, 0.001, 0.2, 0.03, 0.001)
    ),
    "double sphere": e3d.DoubleSphereCamera(200, 200, 320, 240, -0.2, 0.6),
    "unified": e3d.DoubleSphereCamera(200, 200, 320, 240, 0.0, 0.7),
    "equirectangular": e3d.EquirectangularCamera(),
    "partial": e3d.EquirectangularCamera(xfov=2.0, yfov=1.0),
    "cylindrical": e3d.CylindricalCamera(xfov=4.0, yfov=1.4),
}


def pixels(size=SIZE):
    """The centres of all pixels, (N, 2)."""
    width, height = size
    grid = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    return np.stack(grid, axis=-1).reshape(-1, 2)


def directions(count=4000, seed=1):
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1)[:, np.newaxis]


@pytest.mark.parametrize("lens", LENSES)
def test_pixels_look_where_points_are_seen(lens):
    camera = LENSES[lens]
    rays = camera.rays(pixels(), SIZE)
    seen = np.isfinite(rays[:, 0])
    assert seen.any()
    np.testing.assert_allclose(np.linalg.norm(rays[seen], axis=1), 1.0, atol=1e-14)
    np.testing.assert_allclose(camera.project(rays[seen], SIZE), pixels()[seen], atol=1e-8)
    np.testing.assert_array_equal(camera.mask(SIZE), seen.reshape(480, 640))


@pytest.mark.parametrize("lens", LENSES)
def test_points_are_seen_where_pixels_look(lens):
    camera, ways = LENSES[lens], directions()
    places = camera.project(ways * 7.0, SIZE)
    seen = np.isfinite(places[:, 0])
    if lens == "partial" or lens == "cylindrical":
        assert 0.05 < seen.mean() < 0.7
    np.testing.assert_allclose(camera.rays(places[seen], SIZE), ways[seen], atol=1e-8)


@pytest.mark.parametrize("lens", LENSES)
def test_one_pixel_has_the_bits_of_many(lens):
    camera = LENSES[lens]
    many = camera.rays(pixels()[::1009], SIZE)
    for place, ray in zip(pixels()[::1009], many, strict=True):
        assert camera.rays(place, SIZE).tobytes() == ray.tobytes()
        if np.isfinite(ray[0]):
            assert camera.project(ray, SIZE).shape == (2,)


@pytest.mark.parametrize("count", [4, 5, 8, 12])
def test_brown_conrady_is_opencvs(count):
    cv2 = pytest.importorskip("cv2", exc_type=ImportError)
    rng = np.random.default_rng(count)
    for _ in range(10):
        d = (
            rng.uniform(-1, 1, 12)[:count]
            * np.array([0.2, 0.05, 0.002, 0.002, 0.01, 0.1] + [0.01] * 6)[:count]
        )
        camera = e3d.BrownConradyCamera.from_opencv(K, d)
        points = np.stack(
            [rng.uniform(-0.8, 0.8, 500), rng.uniform(-0.6, 0.6, 500), np.full(500, -1.0)], axis=-1
        )
        theirs = cv2.projectPoints(points * (1, -1, -1), np.zeros(3), np.zeros(3), K, d)[0][:, 0]
        ours = camera.project(points)
        seen = np.isfinite(ours[:, 0])
        assert seen.mean() > 0.5
        np.testing.assert_allclose(ours[seen] - 0.5, theirs[seen], atol=1e-9)


def test_undistorted_pixels_are_opencvs():
    cv2 = pytest.importorskip("cv2", exc_type=ImportError)
    d = np.array([-0.28, 0.07, 0.0005, -0.001, 0.01])
    rays = e3d.BrownConradyCamera.from_opencv(K, d).rays(pixels())
    seen = np.isfinite(rays[:, 0])
    ours = np.stack([rays[seen, 0], -rays[seen, 1]], axis=-1) / -rays[seen, 2:]
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-14)
    given = (pixels()[seen] - 0.5)[:, np.newaxis]
    theirs = cv2.undistortPoints(given, K, d, criteria=criteria)[:, 0]
    assert seen.all()
    flat = np.pad(theirs, ((0, 0), (0, 1)), constant_values=1.0)
    back = cv2.projectPoints(flat, np.zeros(3), np.zeros(3), K, d)[0][:, 0]
    done = np.abs(back - given[:, 0]).max(axis=1) < 1e-9  # its iteration ends early elsewhere
    assert done.mean() > 0.9
    np.testing.assert_allclose(ours[done] * 300.0, theirs[done] * 300.0, atol=1e-6)


def test_the_fisheye_is_opencvs():
    cv2 = pytest.importorskip("cv2", exc_type=ImportError)
    rng = np.random.default_rng(5)
    for _ in range(10):
        k = rng.uniform(-1, 1, 4) * (0.05, 0.01, 0.002, 0.0005)
        camera = e3d.FisheyeCamera.from_opencv(K, k)
        ahead = directions(500)
        ahead = ahead[ahead[:, 2] < -0.1]
        theirs = cv2.fisheye.projectPoints(
            (ahead * (1, -1, -1))[:, np.newaxis], np.zeros(3), np.zeros(3), K, k
        )[0][:, 0]
        ours = camera.project(ahead)
        seen = np.isfinite(ours[:, 0])
        assert seen.mean() > 0.5
        np.testing.assert_allclose(ours[seen] - 0.5, theirs[seen], atol=1e-9)


def test_the_fisheye_sees_behind_itself():
    camera = e3d.FisheyeCamera(100, 100, 320, 240, max_angle=math.radians(110))
    angle = math.radians(105)
    point = (math.sin(angle), 0.0, -math.cos(angle))
    np.testing.assert_allclose(camera.project(point), (320 + 100 * angle, 240))
    assert np.isnan(camera.project((0.0, 0.0, 1.0))).all()


def test_a_radius_that_turns_back_ends_the_picture():
    camera = LENSES["turning"]
    grid = np.linspace(0.0, math.pi, 100001)
    radius = 200 * grid * (1 - 0.1 * grid**2 - 0.02 * grid**4)
    most = radius.max()
    assert np.isfinite(camera.rays((320 + most - 1e-6, 240.0))).all()
    assert np.isnan(camera.rays((320 + most + 1e-3, 240.0))).all()
    beyond = grid[radius.argmax()] + 0.01
    assert np.isnan(camera.project((math.sin(beyond), 0.0, -math.cos(beyond)))).all()


def test_the_double_sphere_follows_its_source():
    camera, (x, y, z) = LENSES["double sphere"], (0.4, -0.2, 1.0)
    first = math.sqrt(x * x + y * y + z * z)
    second = math.sqrt(x * x + y * y + (-0.2 * first + z) ** 2)
    below = 0.6 * second + 0.4 * (-0.2 * first + z)
    np.testing.assert_allclose(
        camera.project((x, -y, -z)), (200 * x / below + 320, 200 * y / below + 240)
    )


def test_without_alpha_the_double_sphere_is_a_pinhole():
    camera, pinhole = e3d.DoubleSphereCamera(200, 210, 30, 20, 0.0, 0.0), (200.0, 210.0, 30.0, 20.0)
    points = (0.4, -0.2, -1.0)
    np.testing.assert_allclose(
        camera.project(points), e3d.IntrinsicsCamera(*pinhole).project(points)
    )


def test_panoramas_show_angles():
    camera = e3d.EquirectangularCamera()
    np.testing.assert_allclose(camera.project((0, 0, -1), (400, 200)), (200, 100))
    np.testing.assert_allclose(camera.project((1, 0, 0), (400, 200)), (300, 100))
    np.testing.assert_allclose(camera.project((0, 1, -1), (400, 200)), (200, 50))
    cylinder = e3d.CylindricalCamera(xfov=math.pi, yfov=math.pi / 2)
    np.testing.assert_allclose(cylinder.project((1, 1, -1), (300, 200)), (225, 100 - 100 / 2**0.5))


@pytest.mark.parametrize(
    ("camera", "size"),
    [
        (e3d.PerspectiveCamera(1.2), SIZE),
        (e3d.PerspectiveCamera(0.5, aspect=1.3, reversed_depth=True), (64, 48)),
        (e3d.IntrinsicsCamera(300, 310, 100, 90), (17, 9)),
        (e3d.Camera(e3d.PerspectiveCamera(1.2).projection(SIZE)), SIZE),
    ],
)
def test_pinholes_project_and_look(camera, size):
    places = np.random.default_rng(0).uniform(0, 600, (100, 2))
    rays = camera.rays(places, size)
    assert (rays[:, 2] < 0).all()
    np.testing.assert_allclose(camera.project(rays * 3.0, size), places, atol=1e-9)
    assert np.isnan(camera.project((0.0, 0.0, 1.0), size)).all()


def test_without_perspective_all_look_ahead():
    camera = e3d.OrthographicCamera(2.0)
    np.testing.assert_allclose(camera.rays([(0.0, 0.0), (9.0, 3.0)], SIZE), [(0, 0, -1)] * 2)
    np.testing.assert_allclose(camera.project((0, 2, -4), (200, 100)), (100, 0))


def test_a_distortion_of_zero_is_a_pinhole():
    camera, pinhole = (
        e3d.BrownConradyCamera(300, 310, 100, 90),
        e3d.IntrinsicsCamera(300, 310, 100, 90),
    )
    ways = directions()
    ways = ways[ways[:, 2] < -0.1]
    np.testing.assert_allclose(camera.project(ways), pinhole.project(ways), atol=1e-9)


@pytest.mark.parametrize("lens", LENSES)
def test_copies_and_pickles_are_the_same_camera(lens):
    camera = LENSES[lens]
    for other in (copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
        assert (
            other.rays((300.5, 200.5), SIZE).tobytes()
            == camera.rays((300.5, 200.5), SIZE).tobytes()
        )


@pytest.mark.parametrize(
    "make",
    [
        lambda: e3d.FisheyeCamera(0, 1, 1, 1),
        lambda: e3d.FisheyeCamera(1, 1, math.nan, 1),
        lambda: e3d.FisheyeCamera(1, 1, 1, 1, (0, 0, 0)),
        lambda: e3d.FisheyeCamera(1, 1, 1, 1, (0, 0, 0, math.inf)),
        lambda: e3d.FisheyeCamera(1, 1, 1, 1, max_angle=180),
        lambda: e3d.FisheyeCamera(1, 1, 1, 1, znear=2, zfar=1),
        lambda: e3d.BrownConradyCamera(1, 1, 1, 1, (0,) * 14),
        lambda: e3d.BrownConradyCamera(1, 1, 1, 1, "no"),
        lambda: e3d.BrownConradyCamera.from_opencv([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]),
        lambda: e3d.FisheyeCamera.from_opencv(np.eye(4)),
        lambda: e3d.DoubleSphereCamera(1, 1, 1, 1, 2.0),
        lambda: e3d.DoubleSphereCamera(1, 1, 1, 1, 0.0, 1.5),
        lambda: e3d.EquirectangularCamera(xfov=7.0),
        lambda: e3d.EquirectangularCamera(yfov=0.0),
        lambda: e3d.CylindricalCamera(yfov=math.pi),
        lambda: e3d.PerspectiveCamera().rays((0, 0), (0, 0)),
        lambda: LENSES["fisheye"].rays((1, 2, 3)),
        lambda: LENSES["fisheye"].mask((0, 4)),
    ],
)
def test_what_makes_no_sense_is_refused(make):
    with pytest.raises(e3d.InvalidArgumentError):
        make()


def test_numbers_that_are_not_finite_are_seen_nowhere():
    camera = LENSES["fisheye"]
    assert np.isnan(camera.project([(math.nan, 0, -1), (0, 0, 0)])).all()
    assert np.isnan(camera.rays([(math.nan, 1.0), (math.inf, 1.0)])).all()


@pytest.mark.parametrize("count", [0, 1, 3, 5, 14])
def test_wrong_coefficients_of_opencv_are_called_as_given(count):
    matrix = np.diag([300.0, 300.0, 1.0])
    kinds = [e3d.FisheyeCamera] if count == 5 else [e3d.FisheyeCamera, e3d.BrownConradyCamera]
    for kind in kinds:
        with pytest.raises(e3d.InvalidArgumentError, match=f"^D must be .* numbers, not {count}$"):
            kind.from_opencv(matrix, np.zeros((1, count)))

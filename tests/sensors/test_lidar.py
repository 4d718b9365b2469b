"""LiDARs: beams against rays and plain geometry, patterns, motion, losses, files."""

import math

import numpy as np
import pytest
from sensors.moving_scene import MovingScene

import engine3d as e3d
from engine3d.sensors import Lidar

HERE = e3d.look_at((0, 0, 0), (0, 0, -1))


def room():
    """A box of 10 x 4 x 6 around the origin, seen from inside."""
    scene = e3d.Scene()
    scene.add(e3d.box(2.0), scale=(5.0, 2.0, 3.0), name="room")
    return scene


def test_distances_in_a_room():
    scan = Lidar.spinning([-0.3, 0.0, 0.2], 360).scan(room(), HERE)
    assert len(scan) == 3 * 360 and scan.shape == (3, 360)
    # the sensor's x is the node's -Z, y its -X, z its Y
    points = scan.points.astype(float)
    most = np.abs(points / (3.0, 5.0, 2.0)).max(axis=1)
    assert np.abs(most - 1.0).max() < 1e-5
    assert np.allclose(scan.world_points, points[:, [1, 2, 0]] * (-1, 1, -1), atol=1e-5)
    assert np.allclose(np.linalg.norm(points, axis=1), scan.range, rtol=1e-6)
    forward = np.argmin(np.abs(np.arctan2(points[:, 1], points[:, 0])))
    assert scan.column[forward] in (179, 180) and points[forward, 0] > 2.8


def test_beams_are_the_scenes_rays():
    moving = MovingScene().at(0.4)
    lidar = Lidar.spinning(np.linspace(-0.5, 0.4, 16), 300, max_range=6.0, min_range=1.0)
    pose = e3d.look_at((0.2, 0.3, 3.0), (0, 0, 0))
    scan = lidar.scan(moving.scene, pose)
    assert set(np.unique(scan.object_id)) > {moving.floor.id, moving.boxes.id, moving.strip.id}
    rays = lidar.directions[scan.ring, scan.column]
    ways = rays @ np.array([(0, 0, -1), (-1, 0, 0), (0, 1, 0)]) @ pose[:3, :3].T
    for row in range(0, len(scan), 37):
        hit = moving.scene.raycast(pose[:3, 3], ways[row])
        same = hit.object_id, hit.instance_id, hit.face_id
        assert same == (scan.object_id[row], scan.instance_id[row], scan.face_id[row])
        assert scan.range[row] == pytest.approx(hit.distance, rel=1e-6)
        cosine = abs(float(np.dot(hit.normal, ways[row])))
        assert scan.incidence[row] == pytest.approx(cosine, abs=1e-6)
        assert np.allclose(scan.normal[row], hit.normal, atol=1e-6)
    assert scan.range.min() >= 1.0 and scan.range.max() <= 6.0


def test_the_same_bytes_again_and_anew():
    moving = MovingScene()
    lidar = Lidar.of("os1-32")
    first = lidar.scan(moving.at(0.2).scene, HERE)
    lidar.scan(moving.at(0.7).scene, HERE)
    again = lidar.scan(moving.at(0.2).scene, HERE)
    fresh = lidar.scan(MovingScene().at(0.2).scene, HERE)
    for other in (again, fresh):
        for name, value in vars(first).items():
            if name != "shape":
                assert value.tobytes() == getattr(other, name).tobytes(), name


def test_intensity_is_reflectance_times_incidence():
    scene = e3d.Scene()
    grey = e3d.box(2.0)
    grey.materials = [e3d.Material(color=e3d.linear(0.2, 0.4, 0.9))]
    scene.add(grey, scale=(5, 2, 3))
    scan = Lidar.spinning([0.1], 90).scan(scene, HERE)
    assert np.allclose(scan.intensity, 0.5 * scan.incidence, atol=1e-6)


def test_reflectance_knows_textures_vertex_and_instance_colours():
    texels = np.zeros((2, 2, 3), np.uint8)
    texels[0, 0] = 255  # top left
    wall = e3d.Mesh(
        [(-1, -1, -2), (1, -1, -2), (1, 1, -2), (-1, 1, -2)],
        [(0, 1, 2), (0, 2, 3)],
        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
        materials=[e3d.Material(texture=e3d.Texture(texels))],
        colors=e3d.linear(np.full((4, 3), 0.5)),
    )
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(wall, [np.eye(4)], colors=e3d.linear(np.full((1, 3), 0.5))))
    scan = Lidar.raster((20, 20), (0.8, 0.8)).scan(scene, HERE)
    picture = scan.image("intensity") / np.maximum(scan.image("incidence"), 1e-9)
    assert np.allclose(picture[:10, :10], 0.25, atol=1e-6)
    assert not picture[10:].any() and not picture[:, 10:].any()


def test_the_raster_scans_a_rectangle_from_the_top_left():
    lidar = Lidar.raster((5, 3), (1.0, 0.5), duration=0.15)
    assert lidar.shape == (3, 5)
    scan = lidar.scan(room(), HERE)
    assert np.array_equal(scan.ring, np.repeat([2, 1, 0], 5))
    assert np.array_equal(scan.column, np.tile(np.arange(5), 3))
    assert np.allclose(scan.time, np.arange(15) * 0.01)
    angles = np.arctan2(scan.points[:5, 1], scan.points[:5, 0])
    assert np.allclose(angles, [0.5, 0.25, 0.0, -0.25, -0.5], atol=1e-6)
    assert Lidar.raster((1, 1), (1.0, 1.0)).directions.ravel().tolist() == [1.0, 0.0, 0.0]


@pytest.mark.parametrize("name", Lidar.NAMES)
def test_patterns_have_what_their_names_say(name):
    lidar = Lidar.of(name)
    beams = {"vlp-16": 16, "vlp-32c": 32, "hdl-32e": 32, "hdl-64e": 64}.get(name)
    assert lidar.shape[0] == (beams or int(name.partition("-")[2]))
    elevations = lidar.elevations[:, 0]
    assert (np.diff(elevations) > 0).all() and np.abs(elevations).max() < math.pi / 3
    assert 0 < lidar.min_range < lidar.max_range < 400
    assert np.allclose(np.linalg.norm(lidar.directions, axis=-1), 1.0)
    turns = np.unwrap(lidar.azimuths[0])
    step = 2 * math.pi / lidar.shape[1]
    assert np.allclose(np.diff(turns), -step)  # clockwise


def test_a_moving_sensor_measures_from_where_it_is():
    scene = room()
    lidar = Lidar.spinning([0.0], 400, rate=5.0)
    end = e3d.look_at((0.5, 0.1, -0.4), (1.5, 0.1, -1.4))
    scan = lidar.scan(scene, HERE, end_pose=end)
    share = scan.time / 0.2
    places = share[:, np.newaxis] * end[:3, 3]
    inside = np.abs(scan.world_points / (5.0, 2.0, 3.0)).max(axis=1)
    assert np.allclose(inside, 1.0, atol=1e-9)
    assert np.allclose(np.linalg.norm(scan.world_points - places, axis=1), scan.range, atol=1e-5)
    turned = -math.pi / 4 * share  # right about Y
    azimuth = np.arctan2(scan.points[:, 1].astype(float), scan.points[:, 0])
    way = scan.world_points - places
    heading = np.arctan2(-way[:, 0], -way[:, 2])
    apart = (heading - azimuth - turned + math.pi) % (2 * math.pi) - math.pi
    assert np.abs(apart).max() < 1e-5
    still = lidar.scan(scene, HERE, end_pose=HERE)
    assert np.array_equal(still.points, lidar.scan(scene, HERE).points)


def test_losses_are_asked_for_and_seeded():
    lidar, scene = Lidar.of("vlp-16"), room()
    whole = lidar.scan(scene, HERE)
    assert len(whole) == 16 * 1800
    lost = lidar.scan(scene, HERE, dropout=0.25, seed=5)
    assert abs(len(lost) / len(whole) - 0.75) < 0.01
    assert np.array_equal(lost.points, lidar.scan(scene, HERE, dropout=0.25, seed=5).points)
    assert len(lidar.scan(scene, HERE, dropout=0.25, seed=6)) != 0
    assert not np.array_equal(lost.column, lidar.scan(scene, HERE, dropout=0.25, seed=6).column)
    assert len(lidar.scan(scene, HERE, dropout=1.0)) == 0


def test_pictures_have_a_pixel_a_beam():
    scene = e3d.Scene()
    ball = scene.add(e3d.uv_sphere(1.0), translation=(0, 0, -4))
    scan = Lidar.raster((31, 21), (1.0, 0.8)).scan(scene, HERE)
    ranges, ids = scan.image(), scan.image("object_id")
    assert ranges.shape == (21, 31) and ranges[10, 15] == pytest.approx(3.0, abs=0.02)
    assert np.array_equal(ids == ball.id, ranges > 0) and ids[0, 0] == -1


def test_files_hold_the_points(tmp_path):
    scan = Lidar.of("vlp-16").scan(room(), HERE)
    for suffix in ("pcd", "ply", "bin", "npz"):
        scan.save(tmp_path / f"scan.{suffix}")
    kitti = np.fromfile(tmp_path / "scan.bin", "<f4").reshape(-1, 4)
    assert np.array_equal(kitti[:, :3], scan.points)
    assert np.array_equal(kitti[:, 3], scan.intensity)
    with np.load(tmp_path / "scan.npz") as arrays:
        assert np.array_equal(arrays["ring"], scan.ring) and len(arrays.files) == 12
    cloud = e3d.load_mesh(tmp_path / "scan.ply")
    assert np.array_equal(cloud.positions, scan.points)
    head, _, body = (tmp_path / "scan.pcd").read_bytes().partition(b"DATA binary\n")
    lines = dict(line.partition(" ")[::2] for line in head.decode().splitlines()[1:])
    kinds = [
        f"<{kind.lower()}{size}"
        for kind, size in zip(lines["TYPE"].split(), lines["SIZE"].split(), strict=True)
    ]
    rows = np.frombuffer(body, list(zip(lines["FIELDS"].split(), kinds, strict=True)))
    assert int(lines["POINTS"]) == len(rows) == len(scan)
    assert np.array_equal(rows["z"], scan.points[:, 2])
    assert np.array_equal(rows["normal_x"], scan.normal[:, 0])
    with pytest.raises(e3d.InvalidArgumentError, match="suffix of a point cloud"):
        scan.save(tmp_path / "scan.las")


def test_open3d_reads_the_clouds(tmp_path):
    o3d = pytest.importorskip("open3d", exc_type=ImportError)
    scan = Lidar.of("vlp-16").scan(room(), HERE)
    for suffix in ("pcd", "ply"):
        scan.save(tmp_path / f"scan.{suffix}")
        cloud = o3d.io.read_point_cloud(str(tmp_path / f"scan.{suffix}"))
        assert np.array_equal(np.asarray(cloud.points), scan.points.astype(float))
        assert np.allclose(np.asarray(cloud.normals), scan.normal)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: Lidar.of("vlp16"), "vlp-16"),
        (lambda: Lidar([0.0], [0.0, 1.0], times=[0.0, 1.0, 2.0]), "rings"),
        (lambda: Lidar([], [0.0]), "rings"),
        (lambda: Lidar([math.nan], [0.0]), "elevations"),
        (lambda: Lidar([0.0], [0.0], times=[-1.0]), "times"),
        (lambda: Lidar([0.0], [0.0], min_range=-1.0), "min_range"),
        (lambda: Lidar([0.0], [0.0], duration=0.0), "duration"),
        (lambda: Lidar.spinning([0.0], 0), "steps"),
        (lambda: Lidar.spinning([0.0], offsets=[[0.0]]), "offsets"),
        (lambda: Lidar.spinning([0.0, 0.1], offsets=[0.0, 0.1, 0.2]), "rings"),
        (lambda: Lidar.raster((0, 4), (1.0, 1.0)), "width"),
        (lambda: Lidar.raster((4, 4), (1.0, 0.0)), "fov"),
        (lambda: Lidar([0.0], [0.0]).scan(e3d.Scene(), np.diag([2, 2, 2, 1])), "scaled"),
        (lambda: Lidar([0.0], [0.0]).scan(e3d.Scene(), np.diag([-1, 1, 1, 1])), "mirrored"),
        (lambda: Lidar([0.0], [0.0]).scan(e3d.Scene(), HERE, dropout=1.5), "dropout"),
        (lambda: Lidar([0.0], [0.0]).scan("scene", HERE), "scene"),
    ],
)
def test_wrong_arguments_are_named(call, words):
    with pytest.raises(e3d.InvalidArgumentError, match=words):
        call()


def test_an_empty_scene_gives_an_empty_scan(tmp_path):
    scan = Lidar.of("os1-32").scan(e3d.Scene(), HERE)
    assert len(scan) == 0 and not scan.image().any()
    for suffix in ("pcd", "ply", "bin", "npz"):
        scan.save(tmp_path / f"scan.{suffix}")
    assert (tmp_path / "scan.bin").read_bytes() == b""


@pytest.mark.parametrize("elevations", [[-25.0, 3.0], [91.0], [[0.0], [-1.6]]])
def test_elevations_in_degrees_are_a_warning(elevations):
    with pytest.warns(e3d.errors.Engine3DWarning, match="elevations lie beyond straight up"):
        Lidar(elevations, [0.0, 0.1])


@pytest.mark.filterwarnings("error")
def test_elevations_up_to_straight_up_are_none():
    Lidar.raster((4, 5), (1.0, math.pi))
    Lidar.spinning([-math.pi / 2, math.pi / 2], 8)

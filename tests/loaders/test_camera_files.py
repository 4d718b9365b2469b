"""Cameras of calibrations: each format's model, its pixels, and what is refused."""

import json
import math
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.io.camera_files import camera_of_record, load_calibration

K = [300.0, 0.0, 319.5, 0.0, 310.0, 239.5, 0.0, 0.0, 1.0]


@pytest.mark.parametrize(
    ("said", "camera"),
    [
        (
            {"distortion_model": "plumb_bob", "K": K, "D": [-0.3, 0.1, 0.001, 0.002, 0.01]},
            e3d.BrownConradyCamera(300, 310, 320, 240, (-0.3, 0.1, 0.001, 0.002, 0.01)),
        ),
        (
            {"distortion_model": "rational_polynomial", "k": K, "d": [0.1] * 8},
            e3d.BrownConradyCamera(300, 310, 320, 240, [0.1] * 8),
        ),
        (
            {"distortion_model": "equidistant", "K": K, "D": [0.01, 0.02, 0.03, 0.04]},
            e3d.FisheyeCamera(300, 310, 320, 240, (0.01, 0.02, 0.03, 0.04)),
        ),
        (
            {"camera_model": "OPENCV_FISHEYE", "fl_x": 300, "cx": 320, "cy": 240, "k1": 0.1},
            e3d.FisheyeCamera(300, 300, 320, 240, (0.1, 0, 0, 0)),
        ),
        (
            {
                "camera_model": "OPENCV",
                "fl_x": 9,
                "fl_y": 8,
                "cx": 3,
                "cy": 2,
                "k2": 0.1,
                "p1": 0.2,
            },
            e3d.BrownConradyCamera(9, 8, 3, 2, (0, 0.1, 0.2, 0, 0)),
        ),
        (
            {"camera_model": "OPENCV", "fl_x": 9, "fl_y": 8, "cx": 3, "cy": 2},
            e3d.IntrinsicsCamera(9, 8, 3, 2),
        ),
        (
            {"camera_angle_x": 0.5 * math.pi, "w": 640, "h": 480},
            e3d.IntrinsicsCamera(320.00000000000006, 320.00000000000006, 320, 240),
        ),
        (
            {"camera_angle_x": 1.0, "fl_x": 9, "fl_y": 8, "cx": 3, "cy": 2, "w": 6, "h": 4},
            e3d.IntrinsicsCamera(9, 8, 3, 2),
        ),
        (
            {"is_fisheye": True, "fl_x": 9, "fl_y": 8, "cx": 3, "cy": 2, "k1": 0.1, "k4": 0.2},
            e3d.FisheyeCamera(9, 8, 3, 2, (0.1, 0, 0, 0.2)),
        ),
        ({"camera_model": "EQUIRECTANGULAR"}, e3d.EquirectangularCamera()),
        ({"model": "PINHOLE", "params": [9, 8, 3, 2]}, e3d.IntrinsicsCamera(9, 8, 3, 2)),
        (
            {"model": "SIMPLE_RADIAL", "params": [9, 3, 2, 0.1]},
            e3d.BrownConradyCamera(9, 9, 3, 2, (0.1, 0, 0, 0)),
        ),
        (
            {"model": "RADIAL_FISHEYE", "params": [9, 3, 2, 0.1, 0.2]},
            e3d.FisheyeCamera(9, 9, 3, 2, (0.1, 0.2, 0, 0)),
        ),
        (
            {"model": "FULL_OPENCV", "params": [9, 8, 3, 2, *[0.1] * 8]},
            e3d.BrownConradyCamera(9, 8, 3, 2, [0.1] * 8),
        ),
        (
            {"kind": "cylindrical camera", "xfov": 2.0, "zfar": None},
            e3d.CylindricalCamera(xfov=2.0, zfar=math.inf),
        ),
    ],
)
def test_each_model_is_read(said, camera, tmp_path):
    (tmp_path / "camera.json").write_text(json.dumps(said))
    found = e3d.load_camera(tmp_path / "camera.json")
    assert type(found) is type(camera)
    assert repr(vars(found)) == repr({**vars(camera), "version": found.version})


def test_colmaps_text_is_read():
    text = b"# Camera list\n# more\n\n3 OPENCV_FISHEYE 640 480 300 310 320 240 0.1 0.2 0.3 0.4\n"
    camera = e3d.load_camera(text)
    assert (camera.fx, camera.cy, camera.k) == (300, 240, (0.1, 0.2, 0.3, 0.4))


SAVED = b"""# from camera_calibration
image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [300., 0., 319.5, 0., 310., 239.5, 0., 0., 1.]
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [-0.3, 0.1, 0.001, 0.002, 0.01]}
"""
PRINTED = b"""header:
  frame_id: eye
height: 480
width: 640
distortion_model: plumb_bob
d: [-0.3, 0.1, 0.001, 0.002, 0.01]
k:
- 300.0
- 0.0
- 319.5
- 0.0
- 310.0
- 239.5
- 0.0
- 0.0
- 1.0
---
"""


@pytest.mark.parametrize("text", [SAVED, PRINTED])
def test_yaml_of_ros_is_read(text):
    pytest.importorskip("yaml")
    camera, size = load_calibration(text)
    found = (camera.fx, camera.fy, camera.cx, camera.cy, *camera.distortion)
    assert found == (300, 310, 320, 240, -0.3, 0.1, 0.001, 0.002, 0.01)
    assert size == (640, 480)


@pytest.mark.parametrize(
    "text",
    [
        SAVED.replace(b"rows: 1, ", b"rows: [1, "),
        SAVED.replace(b"data: [300.,", b"data: &a [*a, 300.,"),
        SAVED.replace(b"camera_matrix", b"camera_matrices"),
        SAVED.replace(b"camera_name: n", b"camera_name: !!python/object:os.system n"),
        SAVED + b"#" * 70_000,
        b"distortion_model: " + b"[" * 60_000,
        b"distortion_model: plumb_bob\nk: 2001-13-45\n",
        *(
            b"distortion_model: plumb_bob\nk: %s\n" % value
            for value in (b"!!bool x", b"!!int ''", b"!!float ''", b"!!timestamp x", b"&a [1, *a]")
        ),
        b"distortion_model: plumb_bob\na: &a [1, 1, 1]\nb: &b [*a, *a]\nk: [*b, *b]\n",
    ],
)
def test_damaged_yaml_is_refused(text):
    pytest.importorskip("yaml")
    with pytest.raises(e3d.FileFormatError):
        e3d.load_camera(text)


def test_yaml_without_its_package_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "yaml", None)
    with pytest.raises(e3d.FileFormatError, match="ROS in YAML needs .* pip install PyYAML"):
        e3d.load_camera(SAVED)


def test_nerfs_angle_needs_a_size():
    with pytest.raises(e3d.FileFormatError, match="camera_angle_x of NeRF counts with w and h"):
        e3d.load_camera(b'{"camera_angle_x": 0.69, "frames": []}')


@pytest.mark.parametrize(
    "said",
    [
        b"",
        b'{"camera_angle_x": 4, "w": 9, "h": 9}',
        b'{"camera_angle_x": "wide", "w": 9, "h": 9}',
        b"1 OPENCV 2",
        b"1 OPENCV 2 3 4 x",
        b"[1, 2]",
        b"{}",
        b'{"model": "OPENCV_FISHY", "params": []}',
        b'{"model": ["OPENCV"], "params": []}',
        b'{"model": "PINHOLE", "params": [1, 2]}',
        b'{"model": "PINHOLE", "params": "abc"}',
        b'{"model": "PINHOLE", "params": [0, 0, 0, 0]}',
        b'{"distortion_model": "equidistant", "K": [1, 2]}',
        b'{"distortion_model": "plumb_bob", "K": [1,0,0,0,1,0,0,0,1], "D": [1]}',
        b'{"distortion_model": "omni"}',
        b'{"camera_model": "OPENCV", "fl_x": "a"}',
        b'{"camera_model": "OPENCV"}',
        b'{"camera_model": "OPENCV", "fl_x": 1, "cx": 1, "cy": 1, "k4": 1}',
        b'{"kind": "fisheye camera"}',
        b'{"kind": "fisheye camera", "focal": 3}',
        b'{"kind": "point light"}',
        b"{nonsense",
    ],
)
def test_what_is_no_camera_is_refused(said):
    with pytest.raises(e3d.FileFormatError):
        e3d.load_camera(said)


def test_a_misspelt_model_is_answered():
    with pytest.raises(e3d.FileFormatError, match="did you mean OPENCV_FISHEYE"):
        e3d.load_camera(b'{"model": "OPENCV_FISHYE", "params": []}')


LENSES = (
    e3d.FisheyeCamera(150, 155, 318, 243, (-0.02, 0.004, -0.001, 0.0001), max_angle=1.9),
    e3d.BrownConradyCamera(350, 360, 320, 240, (-0.3, 0.1, 0.001, -0.002), zfar=math.inf),
    e3d.DoubleSphereCamera(200, 200, 320, 240, -0.2, 0.6, znear=0.01),
    e3d.EquirectangularCamera(xfov=2.0),
    e3d.CylindricalCamera(yfov=1.0),
)


@pytest.mark.parametrize("camera", LENSES)
def test_scene_files_keep_lenses(camera, tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.box())
    scene.add(camera, name="eye", translation=(0, 0, 3))
    scene.save(tmp_path / "scene.e3d.json")
    found = e3d.load_scene(tmp_path / "scene.e3d.json").find("eye").object
    assert repr(vars(found)) == repr({**vars(camera), "version": found.version})


def test_records_name_their_place():
    with pytest.raises(e3d.InvalidArgumentError, match="lens.*fl_x"):
        camera_of_record({"camera_model": "PINHOLE"}, "camera: lens")


def test_a_batch_draws_through_a_lens(tmp_path):
    from engine3d.apps.batch.cameras import camera_of, check_camera

    lens = {"kind": "fisheye camera", "fx": 20, "fy": 20, "cx": 32, "cy": 24}
    scene = e3d.Scene()
    scene.add(e3d.box(), translation=(0, 0, -3))
    said = check_camera({"position": [0, 0, 0], "target": [0, 0, -1], "lens": lens})
    camera, pose = camera_of(said, scene, (64, 48))
    assert isinstance(camera, e3d.FisheyeCamera)
    frame = e3d.render(scene, (camera, pose), size=(64, 48), look="plain", outputs=("object_id",))
    assert frame.object_id[24, 32] == 0
    for wrong in ({"lens": {"kind": "camera"}}, {"lens": lens, "yfov_degrees": 3}, {"lens": 3}):
        with pytest.raises(e3d.InvalidArgumentError):
            check_camera({"position": [0, 0, 0], **wrong})


def test_bop_has_no_lenses():
    from engine3d.apps.datasets.opencv_cameras import intrinsics_of

    with pytest.raises(e3d.InvalidArgumentError, match="FisheyeCamera has no matrix K"):
        intrinsics_of(LENSES[0], 640, 480)
    assert np.isfinite(intrinsics_of(e3d.PerspectiveCamera(), 640, 480)).all()

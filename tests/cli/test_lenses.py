"""``--camera-lens``: pictures through the lens of a calibration."""

import json

import numpy as np
import pytest
from cli.conftest import SMALL, pixels

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.io.camera_files import load_calibration

pytestmark = pytest.mark.usefixtures("no_screen")
LENS = {"kind": "brown-conrady camera", "fx": 40, "fy": 40, "cx": 24, "cy": 16}


def drawn(model, path, *options):
    assert main(["render", str(model), *SMALL, *options, "-o", str(path)]) == 0
    return pixels(path)


def test_a_lens_takes_the_place_of_the_pinhole(model, tmp_path):
    (tmp_path / "lens.json").write_text(json.dumps({**LENS, "distortion": [-0.3, 0, 0, 0]}))
    (tmp_path / "plain.json").write_text(
        json.dumps({"model": "PINHOLE", "params": [40, 40, 24, 16]})
    )
    bent = drawn(model, tmp_path / "a.png", "--camera-lens", str(tmp_path / "lens.json"))
    straight = drawn(model, tmp_path / "b.png", "--camera-lens", str(tmp_path / "plain.json"))
    assert bent.shape == straight.shape == (32, 48, 4)
    assert (bent != straight).any()
    assert np.abs(bent.astype(int) - straight).mean() < 60


def test_a_scenes_lens_is_looked_through(tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.box(), translation=(0, 0, -2))
    scene.add(e3d.FisheyeCamera(10, 10, 24, 16, max_angle=1.0))
    scene.save(tmp_path / "scene.e3d.json")
    picture = drawn(tmp_path / "scene.e3d.json", tmp_path / "a.png", "--camera-index", "0")
    assert not picture[0, 0, :3].any()  # outside of the image circle
    assert picture[16, 24, :3].any()


@pytest.mark.parametrize(
    ("text", "status", "said"),
    [
        ('{"model": "OPENCVV", "params": []}', 1, "did you mean OPENCV"),
        ("nonsense", 1, "CAMERA_ID"),
        ('{"kind": "orthographic camera", "ymag": 1}', 2, "holds no lens"),
    ],
)
def test_what_is_no_lens_is_named(model, tmp_path, capsys, text, status, said):
    (tmp_path / "lens.json").write_text(text)
    options = ["--camera-lens", str(tmp_path / "lens.json"), "-o", str(tmp_path / "a.png")]
    assert main(["render", str(model), *SMALL, *options]) == status
    assert said in capsys.readouterr().err


def test_a_lens_and_parallel_rays_do_not_go_together(model, tmp_path, capsys):
    (tmp_path / "lens.json").write_text(json.dumps(LENS))
    options = ["--camera-lens", str(tmp_path / "lens.json"), "-o", str(tmp_path / "a.png")]
    assert main(["render", str(model), *SMALL, *options, "--camera-orthographic"]) == 2
    assert "--camera-lens and --camera-orthographic" in capsys.readouterr().err


@pytest.mark.parametrize(
    "record",
    [
        {"distortion_model": "plumb_bob", "K": [40, 0, 24, 0, 40, 16, 0, 0, 1], "D": []}
        | {"width": 52, "height": 36},
        {"camera_model": "OPENCV", "fl_x": 40, "cx": 24, "cy": 16, "k1": 0.1, "w": 52, "h": 36},
        {"model": "PINHOLE", "params": [40, 40, 24, 16], "width": 52, "height": 36},
        "1 PINHOLE 52 36 40 40 24 16",
    ],
)
def test_a_picture_has_the_size_of_its_calibration(model, tmp_path, record):
    path = tmp_path / "lens.txt"
    path.write_text(record if isinstance(record, str) else json.dumps(record))
    for options, shape in ([], (36, 52, 4)), (SMALL, (32, 48, 4)):
        options = [*options, "--camera-lens", str(path), "-o", str(tmp_path / "a.png")]
        assert main(["render", str(model), *options]) == 0
        assert pixels(tmp_path / "a.png").shape == shape


@pytest.mark.parametrize("width", [None, "640", 0, -3, 2.5, float("inf"), [640], True])
def test_what_is_no_size_in_a_calibration_does_not_count(model, tmp_path, width):
    path = tmp_path / "lens.json"
    record = {"model": "PINHOLE", "params": [40, 40, 24, 16], "width": width, "height": 36}
    path.write_text(json.dumps(record).replace("Infinity", "1e999"))
    assert load_calibration(path)[1] == ((1, 36) if width is True else None)


@pytest.mark.parametrize("ending", ["svg", "pdf"])
def test_lines_are_not_drawn_through_a_lens(model, tmp_path, capsys, ending):
    (tmp_path / "lens.json").write_text(json.dumps(LENS))
    options = ["--camera-lens", str(tmp_path / "lens.json"), "-o", str(tmp_path / f"a.{ending}")]
    assert main(["render", str(model), *options]) == 1
    assert "not through a BrownConradyCamera" in capsys.readouterr().err
    assert not (tmp_path / f"a.{ending}").exists()

"""``--joint`` and ``--shapes``: robots of URDF in all commands that read models."""

import json
import math

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")

ARM = """<robot name="arm">
<link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual>
  <collision><geometry><sphere radius="2"/></geometry></collision></link>
<link name="upper"><visual><origin xyz="2 0 0"/>
  <geometry><box size="4 .5 .5"/></geometry></visual></link>
<joint name="elbow" type="revolute"><parent link="base"/><child link="upper"/>
  <axis xyz="0 0 1"/><limit lower="-1" upper="2"/></joint>
</robot>
"""


@pytest.fixture
def arm(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(ARM)
    return str(path)


def drawn(arm, *options):
    assert main(["render", arm, "-o", "a.png", "--size", "64x48", *options]) == 0
    return np.asarray(Image.open("a.png"))


def test_joints_move_in_pictures(arm):
    rest = drawn(arm)
    bent = drawn(arm, "--joint", "elbow=1.5707963267948966")
    assert (rest != bent).any()
    np.testing.assert_array_equal(drawn(arm, "--joint", "elbow=90deg"), bent)
    np.testing.assert_array_equal(drawn(arm, "--joint", "elbow= 90 deg"), bent)
    assert (drawn(arm, "--shapes", "collision") != rest).any()


def test_info_lists_joints(arm, capsys):
    assert main(["info", arm]) == 0
    assert "joint elbow: revolute, -1 to 2 rad, base -> upper\n" in capsys.readouterr().out
    assert main(["info", arm, "--json", "--joint", "elbow=90deg"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["joints"] == [
        {
            "name": "elbow",
            "type": "revolute",
            "parent": "base",
            "child": "upper",
            "limits": [-1.0, 2.0],
            "mimic": None,
        }
    ]
    assert (report["counts"]["links"], report["counts"]["joints"]) == (2, 1)
    assert report["bounds"][1][1] == pytest.approx(4.0)


def test_convert_and_sheet_take_joints(arm, tmp_path):
    assert main(["convert", arm, "a.obj", "--joint", "elbow=90deg"]) == 0
    assert e3d.load_mesh("a.obj").bounds[1][1] == pytest.approx(4.0)
    assert main(["convert", arm, "a.glb", "--joint", "elbow=90deg", "--shapes", "both"]) == 0
    scene = e3d.load_scene("a.glb")
    assert scene.bounds[1].tolist() == pytest.approx([2.0, 4.0, 2.0])
    assert scene.find("upper").euler[2] == pytest.approx(math.pi / 2)
    options = ("-o", "a.png", "--size", "640x480", "--joint", "elbow=90deg", "--json")
    assert main(["sheet", arm, *options]) == 0
    bounds = json.loads((tmp_path / "a.json").read_text())["models"][0]["bounds"]["high"]
    assert bounds[1] == pytest.approx(4.0)


@pytest.mark.parametrize(
    "options, told",
    [
        (["--joint", "elbw=1"], "no joint 'elbw': did you mean elbow? (joints that move: elbow)"),
        (["--joint", "elbow"], "'elbow' is not NAME=VALUE, such as elbow=0.4"),
        (["--joint", "=1"], "is not NAME=VALUE"),
        (["--joint", "elbow=x"], "'x' is not a number"),
        (["--joint", "elbow=1grad"], "'1grad' is not a number"),
        (["--joint", "elbow=1,2"], "takes one number"),
        (["--shapes", "none"], "'none' is not one of visual, collision, both"),
    ],
)
def test_wrong_joints_are_named(arm, options, told, capsys):
    try:
        assert main(["render", arm, "-o", "a.png", *options]) != 0
    except SystemExit as end:
        assert end.code == 2
    assert told in capsys.readouterr().err


@pytest.mark.parametrize("unit", ["deg", "°", "rad"])
@pytest.mark.parametrize(
    ("kind", "size", "lengths"), [("prismatic", 1, 1), ("planar", 3, 2), ("floating", 6, 3)]
)
def test_angles_move_nothing_along(kind, size, lengths, unit, tmp_path, capsys):
    robot = tmp_path / "robot.urdf"
    robot.write_text(ARM.replace("revolute", kind))
    for place in range(size):
        value = ["0"] * size
        value[place] = f"1{unit}"
        is_wrong = place < lengths
        assert main(["info", str(robot), "--joint", f"elbow={','.join(value)}"]) == int(is_wrong)
        told = capsys.readouterr().err
        assert (f"joint 'elbow' is {kind}: it moves by metres, not by" in told) == is_wrong


def test_limits_are_warned_of(arm, capsys):
    assert main(["info", arm, "--joint", "elbow=3"]) == 0
    drawn(arm, "--joint", "elbow=3")
    told = capsys.readouterr().err
    assert "joint 'elbow': 3 rad is beyond its limits -1 to 2; it stands at 2" in told


def test_joints_need_a_robot(tmp_path, capsys):
    e3d.save_mesh(e3d.box(), tmp_path / "box.obj")
    assert main(["render", "box.obj", "-o", "a.png", "--joint", "elbow=1"]) == 1
    assert "joints are options of robots" in capsys.readouterr().err
    assert main(["render", "--scene", "spheres", "-o", "a.png", "--joint", "elbow=1"]) != 0
    assert "--joint needs a MODEL" in capsys.readouterr().err

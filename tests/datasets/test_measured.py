"""Data sets of stereo pairs and optical flow, and files of other formats than NumPy's."""

import json

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.datasets import BopWriter, CocoWriter, FolderWriter, Sample, write_dataset
from engine3d.sensors import Moment, StereoCamera

SIZE = 64, 48
LENS = e3d.PerspectiveCamera(0.8, znear=0.2, zfar=30.0)
POSE = e3d.look_at((0.4, 0.8, 4.0), (0, 0, 0))


class Moving:
    """A scene at a time, with ways to the times around it."""

    def __init__(self):
        self.scene = e3d.Scene(background=(20, 40, 60), ambient=(0.7, 0.7, 0.7))
        self.scene.add(e3d.plane(6.0), translation=(0, -0.7, 0), name="floor")
        self.box = self.scene.add(e3d.box(0.9), name="box")

    def at(self, time):
        self.box.translation = (0.5 * time, 0.1 * time, 0.2)
        self.box.rotation = e3d.linalg.euler_to_quaternion((0.0, 0.4 * time, 0.0))
        return LENS, e3d.look_at((0.4 + 0.1 * time, 0.8, 4.0), (0, 0, 0))


def sample(renderer, writer, **moves):
    moving = Moving()
    camera = moving.at(0.0)
    frame = renderer.render(moving.scene, camera, outputs=writer.outputs)
    moves = moves or {"to_next": lambda: moving.at(1.0), "to_previous": lambda: moving.at(-1.0)}
    return Sample("p", 0, frame, moving.scene, *camera, renderer, **moves)


def moment(renderer, time):
    moving = Moving()
    frame = renderer.render(
        moving.scene, moving.at(time), outputs=("color", "depth", *Moment.OUTPUTS)
    )
    return Moment(frame, moving.scene)


@pytest.fixture(scope="module")
def renderer():
    with e3d.Renderer(SIZE, samples=4, threads=1) as renderer:
        yield renderer


def color(path):
    with Image.open(path) as image:
        return np.asarray(image)


def test_flow_both_ways(renderer, tmp_path):
    names = ["next_color", "forward_flow.flo", "forward_visible", "backward_flow", "previous_color"]
    writer = FolderWriter(["color", *names])
    paths = write_dataset(tmp_path, writer, [sample(renderer, writer)])
    assert {"forward_flow/p.flo", "forward_visible/p.png", "backward_flow/p.npy"} <= set(paths)
    before, now, after = (moment(renderer, time) for time in (-1.0, 0.0, 1.0))
    forward, backward = now.flow_to(after), now.flow_to(before)
    read = np.fromfile(tmp_path / "forward_flow" / "p.flo", "<f4")[3:].reshape(*SIZE[::-1], 2)
    assert np.array_equal(read[forward.known], forward.vectors[forward.known])
    assert (read[~forward.known] > 1e9).all() and not forward.known.all()
    assert np.array_equal(color(tmp_path / "forward_visible" / "p.png") > 0, forward.visible)
    read = np.load(tmp_path / "backward_flow" / "p.npy")
    assert np.array_equal(read[backward.known], backward.vectors[backward.known])
    assert np.isnan(read[~backward.known]).all()
    assert np.array_equal(color(tmp_path / "next_color" / "p.png"), after.frame.color)
    assert np.array_equal(color(tmp_path / "previous_color" / "p.png"), before.frame.color)


def test_the_pictures_own_place_is_told_not_the_next_ones(renderer, tmp_path):
    writer = FolderWriter(["forward_flow"])
    write_dataset(tmp_path, writer, [sample(renderer, writer)])
    told = json.loads((tmp_path / "pictures.jsonl").read_text())
    place = np.array(told["things"][1]["world_from_object"])[:3, 3]
    assert np.allclose(place, (0, 0, 0.2))


def test_stereo(renderer, tmp_path):
    names = ["right_color", "disparity.png", "disparity_visible", "right_disparity.pfm"]
    writer = CocoWriter(outputs=["color", *names], baseline=0.2)
    write_dataset(tmp_path, writer, [sample(renderer, writer)])
    moving = Moving()
    pose = moving.at(0.0)[1]
    pair = StereoCamera(LENS, 0.2).render(renderer, moving.scene, pose, outputs=("color",))
    assert np.array_equal(color(tmp_path / "right_color" / "p.png"), pair.right.color)
    codes = color(tmp_path / "disparity" / "p.png")
    assert np.array_equal(codes > 0, pair.left_disparity > 0)
    assert np.abs(codes / 256 - pair.left_disparity).max() <= 1 / 512 + 1e-6
    assert np.array_equal(color(tmp_path / "disparity_visible" / "p.png") > 0, pair.left_visible)
    assert "0.2 to the right" in (tmp_path / "README.txt").read_text()
    assert not (tmp_path / "color").exists()  # COCO has its own folder


def test_the_readme_tells_units_and_marks(renderer, tmp_path):
    writer = FolderWriter(["color", "depth", "range.exr", "disparity.pfm"], baseline=0.1)
    write_dataset(tmp_path, writer, [sample(renderer, writer)])
    lines = (tmp_path / "README.txt").read_text().splitlines()
    by_name = {line.partition(" ")[0]: line for line in lines}
    assert "0 = background" in by_name["depth"] and "NaN" not in by_name["depth"]
    assert "NaN where not valid" in by_name["range"]
    assert "Infinite where not valid" in by_name["disparity"] and "pixels" in by_name["disparity"]
    assert "Lengths are in units of the scene" in lines[1]


def test_bops_readme_and_symmetries(renderer, tmp_path):
    turn = np.diag([-1.0, 1.0, -1.0, 1.0]).ravel().tolist()
    axis = {"axis": [0, 1, 0], "offset": [0, 0, 0]}
    told = {"box": {"symmetries_discrete": [turn]}, "floor": {"symmetries_continuous": [axis]}}
    writer = BopWriter(symmetries=told)
    write_dataset(tmp_path, writer, [sample(renderer, writer)])
    info = json.loads((tmp_path / "models_eval" / "models_info.json").read_text())
    assert info["1"]["symmetries_discrete"] == [turn] and info["1"]["diameter"] > 0
    assert info["2"]["symmetries_continuous"] == [axis]
    readme = (tmp_path / "README.txt").read_text()
    assert "millimetres" in readme and "steps of\n1.0 mm" in readme


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ([], "symmetries must be an object"),
        ({"box": []}, "symmetries of 'box' must be an object"),
        ({"box": {"discrete": []}}, "symmetries_discrete"),
        ({"box": {"symmetries_discrete": 3}}, "must be a list"),
        ({"box": {"symmetries_discrete": [[1, 2, 3]]}}, "16 numbers"),
        ({"box": {"symmetries_discrete": [(2 * np.eye(4)).ravel().tolist()]}}, "rotations"),
        ({"box": {"symmetries_continuous": [{"axis": [0, 0, 1]}]}}, "an axis and an offset"),
        ({"box": {"symmetries_continuous": [{"axis": [0, 0, 0], "offset": [0, 0, 0]}]}}, "zero"),
        ({"box": {"symmetries_continuous": [{"axis": [0, 1], "offset": [0, 0, 0]}]}}, "3 numbers"),
    ],
)
def test_symmetries_are_checked(told, words):
    with pytest.raises(e3d.InvalidArgumentError, match=words):
        BopWriter(symmetries=told)


@pytest.mark.parametrize(
    ("outputs", "baseline", "words"),
    [
        (["disparity"], None, "baseline"),
        (["right_color"], None, "baseline"),
        (["forward_flow.pmf"], None, "format of forward_flow"),
        (["depth.flo"], None, "2 channels"),
        (["object_id.png"], None, "any array"),
        (["color.jpg"], None, "format of color"),
        (["depth", "depth.pfm"], None, "once"),
        (["flow"], None, "outputs must be one of"),
        ([], None, "at least one"),
        ("color", None, "names of outputs"),
        (["disparity"], -1.0, "baseline"),
    ],
)
def test_outputs_are_checked_before_anything_is_drawn(outputs, baseline, words):
    with pytest.raises(e3d.InvalidArgumentError, match=words):
        FolderWriter(outputs, baseline=baseline)


def test_flow_needs_a_way_to_the_other_moment(renderer, tmp_path):
    writer = FolderWriter(["backward_flow"])
    with pytest.raises(e3d.InvalidArgumentError, match="need the previous moment"):
        writer.describe(sample(renderer, writer, to_next=lambda: None))


def test_a_script_tells_what_comes_next(tmp_path):
    from engine3d.batch import Task, run

    (tmp_path / "falling.py").write_text(
        "import engine3d as e3d\n"
        "def build(scene, generator, time=0):\n"
        "    ball = scene.add(e3d.uv_sphere(0.5), name='ball')\n"
        "    def at(time):\n"
        "        ball.translation = (0, 0.2 - 0.1 * time, 0)\n"
        "    at(time)\n"
        "    camera = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 3), (0, 0, 0))\n"
        "    return {'camera': camera, 'next': lambda: at(time + 1)}\n"
    )
    task = Task("a", script="falling.py", folder=str(tmp_path), size=(40, 30))
    writer = FolderWriter(["forward_flow", "forward_visible"])
    summary = run([task], tmp_path / "out", writer=writer, jobs=1)
    assert not summary.failures
    flow = np.load(tmp_path / "out" / "forward_flow" / "a.npy")
    moved = flow[~np.isnan(flow[..., 0])]
    assert len(moved) and (moved[:, 1] > 0.5).all() and np.abs(moved[:, 0]).max() < 0.2
    assert run([task], tmp_path / "out", writer=writer, jobs=1, resume=True).done_before == 1
    summary = run([task], tmp_path / "back", writer=FolderWriter(["backward_flow"]), jobs=1)
    assert "'previous' of what a script returns" in str(summary.failures)
    (tmp_path / "falling.py").write_text("def build(scene, generator):\n    return {'next': 3}\n")
    summary = run([task], tmp_path / "wrong", writer=writer, jobs=1)
    assert "next must be a function" in str(summary.failures)

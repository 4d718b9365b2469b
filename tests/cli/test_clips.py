"""Animations, cameras and variants of model files, as options choose them."""

import numpy as np
import pytest
from motion.moving_model import flag
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")
# On the ground of the look "studio" lies a shadow, as fine as what is shown is large.
SMALL = ("--size", "48x48", "--camera-index", "0", "--look", "plain")


@pytest.fixture
def moving(tmp_path):
    return flag(tmp_path / "flag.gltf")


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"))


def rendered(model, *arguments, size=SMALL):
    assert main(["render", str(model), *size, *arguments, "-o", "out.png"]) == 0
    return pixels("out.png")


def box(picture):
    """Rows and columns that show something: first and last of each."""
    shows = (abs(picture.astype(int) - picture[0, 0]) > 40).any(axis=2)  # some files are lossy
    rows, columns = np.flatnonzero(shows.any(axis=1)), np.flatnonzero(shows.any(axis=0))
    return rows[0], rows[-1], columns[0], columns[-1]


def test_the_model_as_a_scene(moving):
    scene = e3d.load_scene(moving)
    assert list(scene.animations) == ["turn", "rise"]
    assert np.allclose(scene.bounds, [(-0.25, 0, 0), (0.25, 2, 0)])
    player = e3d.AnimationPlayer(scene)
    player.loop = "once"
    player.play("turn")
    player.seek(2.0)
    assert np.allclose(scene.bounds, [(-1, 0, 0), (0.25, 1.25, 0)], atol=1e-6)


def test_a_time_of_an_animation(moving):
    rest = rendered(moving)
    top, _, left, _ = box(rest)
    for arguments in (
        ["--animation-time", "2"],
        ["--animation-time", "9"],
        ["--animation-index", "0", "--animation-time", "2"],
    ):
        turned = box(rendered(moving, *arguments))
        assert turned[0] > top and turned[2] < left
    assert (rendered(moving, "--animation-index", "0") == rest).all()
    risen = box(rendered(moving, "--animation-index", "1", "--animation-time", "0.5"))
    assert risen[0] < top
    both = box(rendered(moving, "--animation-index", "-1", "--animation-time", "0.5"))
    assert both[2] < left and both[0] < top


def test_cameras_of_the_file(moving):
    front = box(rendered(moving))
    assert front[1] - front[0] > front[3] - front[2]
    rolled = box(rendered(moving, size=(*SMALL, "--camera-index", "1")))
    assert rolled[1] - rolled[0] < rolled[3] - rolled[2]
    # Two units high of the four that it shows.
    assert 22 <= rolled[3] - rolled[2] + 1 <= 26
    free = rendered(moving, size=("--size", "48x48", "--camera-index", "-1"))
    usual = rendered(moving, size=("--size", "48x48"))
    assert (free == usual).all()


def frames(path):
    with Image.open(path) as image:
        count = image.n_frames
        shown = []
        for number in range(count):
            image.seek(number)
            shown.append(np.asarray(image.convert("RGB")))
    return shown


@pytest.mark.parametrize("name", ("a.webp", "a.gif", "a.apng"))
def test_animations_to_a_file(moving, name):
    assert main(["render", str(moving), *SMALL, "--animation", "4", "-o", name]) == 0
    shown = frames(name)
    assert len(shown) == 4
    lefts = [box(frame)[2] for frame in shown]
    assert lefts == sorted(lefts, reverse=True) and lefts[-1] < lefts[0]


def test_turntables_play_animations_that_are_asked_for(moving):
    assert main(["render", str(moving), *SMALL, "--turntable", "2", "-o", "a%d.png"]) == 0
    assert (
        main(
            [
                "render",
                str(moving),
                *SMALL,
                "--turntable",
                "2",
                "--animation-index",
                "1",
                "-o",
                "b%d.png",
            ]
        )
        == 0
    )
    assert (pixels("a0.png") == pixels("b0.png")).all()
    assert (pixels("a1.png") != pixels("b1.png")).any()


def test_run_plays_into_a_file(moving):
    arguments = ["--headless", "--frames", "3", "-o", "r%d.png", "--animation-index", "1"]
    assert main(["run", str(moving), *SMALL, *arguments]) == 0
    tops = [box(pixels(f"r{k}.png"))[0] for k in range(3)]
    assert tops[0] > tops[1]


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    (
        (["--animation-index", "2"], 2, "flag.gltf has no animation 2 (the last is 1)"),
        (["--animation-index", "-2"], 2, "'-2' is not a whole number of at least -1"),
        (["--animation-time", "x"], 2, "'x' is not a number"),
        (["--camera-index", "2"], 2, "flag.gltf has no camera 2 (the last is 1)"),
        (["--variant", "red"], 1, "no variant 'red': the file has none"),
        (["--turntable", "2", "--animation", "3"], 2, "need the same N"),
    ),
)
def test_what_is_not_there_is_told(moving, capsys, arguments, status, message):
    name = "a.gif" if "--turntable" in arguments else "a.png"
    assert main(["render", str(moving), *SMALL, *arguments, "-o", name]) == status
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1


def test_models_without_animations(model, capsys):
    assert main(["render", str(model), "--animation", "3", "-o", "a.gif"]) == 2
    assert "has no animation" in capsys.readouterr().err
    assert main(["render", str(model), "--animation-time", "1", "-o", "a.png"]) == 2
    assert "has no animation" in capsys.readouterr().err
    assert main(["render", "--scene", "cube", "--animation-index", "0", "-o", "a.png"]) == 2
    assert "--animation-index needs a MODEL" in capsys.readouterr().err

"""Gradients behind, and fog between things, on the command line."""

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main

SMALL = ["--size", "48x36", "--no-texture"]


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("backdrops") / "ball.obj"
    e3d.save_mesh(e3d.icosphere(1.0, 2), path)
    return path


def picture(model, *options):
    path = model.with_name("out.png")
    assert main(["render", str(model), *SMALL, *options, "-o", str(path)]) == 0
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_a_gradient_goes_from_the_top_to_the_bottom(model):
    gradient = ["--background-gradient", "#ff0000", "0,0,1"]
    corners = picture(model, "--look", "plain", *gradient)[[0, -1], 0]
    assert (abs(corners - [(255, 0, 0), (0, 0, 255)]) <= 8).all()


@pytest.mark.parametrize("look", ["plain", "studio"])
def test_fog_hides_what_is_far_in_the_colour_of_the_background(model, look):
    plain = ["--look", look, "--background-color", "#204060", "--antialiasing", "none"]
    clear = picture(model, *plain)
    for fog in (["--fog", "0.001,0.002"], ["--fog-density", "100"]):
        hidden = picture(model, *plain, *fog)
        assert (hidden[18, 24] == (0x20, 0x40, 0x60)).all() and (
            clear[18, 24] != hidden[18, 24]
        ).any()
    assert (picture(model, *plain, "--fog", "100,200") == clear).all()
    red = picture(model, *plain, "--fog", "0.001,0.002", "--fog-color", "200,40,40")
    assert (red[18, 24] == (200, 40, 40)).all() and (red[0, 0] == (0x20, 0x40, 0x60)).all()


def test_fog_takes_the_middle_of_a_gradient(model):
    gradient = ["--background-gradient", "#c00000", "#400000", "--fog", "0.001,0.002"]
    assert (picture(model, *gradient, "--look", "plain")[18, 24] == (128, 0, 0)).all()


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--fog", "2,2"], "NEAR less than FAR"),
        (["--fog", "1,2", "--fog-density", "1"], "do not go together"),
        (["--fog-color", "red"], "--fog-color goes with"),
        (["--fog-density", "-1"], "zero or more"),
        (["--background-gradient", "red"], "expected 2 arguments"),
        (["--background-gradient", "red", "blue", "--background-color", "red"], "--background-col"),
        (["--background-gradient", "red", "blue", "--no-background"], "--no-background"),
    ],
)
def test_what_is_no_value(capsys, model, options, told):
    assert main(["render", str(model), *options, "-o", str(model.with_name("no.png"))]) == 2
    assert told in capsys.readouterr().err

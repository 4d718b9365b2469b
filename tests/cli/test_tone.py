"""Exposure, tone mapping and glow on the command line."""

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main

SMALL = ["--look", "plain", "--size", "64x36", "--exposure", "1"]


def picture(tmp_path, *options):
    path, model = tmp_path / "out.png", tmp_path / "ball.obj"
    e3d.save_mesh(e3d.icosphere(1.0, 3), model)
    assert main(["render", str(model), *SMALL, *options, "-o", str(path)]) == 0
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_they_change_the_picture(tmp_path):
    plain = picture(tmp_path)
    assert (picture(tmp_path, "--exposure", "0") <= plain).all()
    assert (picture(tmp_path, "--tone-mapping", "none") == plain).all()
    mapped = [picture(tmp_path, "--tone-mapping", name) for name in ("neutral", "aces", "agx")]
    for number, one in enumerate(mapped):
        assert (one[0, 0] == plain[0, 0]).all()  # the background
        assert all((one != other).any() for other in (plain, *mapped[:number]))
    glowing = picture(tmp_path, "--bloom", "2")
    assert (glowing >= plain).all() and (glowing > plain).any()


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--tone-mapping", "filmic"], "is not one of none, neutral, aces, agx"),
        (["--exposure", "65"], "is not a number from -64 to 64"),
        (["--bloom", "-1"], "from 0 to 100"),
        (["--bloom", "101"], "from 0 to 100"),
    ],
)
def test_what_is_no_value(capsys, tmp_path, options, told):
    arguments = ["render", "ball.obj", *SMALL, *options, "-o", str(tmp_path / "out.png")]
    assert main(arguments) == 2
    assert told in capsys.readouterr().err

"""Environments on the command line."""

import numpy as np
import pytest
from loaders.seeds import HDR
from PIL import Image

from engine3d.apps.cli import main

SMALL = ["--scene", "cube", "--size", "64x36"]


def picture(tmp_path, *options):
    path = tmp_path / "out.png"
    assert main(["render", *SMALL, *options, "-o", str(path)]) == 0
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_a_built_in_environment_behind_the_scene(tmp_path):
    sky = picture(tmp_path, "--environment", "sky", "--background", "environment")
    assert sky[0, 0, 2] > sky[0, 0, 0] + 30  # blue above
    turned = ["--environment-rotation", "-90", "--background-blur", "0.5"]
    other = picture(tmp_path, "--environment", "sky", "--background", "environment", *turned)
    assert (other != sky).any()
    dark = ["--environment-intensity", "0"]
    assert (
        picture(tmp_path, "--environment", "sky", "--background", "environment", *dark)[0, 0] == 0
    ).all()


def test_a_file(tmp_path):
    path = tmp_path / "light.hdr"
    path.write_bytes(HDR)
    shown = picture(tmp_path, "--environment", str(path), "--background", "environment")
    plain = picture(tmp_path, "--environment", str(path))
    assert (shown[0, 0] != plain[0, 0]).any()
    assert (picture(tmp_path)[0, 0] == plain[0, 0]).all()


def test_the_studio_if_no_other_is_named(tmp_path):
    studio = picture(tmp_path, "--environment", "studio", "--background", "environment")
    assert (picture(tmp_path, "--background", "environment") == studio).all()


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--environment", "none", "--background", "environment"], "does not go with"),
        (["--background", "environment", "--background-color", "red"], "does not go with"),
        (["--background", "environment", "--no-background"], "does not go with"),
        (["--background", "sky"], "is not one of environment"),
        (["--background-blur", "2"], "from 0 to 1"),
        (["--environment-intensity", "-1"], "zero or more"),
        (["--environment-rotation", "x"], "not a number"),
    ],
)
def test_what_does_not_go_together(capsys, tmp_path, options, told):
    arguments = ["render", *SMALL, *options, "-o", str(tmp_path / "out.png")]
    try:
        status = main(arguments)
    except SystemExit as error:
        status = error.code
    assert status == 2
    assert told in capsys.readouterr().err


def test_no_such_file(capsys, tmp_path):
    arguments = ["render", *SMALL, "--environment", "mars", "-o", str(tmp_path / "out.png")]
    assert main(arguments) == 1
    assert (
        capsys.readouterr().err == "engine3d: error: mars: cannot read: No such file or directory\n"
    )

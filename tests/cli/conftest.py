"""A model and a folder of their own for the tests of commands, and how these begin and look."""

import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

SMALL = ("--size", "48x32")

OBJ = """o square
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
"""


@pytest.fixture
def model(tmp_path):
    path = tmp_path / "square.obj"
    path.write_text(OBJ)
    return path


@pytest.fixture
def no_screen(monkeypatch, tmp_path):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        monkeypatch.delenv(name, raising=False)
    if not sys.platform.startswith("linux"):  # others have a screen, whatever these say
        monkeypatch.setenv("SDL_VIDEODRIVER", "none")
    monkeypatch.chdir(tmp_path)


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"))


def start(*arguments, **options):
    command = [sys.executable, "-m", "engine3d", *map(str, arguments)]
    return subprocess.Popen(command, stdout=-1, stderr=-1, **options)

"""A folder with a model, a script and what makes manifests of them."""

import json

import pytest

OBJ = "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n"

SCRIPT = '''"""A script of tests."""
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np

import engine3d as e3d
from engine3d.batch import load_mesh
from engine3d.datasets import random_camera, random_pose

HERE = Path(__file__).parent
KILL = getattr(signal, "SIGKILL", signal.SIGTERM)  # Windows ends processes otherwise


def build(scene, generator, count=3):
    for number in range(count):
        scene.add(e3d.box(0.5), pose=random_pose(generator, (-1, -1, -1), (1, 1, 1)), name="box")
    return {"camera": random_camera(generator.fork("camera"), scene)}


def change(scene, generator):
    mesh = load_mesh(HERE / "model.obj")
    scene.add(mesh)
    mesh.positions = mesh.positions * np.float32(generator.uniform(0.5, 1.0))


def beside(scene, generator):
    scene.add(e3d.box())
    return {"files": {"points.npy": np.arange(3), "said": {"seed": 1}, "words": "text"}}


def fail(scene, generator):
    raise ValueError("no such\\nthing")


def say(scene, generator):
    print("a script prints this")
    scene.add(e3d.box())


def returned(scene, generator, value=3):
    return value


def die_once(scene, generator):
    build(scene, generator)
    mark = HERE / "died"
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), KILL)


def die(scene, generator):
    os.kill(os.getpid(), KILL)


def sleep(scene, generator):
    """Sleep, and let a process of its own sleep too."""
    other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"])
    (HERE / f"other{other.pid}").touch()
    other.wait()


def wait(scene, generator):
    (HERE / f"waiting{os.getpid()}").touch()
    while True:
        pass
'''


@pytest.fixture
def place(tmp_path):
    (tmp_path / "model.obj").write_text(OBJ)
    (tmp_path / "script.py").write_text(SCRIPT)
    return tmp_path


@pytest.fixture
def manifest(place):
    """Write a manifest of some tasks, and return its path."""

    def write(*tasks, **more):
        said = {"version": 1, "defaults": {"size": [24, 16]}, "tasks": list(tasks), **more}
        path = place / "manifest.json"
        path.write_text(json.dumps(said))
        return path

    return write

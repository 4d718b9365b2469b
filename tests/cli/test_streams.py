"""Standard input and output: models and pictures through pipes, streams that close or are full."""

import io
import json
import os
import shlex
import subprocess
import sys
import time

import numpy as np
import pytest
from cli.conftest import SMALL, pixels, start
from missing_here import STOPPABLE, STOPPED, needs_full_device, stop
from patience import HUNG
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")


def test_dash_writes_png_to_standard_output(model):
    process = start("render", model, *SMALL, "-o", "-")
    out, err = process.communicate()
    assert (process.returncode, err) == (0, b"")
    with Image.open(io.BytesIO(out)) as image:
        assert (image.format, image.size) == ("PNG", (48, 32))


def give(monkeypatch, data):
    """Let ``data`` be what comes on standard input."""
    stream = io.TextIOWrapper(io.BytesIO(data))
    stream.buffer.name = "<stdin>"
    monkeypatch.setattr(sys, "stdin", stream)


def test_a_model_on_standard_input(model, tmp_path, capsys, monkeypatch):
    assert main(["convert", str(model), "square.stl"]) == 0
    capsys.readouterr()
    for name in ("square.obj", "square.stl"):
        data = (tmp_path / name).read_bytes()
        give(monkeypatch, data)
        assert main(["info", "-", "--json"]) == 0
        report = json.loads(capsys.readouterr().out)
        assert (report["file"], report["format"]) == ("<stdin>", name[-3:])
        assert report["counts"]["triangles"] == 2
        give(monkeypatch, data)
        assert main(["render", "-", *SMALL, "-o", "piped.png"]) == 0
        assert main(["render", name, *SMALL, "-o", "named.png"]) == 0
        assert np.array_equal(pixels("piped.png"), pixels("named.png"))
        give(monkeypatch, data)
        assert main(["convert", "-", "piped.ply"]) == 0
        capsys.readouterr()
        assert len(e3d.load_mesh("piped.ply").faces) == 2


def test_standard_input_without_a_model(capsys, monkeypatch):
    give(monkeypatch, b"")
    assert main(["info", "-"]) == 1
    assert capsys.readouterr().err.startswith("engine3d: error: <stdin>: unknown mesh format")
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    assert main(["info", "-"]) == 2
    monkeypatch.setattr(sys, "stdin", None)
    assert main(["info", "-"]) == 2
    assert capsys.readouterr().err.count("\n") == 2


@needs_full_device
@pytest.mark.parametrize("option", ["--list-readers", "--help", "--version"])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_what_is_printed_on_a_full_disk_ends_without_a_traceback(option, unbuffered):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "engine3d", option]
        environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
        done = subprocess.run(command, stdout=full, stderr=-1, env=environment, check=False)
    assert done.stderr in (b"", b"engine3d: error: No space left on device\n")
    assert done.returncode == (1 if done.stderr else 0)  # argparse swallows what it cannot print
    assert done.stderr or option != "--list-readers"


@needs_full_device
def test_a_picture_on_a_full_disk_says_where(model):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "engine3d", "render", str(model), *SMALL, "-o", "-"]
        done = subprocess.run(command, stdout=full, stderr=-1, check=False)
    told = b"engine3d: error: standard output: cannot write: No space left on device\n"
    assert (done.returncode, done.stderr) == (1, told)


def test_a_reader_that_leaves_is_no_traceback(model):
    process = start("info", model, "--json")
    process.stdout.close()
    assert b"Traceback" not in process.stderr.read()
    assert process.wait() in (0, 1)
    process.stderr.close()


@pytest.mark.skipif(sys.platform == "win32", reason="a shell of POSIX closes them")
@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_streams(model, tmp_path, closed):
    """Nobody is told anything; what is written is whole, without anybody's lines in it."""
    written, broken = tmp_path / "a.png", tmp_path / "b.obj"
    broken.write_text("v 0 0")
    for arguments, status in (
        (["info", model], 0),
        (["info", broken], 1),
        (["render", model, "-o", written, "--size", "8x8", "--verbose"], 0),
        (["render", model, "-o", "-", "--size", "8x8"], 0),
    ):
        command = shlex.join([sys.executable, "-m", "engine3d", *map(str, arguments)])
        done = subprocess.run(["sh", "-c", f"exec {command} {closed}"], capture_output=True)
        assert done.returncode == status, done.stderr
        assert b"Traceback" not in done.stderr
    with Image.open(written) as image:
        image.load()


def test_a_reader_of_a_picture_that_leaves():
    size = ["--size", "1280x720"]
    process = start("render", "--scene", "default", *size, "-o", "-")
    process.stdout.read(10)
    process.stdout.close()
    error = process.stderr.read()
    process.stderr.close()
    assert process.wait() == 1
    assert error == b""


def test_ctrl_c_is_quiet_and_leaves_no_file(model, tmp_path):
    output = tmp_path / "long.gif"
    process = start("render", model, "--turntable", "3000", "--verbose", "-o", output, **STOPPABLE)
    assert b"loaded" in process.stderr.readline()
    time.sleep(0.5)
    stop(process)
    out, err = process.communicate(timeout=HUNG)
    assert process.returncode == STOPPED
    assert out == b""
    assert all(b"] frame " in line for line in err.splitlines())
    assert [entry.name for entry in tmp_path.iterdir()] == [model.name]

"""What commands print of names from outside, and Ctrl-C before a command begins."""

import os
import subprocess
import sys

import pytest

from engine3d.apps.cli import main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no such names on Windows")

EVIL = "\x1b]0;owned\x07\x1b[31mred"
SHOWN = r"\x1b]0;owned\x07\x1b[31mred"
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
SMALL = ("--size", "48x32")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    (tmp_path / f"{EVIL}.obj").write_text(SQUARE)
    (tmp_path / f"{EVIL}2.obj").write_text("mtllib x.mtl\nusemtl a\n" + SQUARE + "f 1 2\n")
    (tmp_path / "a.obj").write_text(SQUARE)
    (tmp_path / "a.png").write_bytes(b"no image")
    return tmp_path


@pytest.mark.parametrize(
    "arguments",
    [
        ["render", f"{EVIL}.obj", *SMALL, "--verbose", "-o", "out.png"],
        ["render", f"{EVIL}2.obj", *SMALL, "-o", "out.png"],
        ["render", f"{EVIL}3.obj", *SMALL, "-o", "out.png"],
        ["render", "a.obj", *SMALL, "-o", f"a.obj/{EVIL}/out.png"],
        ["render", "a.obj", *SMALL, "-o", f"out.{EVIL}"],
        ["render", "a.obj", *SMALL, "--texture", f"{EVIL}.tga", "-o", "out.png"],
        ["render", "a.obj", *SMALL, "--reference", f"{EVIL}.png"],
        ["render", "a.obj", "--mode", EVIL, "-o", "out.png"],
        ["render", "a.obj", "--no-such-option", EVIL, f"--{EVIL}", "-o", "out.png"],
        ["run", f"{EVIL}.obj", *SMALL, "--frames", "1"],
        ["run", f"{EVIL}.obj", *SMALL, "--frames", "1", "--headless"],
        ["convert", f"{EVIL}2.obj", "out.stl"],
        ["convert", f"{EVIL}.obj", f"{EVIL}.obj"],
        ["info", f"{EVIL}2.obj"],
        ["info", f"{EVIL}3.obj"],
        [EVIL],
    ],
    ids=lambda arguments: ascii(" ".join(arguments[:2]))[:30],
)
def test_names_do_not_steer_the_terminal(arguments, capfd):
    if "--reference" in arguments:
        assert main(["render", "a.obj", *SMALL, "--unlit", "-o", f"{EVIL}.png"]) == 0
    capfd.readouterr()
    main(arguments)
    said = "".join(capfd.readouterr())
    assert said
    assert all(character.isprintable() for character in said.replace("\n", ""))
    if EVIL[:4] in "".join(arguments):
        assert SHOWN in said


def test_the_title_of_a_model_is_shown_as_python_writes_it():
    from engine3d.stage.open_model import open_model

    assert open_model(f"{EVIL}.obj").title == f"{SHOWN}.obj"


NUMPY = """
import signal, time
try:
    signal.raise_signal(signal.SIGINT)
    time.sleep(0.2)
except BaseException:
    pass  # as an extension module may
raise ImportError("interrupted")
"""


def test_ctrl_c_while_numpy_loads(folder):
    (folder / "numpy").mkdir()
    (folder / "numpy" / "__init__.py").write_text(NUMPY)
    done = subprocess.run(
        [sys.executable, "-m", "engine3d", "info", "a.obj"],
        env={**os.environ, "PYTHONPATH": str(folder)},
        capture_output=True,
        timeout=60,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, b"", b"")

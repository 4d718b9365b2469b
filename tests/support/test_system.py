"""The package on a system that lacks what only POSIX has, as Windows does."""

import os
import subprocess
import sys

import pytest

from engine3d._support import system

# What Windows lacks is taken away once the standard library is loaded, then all of the package
# loads, and the command draws a model that names another file.
WITHOUT_POSIX = """
import ctypes, os, signal, subprocess, sys, tempfile, pathlib, multiprocessing, types
for name in ("fcntl", "resource", "termios", "pwd", "grp"):
    sys.modules[name] = None
for name in ("O_CLOEXEC", "O_NONBLOCK", "O_NOFOLLOW", "O_DIRECTORY", "O_PATH", "fork", "fchmod",
             "sched_getaffinity", "set_blocking", "getuid", "geteuid"):
    delattr(os, name)
for name in ("SIGHUP", "SIGALRM", "setitimer", "pthread_sigmask"):
    delattr(signal, name)
sys.modules["msvcrt"] = types.SimpleNamespace(LK_NBLCK=2, locking=lambda *file: None)

import pkgutil, engine3d
from importlib import import_module
for module in pkgutil.walk_packages(engine3d.__path__, "engine3d."):
    if module.name.startswith(("engine3d._native", "engine3d.lessons")):
        continue
    try:
        import_module(module.name)
    except ImportError as error:  # an extra that is not installed
        assert error.name and not error.name.startswith("engine3d"), module.name
pathlib.Path("a.mtl").write_text("newmtl m\\nKd 1 0 0\\n")
text = "mtllib a.mtl\\nv 0 0 0\\nv 1 0 0\\nv 0 1 0\\nusemtl m\\nf 1 2 3\\n"
pathlib.Path("a.obj").write_text(text)
from engine3d.cli import main
assert main(["render", "a.obj", "-o", "a.png", "--resolution", "32x24"]) == 0
"""


def test_without_posix(tmp_path):
    subprocess.run([sys.executable, "-c", WITHOUT_POSIX], cwd=tmp_path, check=True)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.skipif(sys.platform == "win32", reason="locks by flock")
def test_a_lock_ends_with_its_file(tmp_path):
    def opened():
        return os.open(tmp_path / "lock", system.READ_WRITE | os.O_CREAT)

    first, second = opened(), opened()
    assert system.locked(first)
    assert not system.locked(second)
    os.close(first)
    assert system.locked(second)
    os.close(second)


def test_ending_signals_and_processors():
    assert "SIGTERM" in {number.name for number in system.ending_signals()}
    assert 1 <= system.usable_processors() <= os.cpu_count()

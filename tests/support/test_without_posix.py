"""The package on a system that lacks what only POSIX has, as Windows does."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.windows_names import PARTLY, WHOLLY, missing, typeshed

import engine3d

pytestmark = pytest.mark.skipif(typeshed() is None, reason="pip install mypy: what Windows lacks")

PACKAGE = Path(engine3d.__file__).parent
# Names that are asked for where the system is known to have them: each file says how.
KNOWN = {
    "apps/agents/server_limits.py": {"ITIMER_REAL", "SIGALRM"},  # has setitimer
    "compat/open3d/_stand_ins.py": {"memfd_create"},  # on Linux
    "base/process_groups.py": {"SIGKILL", "killpg"},  # not on Windows
    "base/system.py": {"sysconf"},  # AttributeError
    "apps/editor/ui/interrupts.py": {"setitimer", "ITIMER_REAL", "SIGALRM"},  # has_alarm()
    "base/files/atomic_write.py": {"set_blocking"},  # where AT_ONCE is a flag
    "apps/terminal/device.py": {"O_NOCTTY"},  # once termios is imported
    "apps/terminal/terminal_window.py": {"SIGWINCH"},  # once a Device is open
}

# What Windows lacks is taken away once the standard library is loaded, then all of the package
# loads, the command draws a model that names another file, and a folder is locked.
PROGRAM = """
import asyncio, ctypes, importlib, json, multiprocessing, os, pathlib, pkgutil, platform, signal
import subprocess, sys, tempfile, types
import numpy, PIL.Image, rich.console, sdl2
# Other packages start programs, for which Python 3.13 has names of `os`.
subprocess._USE_POSIX_SPAWN = False
for name in ("matplotlib.pyplot", "mujoco", "pyvista", "trimesh.viewer"):
    try:
        importlib.import_module(name)
    except ImportError:
        pass
partly, wholly = json.load(sys.stdin)
for module, names in partly.items():
    for name in names:
        vars(importlib.import_module(module)).pop(name, None)
for name in wholly:
    sys.modules[name] = None
sys.platform = "win32"
os.environ["APPDATA"] = os.environ["LOCALAPPDATA"] = os.getcwd()

locks = {}
def locking(handle, mode, count):
    here = os.fstat(handle).st_ino
    if locks.setdefault(here, handle) != handle:
        raise PermissionError(13, "locked")
sys.modules["msvcrt"] = types.SimpleNamespace(LK_NBLCK=2, locking=locking)
kernel = types.SimpleNamespace(GlobalMemoryStatusEx=lambda status: 0)
ctypes.WinDLL = {"kernel32": kernel}.get

sys.modules["open3d"] = None  # its package asks for what Windows has
import engine3d
for module in pkgutil.walk_packages(engine3d.__path__, "engine3d."):
    if module.name.startswith(("engine3d._native", "engine3d.lessons")):
        continue
    try:
        importlib.import_module(module.name)
    except ImportError as error:  # an extra that is not installed
        assert error.name and not error.name.startswith("engine3d"), module.name
pathlib.Path("a.mtl").write_text("newmtl m\\nKd 1 0 0\\n")
text = "mtllib a.mtl\\nv 0 0 0\\nv 1 0 0\\nv 0 1 0\\nusemtl m\\nf 1 2 3\\n"
pathlib.Path("a.obj").write_text(text)
from engine3d.apps.cli import main
assert main(["render", "a.obj", "-o", "a.png", "--size", "32x24"]) == 0

from engine3d.apps.batch.locking import locked_folder
with locked_folder("."):
    try:
        with locked_folder("."):
            print("locked twice")
    except engine3d.FileAccessError as error:
        print(error)
"""


def test_the_package_loads_draws_and_locks(tmp_path):
    lacking = json.dumps([{module: sorted(missing(module)) for module in PARTLY}, WHOLLY])
    command = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(command, cwd=tmp_path, input=lacking, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert "another batch writes to this folder" in done.stdout


def test_what_windows_lacks_is_known():
    assert {"fork", "register_at_fork", "O_NOFOLLOW", "sched_getaffinity"} <= missing("os")
    assert {"SIGKILL", "SIGWINCH"} <= missing("signal")
    assert not {"open", "O_BINARY", "O_NOINHERIT", "kill"} & missing("os")
    assert not {"SIGINT", "SIGTERM"} & missing("signal")


def lacking_in(tree):
    """The names of a file that Windows lacks, as "module.name", and modules loaded with it."""
    guarded = {
        node.args[1].value
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and ast.unparse(node.func) in ("hasattr", "getattr")
        and isinstance(node.args[1], ast.Constant)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if node.value.id in PARTLY and node.attr in missing(node.value.id) - guarded:
                yield node.attr
        elif isinstance(node, ast.ImportFrom) and node.module in PARTLY:
            yield from {name.name for name in node.names} & missing(node.module)
    for node in tree.body:
        if isinstance(node, ast.Import):
            yield from {name.name for name in node.names} & set(WHOLLY)
        elif isinstance(node, ast.ImportFrom) and node.module in WHOLLY:
            yield node.module


@pytest.mark.parametrize(
    "text, found",
    [
        ("import os\nos.fork()", {"fork"}),
        ("import os\nif hasattr(os, 'fork'): os.fork()", set()),
        ("from signal import SIGKILL", {"SIGKILL"}),
        ("import fcntl", {"fcntl"}),
        ("def f():\n    import fcntl", set()),
    ],
)
def test_unguarded_names_are_found(text, found):
    assert set(lacking_in(ast.parse(text))) == found


def test_no_file_asks_for_what_windows_lacks():
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        names = set(lacking_in(ast.parse(path.read_text("utf-8"))))
        if names:
            found[path.relative_to(PACKAGE).as_posix()] = names
    lacking = set().union(*map(missing, PARTLY))  # Windows has more of them from version to version
    assert found == {name: names & lacking for name, names in KNOWN.items() if names & lacking}

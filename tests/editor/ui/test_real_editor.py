"""The editor in a real window on a virtual screen, with real key and mouse events."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from patience import HUNG

pytest.importorskip("imgui_bundle", reason="it is an extra: pip install -e .[editor]")
MISSING = [tool for tool in ("Xvfb", "xdotool") if shutil.which(tool) is None]
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(MISSING), reason=f"needs {', '.join(MISSING)}"),
]


@pytest.fixture
def screen():
    """Start a virtual screen; return its name, such as ``:5``."""
    command = [
        "Xvfb",
        "-displayfd",
        "1",
        "-screen",
        "0",
        "1024x768x24",
        "-nolisten",
        "tcp",
        "-noreset",
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
        yield ":" + server.stdout.readline().decode().strip()
        server.terminate()


def cpu_seconds(process):
    fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def is_idle(process):
    """Whether a process takes no more than a hundredth of a processor for two seconds."""
    before = cpu_seconds(process)
    time.sleep(2)
    return cpu_seconds(process) - before <= 0.02


def until(condition):
    """Wait until something is so; return what it is."""
    end = time.monotonic() + HUNG
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.2)
    raise AssertionError("it took too long")


def test_the_editor_opens_idles_edits_and_ends(screen, tmp_path):
    environment = {**os.environ, "DISPLAY": screen}
    for name in ("WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        environment.pop(name, None)
    for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
        environment[name] = str(tmp_path / name)

    def do(*arguments):
        command = ["xdotool", *map(str, arguments)]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        return done.stdout.strip()

    command = [sys.executable, "-m", "engine3d", "edit", "--resolution", "1000x700"]
    with subprocess.Popen(command, env=environment, cwd=tmp_path, stderr=subprocess.PIPE) as editor:
        try:
            window = until(lambda: do("search", "--onlyvisible", "--class", "engine3d"))
            assert do("getwindowname", window) == "untitled - engine3d"
            do("windowfocus", "--sync", window)
            do("mousemove", 500, 300)
            until(lambda: is_idle(editor))
            do("click", 1)
            do("key", "ctrl+a")
            layout = tmp_path / "XDG_STATE_HOME" / "engine3d" / "editor.ini"
            do("key", "ctrl+q")
            assert editor.wait(HUNG) == 0
            assert layout.exists()
        finally:
            editor.kill()
        assert editor.stderr.read() == b""

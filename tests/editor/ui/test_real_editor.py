"""The editor in a real window on a virtual screen, with real key and mouse events."""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from patience import HUNG

import engine3d as e3d

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


class Desktop:
    """A running editor, and hands on its screen; places are pixels of its window."""

    def __init__(self, screen, folder, *arguments):
        self.environment = {**os.environ, "DISPLAY": screen}
        for name in ("WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
            self.environment.pop(name, None)
        for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
            self.environment[name] = str(folder / name)
        command = [sys.executable, "-m", "engine3d", "edit", *arguments, "--resolution", "1000x700"]
        self.process = subprocess.Popen(
            command, env=self.environment, cwd=folder, stderr=subprocess.PIPE
        )
        self.window = until(self.focused_window)
        time.sleep(1)
        place = self.do("getwindowgeometry", "--shell", self.window).split()
        self.corner = [int(line.partition("=")[2]) for line in place if line[:2] in ("X=", "Y=")]

    def focused_window(self):
        """Return the window's number once it has the keyboard: SDL makes another one at first."""
        window = self.do("search", "--onlyvisible", "--class", "engine3d")
        self.do("windowfocus", window)
        return window if window and self.do("getwindowfocus", "-f") == window else ""

    def do(self, *arguments):
        command = ["xdotool", *map(str, arguments)]
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        return done.stdout.strip()

    @property
    def title(self):
        return self.do("getwindowname", self.window)

    def move(self, x, y):
        self.do("mousemove", "--sync", self.corner[0] + x, self.corner[1] + y, "sleep", 0.1)

    def click(self, x, y):
        self.move(x, y)
        self.do("click", 1, "sleep", 0.1)

    def drag(self, start, *places):
        self.move(*start)
        self.do("mousedown", 1, "sleep", 0.1)
        for place in places:
            self.move(*place)
        self.do("mouseup", 1, "sleep", 0.1)

    def type(self, text):
        self.do("type", "--delay", 15, text)
        self.do("key", "Return")

    def run(self, line):
        """Enter a line of Python."""
        self.click(500, 680)
        self.type(line)

    def end(self):
        """Return the exit status and what was printed."""
        try:
            said = self.process.communicate(timeout=HUNG)[1]
            return self.process.returncode, said
        finally:
            self.process.kill()


def test_the_editor_opens_idles_edits_and_ends(screen, tmp_path):
    desktop = Desktop(screen, tmp_path)
    assert desktop.title == "untitled - engine3d"
    desktop.move(500, 300)
    until(lambda: is_idle(desktop.process))
    desktop.click(500, 300)
    desktop.do("key", "ctrl+a", "key", "ctrl+q")
    assert desktop.end() == (0, b"")
    assert (tmp_path / "XDG_STATE_HOME" / "engine3d" / "editor.ini").exists()


def row(number):
    """Where a row of the tree is."""
    return 60, 86 + 20 * number


def saved(desktop, path):
    """Save, and return what the file holds."""
    desktop.click(*row(0))
    desktop.do("key", "ctrl+s")
    until(lambda: desktop.title == f"{path.name} - engine3d")
    return json.loads(path.read_text())


def test_what_hands_do_is_in_the_file(screen, tmp_path):
    scene, path = e3d.Scene(), tmp_path / "boxes.e3d.json"
    for number in range(3):
        scene.add(e3d.box(), name=f"box{number}", translation=(2 * number, 0, 0))
    e3d.save_scene(scene, path)
    desktop = Desktop(screen, tmp_path, path.name)
    desktop.click(*row(0))
    desktop.do("key", "F2")
    desktop.type("first")
    desktop.drag(row(2), (70, 110), row(0))
    desktop.run("while True: pass")
    desktop.do("key", "Return")
    time.sleep(1.5)
    desktop.do("key", "Escape")
    desktop.run("animator.spin(scene.nodes[1], period=3)")
    desktop.click(*row(2))
    desktop.do("key", "Delete", "key", "ctrl+d", "key", "ctrl+z")
    nodes = saved(desktop, path)["nodes"]
    assert [node["name"] for node in nodes] == ["first", "box1", "box2"]
    assert nodes[0]["children"] == [2] and nodes[1]["spins"][0]["period"] == 3
    desktop.do("key", "space", "sleep", 1, "key", "space")
    assert "*" not in desktop.title  # time is no change
    later = saved_again(desktop, path)["nodes"][1]["rotation"]
    assert later != [0.0, 0.0, 0.0, 1.0]
    desktop.click(*row(0))
    desktop.do("key", "Delete")
    until(lambda: "*" in desktop.title)
    desktop.process.terminate()
    assert desktop.end() == (143, b"")
    copies = list((tmp_path / "XDG_CACHE_HOME" / "engine3d" / "unsaved").glob("*.e3d.json"))
    assert len(copies) == 1 and b"first" not in copies[0].read_bytes()


def saved_again(desktop, path):
    """Change something, and return what is saved then."""
    desktop.run("scene.ambient = 0.5, 0.5, 0.5")
    until(lambda: "*" in desktop.title)
    return saved(desktop, path)

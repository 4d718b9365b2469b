"""The editor in a real window on a virtual screen, with real key and mouse events."""

import contextlib
import json
import time

import pytest
from desktop import IDLE_SHARE, MARKS, Desktop, processor_seconds, until, virtual_screen

import engine3d as e3d

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)
pytestmark = MARKS

RUNNING_COLOR = (150, 40, 40)  # behind what tells that Python runs


@pytest.fixture(scope="module")
def screen():
    with virtual_screen(1024, 768) as screen:
        yield screen


@pytest.fixture
def opened(screen, tmp_path):
    """What opens an editor, which is ended after the test."""
    with contextlib.ExitStack() as stack:
        yield lambda *arguments: stack.enter_context(Editor(screen, tmp_path, *arguments))


def is_idle(process):
    """Whether a process has next to nothing to do for two seconds."""
    before = processor_seconds(process.pid)
    time.sleep(2)
    return processor_seconds(process.pid) - before <= 2 * IDLE_SHARE


class Editor(Desktop):
    """A running editor, and hands on its screen; places are pixels of its window."""

    def __init__(self, screen, folder, *arguments):
        homes = {name: str(folder / name) for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME")}
        command = ["-m", "engine3d", "edit", *arguments, "--size", "1000x700"]
        super().__init__(screen, folder, command, **homes)
        self._mouse = None
        place = self.do("getwindowgeometry", "--shell", self.window).split()
        self.corner = [int(line.partition("=")[2]) for line in place if line[:2] in ("X=", "Y=")]

    def move(self, x, y):
        if (x, y) == self._mouse:  # xdotool would wait for 15 seconds for the mouse to leave
            return
        self.do("mousemove", "--sync", self.corner[0] + x, self.corner[1] + y, "sleep", 0.1)
        self._mouse = x, y

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
        self.do("type", "--delay", 15, "--", text)
        self.do("key", "Return")

    def run(self, line):
        """Enter a line of Python."""
        self.click(500, 680)
        self.type(line)


def test_the_editor_opens_idles_edits_and_ends(opened, tmp_path):
    desktop = opened()
    assert desktop.title == "untitled - engine3d"
    desktop.move(500, 300)
    until(lambda: is_idle(desktop.process))
    desktop.click(500, 300)
    desktop.do("key", "ctrl+a", "key", "ctrl+q")
    assert desktop.finish() == (0, b"")
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


def test_what_hands_do_is_in_the_file(opened, tmp_path):
    scene, path = e3d.Scene(), tmp_path / "boxes.e3d.json"
    for number in range(3):
        scene.add(e3d.box(), name=f"box{number}", translation=(2 * number, 0, 0))
    e3d.save_scene(scene, path)
    desktop = opened(path.name)
    desktop.click(*row(0))
    desktop.do("key", "F2")
    desktop.type("first")
    desktop.drag(row(2), (70, 110), row(0))
    desktop.run("while True: pass")
    desktop.do("key", "Return")
    until(lambda: (desktop.look() == RUNNING_COLOR).all(-1).any())
    desktop.do("key", "Escape")
    desktop.run("animator.spin(scene.nodes[1], period=3)")
    desktop.click(*row(2))
    desktop.do("key", "Delete", "key", "ctrl+d", "key", "ctrl+z")
    nodes = saved(desktop, path)["nodes"]
    assert [node["name"] for node in nodes] == ["first", "box1", "box2"]
    assert nodes[0]["children"] == [2] and nodes[1]["spins"][0]["period"] == 3
    desktop.do("key", "space", "sleep", 0.3, "key", "space")
    assert "*" not in desktop.title  # time is no change
    later = saved_again(desktop, path)["nodes"][1]["rotation"]
    assert later != [0.0, 0.0, 0.0, 1.0]
    desktop.click(*row(0))
    desktop.do("key", "Delete")
    until(lambda: "*" in desktop.title)
    desktop.process.terminate()
    assert desktop.finish() == (143, b"")
    copies = list((tmp_path / "XDG_CACHE_HOME" / "engine3d" / "unsaved").glob("*.e3d.json"))
    assert len(copies) == 1 and b"first" not in copies[0].read_bytes()


def saved_again(desktop, path):
    """Change something, and return what is saved then."""
    desktop.run("scene.ambient = 0.5, 0.5, 0.5")
    until(lambda: "*" in desktop.title)
    return saved(desktop, path)


def test_a_scene_is_made_by_keys_alone(opened, tmp_path):
    path = tmp_path / "planets.e3d.json"
    desktop = opened(path.name)
    for name in ("sun", "earth", "moon"):
        desktop.do("key", "F3")
        desktop.type("add sphere")
        desktop.do("key", "F2")
        desktop.type(name)
    for name in ("earth", "sun"):
        desktop.do("key", "ctrl+p")
        desktop.type(name)
        desktop.do("key", "Left")  # from the moon to what it is below now
    desktop.do("key", "Up", "key", "w", "key", "Prior", "key", "e", "key", "Right")
    desktop.do("key", "F6", "key", "Tab", "key", "Tab", "key", "Tab")
    desktop.type("-5")
    desktop.do("key", "ctrl+s")
    until(lambda: desktop.title == f"{path.name} - engine3d")
    nodes = {node["name"]: node for node in json.loads(path.read_text())["nodes"]}
    numbers = list(nodes)
    assert nodes["sun"]["children"] == [numbers.index("earth")]
    assert nodes["earth"]["children"] == [numbers.index("moon")]
    assert nodes["sun"]["translation"][:2] == [-5.0, 0.75]
    assert nodes["sun"]["rotation"] != [0.0, 0.0, 0.0, 1.0]
    desktop.do("key", "Escape", "key", "ctrl+q")
    assert desktop.finish() == (0, b"")

"""The viewer in a real window on a virtual screen, with real key and mouse events."""

import ctypes
import ctypes.util
import os
import shutil
import subprocess
import sys
import time

import numpy as np
import pytest
from patience import HUNG
from PIL import Image, ImageGrab, features

from engine3d.canvas import Canvas
from engine3d.viewer.help_panel import draw_help
from engine3d.viewer.messages import MESSAGE_SECONDS

MISSING = [tool for tool in ("Xvfb", "xdotool") if shutil.which(tool) is None]
if not features.check("xcb"):
    MISSING.append("a Pillow that reads X screens")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(MISSING), reason=f"needs {', '.join(MISSING)}"),
]

SCREEN = (800, 600)
WINDOW = (400, 300)
CUBE = "\n".join(
    [
        *(f"v {x} {y} {z}" for z in (0, 1) for y in (0, 1) for x in (0, 1)),
        "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n",
    ]
)


@pytest.fixture(scope="module")
def screen():
    """Start a virtual screen; return its name, such as ``:5``."""
    size = f"{SCREEN[0]}x{SCREEN[1]}x24"
    command = ["Xvfb", "-displayfd", "1", "-screen", "0", size, "-nolisten", "tcp", "-noreset"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
        yield ":" + server.stdout.readline().decode().strip()
        server.terminate()


class Desktop:
    """A running viewer, and hands and eyes on its screen."""

    def __init__(self, screen, folder, *arguments, command="run"):
        self.folder = folder
        self.environment = {**os.environ, "DISPLAY": screen, "XDG_STATE_HOME": str(folder)}
        for name in ("WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
            self.environment.pop(name, None)
        self.screen = screen
        self.process = subprocess.Popen(
            [sys.executable, "-m", "engine3d", command, *arguments],
            cwd=folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.window = ""
        self.do("mousemove", *(side // 2 for side in SCREEN))
        self.focus()
        self.settle()

    def find_window(self):
        """Wait for the viewer's window; return its number."""
        end = time.monotonic() + HUNG
        while time.monotonic() < end and self.process.poll() is None:
            found = self.do("search", "--onlyvisible", "--class", "engine3d", check=False)
            if found:
                return found.split()[0]
            time.sleep(0.1)
        raise AssertionError("no window opened")

    def focus(self):
        """Give the keyboard to the window, which may not take it at once."""
        end = time.monotonic() + HUNG
        while not self.takes_focus():
            if time.monotonic() > end:
                self.process.kill()
                raise AssertionError("the window takes no keyboard")
            time.sleep(0.1)

    def takes_focus(self):
        """Offer the keyboard once, to the window that is there now: SDL makes another one at first.

        xdotool waits for ever where the window let the keyboard go again.
        """
        self.window = self.find_window()
        command = ["xdotool", "windowfocus", "--sync", self.window]
        try:
            done = subprocess.run(command, env=self.environment, timeout=5, check=False)
        except subprocess.TimeoutExpired:
            return False
        return done.returncode == 0

    def do(self, *arguments, check=True):
        """Run xdotool; return what it prints."""
        command = ["xdotool", *map(str, arguments)]
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, check=check, timeout=HUNG
        )
        return done.stdout

    def look(self):
        """Return what the screen shows, (H, W, 3) int."""
        return np.asarray(ImageGrab.grab(xdisplay=self.screen).convert("RGB")).astype(int)

    def settle(self):
        """Wait until the screen stands still; return it."""
        end = time.monotonic() + HUNG
        before = self.look()
        while time.monotonic() < end:
            time.sleep(0.3)
            now = self.look()
            if (now == before).all():
                return now
            before = now
        raise AssertionError("the screen did not come to rest")

    def without_message(self):
        """Return the screen when messages have gone."""
        time.sleep(MESSAGE_SECONDS + 0.5)
        return self.settle()

    def wait_for_change(self, before):
        """Wait until the screen shows something else than ``before``; return it."""
        end = time.monotonic() + HUNG
        while time.monotonic() < end:
            now = self.look()
            if (now != before).any():
                return now
            time.sleep(0.05)
        raise AssertionError("nothing changed on the screen")

    def press(self, *keys):
        """Press keys one after the other; return the screen when it has changed."""
        before = self.settle()
        self.do("key", *keys)
        return self.wait_for_change(before)

    def settle_after(self, *keys):
        """Press keys one after the other; return the screen when it has come to rest."""
        self.press(*keys)
        return self.settle()

    def drag(self, button, dx, dy):
        """Drag with a mouse button; return the screen when it has come to rest."""
        self.settle()
        self.do("mousedown", button)
        for _ in range(4):
            self.do("mousemove_relative", "--sync", "--", dx // 4, dy // 4)
        self.do("mouseup", button)
        return self.settle()

    def finish(self):
        """Return the exit status and what was printed, once the viewer has ended."""
        out, err = self.process.communicate(timeout=HUNG)
        return self.process.returncode, out + err


@pytest.fixture
def desktop(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    size = f"{WINDOW[0]}x{WINDOW[1]}"
    desktop = Desktop(screen, tmp_path, "cube.obj", "--look", "plain", "--resolution", size)
    yield desktop
    if desktop.process.poll() is None:
        desktop.process.kill()
        desktop.process.communicate()


def covered(pixels, background=(43, 46, 53)):
    """Return how many pixels of the window show the model."""
    window = (pixels != 0).any(axis=2)
    return int((window & (pixels != background).any(axis=2)).sum())


def test_keys_mouse_and_screenshot(desktop):
    first = desktop.settle()
    assert 0.1 < covered(first) / (WINDOW[0] * WINDOW[1]) < 0.9
    assert (desktop.press("h") != first).sum() > 1000
    for _ in range(draw_help(Canvas(*WINDOW))):
        desktop.press("h")
    plain = desktop.without_message()
    assert (desktop.drag(1, 60, 20) != plain).any()
    desktop.do("click", 4, "click", 4, "click", 4)
    assert covered(desktop.settle()) > covered(plain)
    desktop.press("r")
    assert (desktop.settle() == plain).all()
    assert (desktop.drag(3, 40, 0) != plain).any()
    desktop.press("r")
    assert covered(desktop.drag(2, 0, 60)) < covered(plain)
    desktop.press("r", "F12")
    desktop.settle()
    with Image.open(desktop.folder / "cube-screenshot-001.png") as image:
        picture = np.asarray(image.convert("RGB")).astype(int)
    assert picture.shape == (WINDOW[1], WINDOW[0], 3)
    x, y = ((screen - window) // 2 for screen, window in zip(SCREEN, WINDOW, strict=True))
    np.testing.assert_array_equal(plain[y : y + WINDOW[1], x : x + WINDOW[0]], picture)
    desktop.do("key", "q")
    assert desktop.finish() == (0, b"")


def test_walking_resizing_hiding_and_turning(desktop):
    before = covered(desktop.without_message())
    desktop.do("key", "Tab", "keydown", "w")
    time.sleep(0.7)
    desktop.do("keyup", "w", "key", "Escape")
    assert covered(desktop.without_message()) > before
    desktop.press("r")
    desktop.do("windowsize", "--sync", desktop.window, 600, 450)
    large = desktop.settle()
    assert covered(large) > 1.5 * before
    desktop.do("windowunmap", "--sync", desktop.window)
    assert covered(desktop.settle()) == 0
    desktop.do("windowmap", "--sync", desktop.window)
    assert (desktop.settle() == large).all()
    desktop.do("windowfocus", "--sync", desktop.window, "key", "space")
    turned = desktop.wait_for_change(desktop.wait_for_change(large))
    desktop.do("key", "space")
    assert (desktop.without_message() != large).any()
    assert covered(turned) > 0
    ask_to_close(desktop)
    assert desktop.finish() == (0, b"")


def title(desktop):
    return desktop.do("getwindowname", desktop.window).strip()


def test_lessons_go_forward_and_back(screen, tmp_path):
    desktop = Desktop(screen, tmp_path, "zbuffer", command="learn")
    first = desktop.settle()
    assert "step 1" in title(desktop)
    assert (desktop.settle_after("Right") != first).sum() > 1000
    assert "step 2" in title(desktop)
    assert (desktop.settle_after("Left") == first).all()
    desktop.do("key", "q")
    status, said = desktop.finish()
    assert status == 0 and said.startswith(b"Arrows: steps.") and said.count(b"\n") == 1


def test_a_number_of_frames_ends_though_nothing_moves(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    environment = {**os.environ, "DISPLAY": screen}
    command = [sys.executable, "-m", "engine3d", "run", "cube.obj", "--frames", "3"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


def processor_ticks(process):
    with open(f"/proc/{process.pid}/stat") as file:
        fields = file.read().rpartition(")")[2].split()
    return int(fields[11]) + int(fields[12])


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("city", ["--scene", "city", "--triangles", "100000", "--camera", "fps"]),
        ("city", ["--scene", "city", "--triangles", "100000"]),
        ("solar", ["--scene", "solar", "--no-animate"]),
        ("cube.obj", ["cube.obj", "--watch"]),
    ],
)
def test_what_stands_still_costs_nothing(screen, tmp_path, name, arguments):
    (tmp_path / "cube.obj").write_text(CUBE)
    desktop = Desktop(screen, tmp_path, *arguments, "--resolution", "400x300")
    try:
        desktop.without_message()
        before, start = processor_ticks(desktop.process), time.monotonic()
        time.sleep(4.0)
        spent = (processor_ticks(desktop.process) - before) / os.sysconf("SC_CLK_TCK")
        assert spent < 0.01 * (time.monotonic() - start)
        assert f"{name} - engine3d - idle, last frame" in title(desktop)
    finally:
        desktop.process.kill()
        desktop.process.communicate()


def test_clicks_select_and_keys_go_from_file_to_file(desktop):
    """Controls and letters are pressed as a user does, not sent."""
    (desktop.folder / "dice.obj").write_text(CUBE)
    plain = desktop.without_message()
    desktop.do("mousemove", SCREEN[0] // 2, SCREEN[1] // 2, "click", "1")
    selected = desktop.wait_for_change(plain)
    outline = (selected == (255, 160, 40)).all(axis=2)
    assert outline.sum() > 200 and covered(desktop.settle()) > covered(plain)
    desktop.do("click", "--repeat", "2", "--delay", "50", "1")
    desktop.settle()
    desktop.press("Right")
    assert title(desktop).startswith("dice.obj")
    desktop.press("Prior")
    assert title(desktop).startswith("cube.obj")
    light = desktop.press("k")
    assert (light == (228, 231, 236)).all(axis=2).sum() > 1000


def test_typed_letters_choose_a_file_in_the_dialog(desktop):
    """Keys and the texts that they type come as events of their own."""
    (desktop.folder / "dice.obj").write_text(CUBE)
    plain = desktop.without_message()
    dialog = desktop.settle_after("ctrl+o")
    assert (dialog != plain).any(axis=2).sum() > 10_000
    desktop.do("type", "--delay", "50", "dic")
    assert (desktop.settle() != dialog).any()
    assert (desktop.settle_after("Escape") == plain).all()
    desktop.press("ctrl+o")
    desktop.do("type", "--delay", "50", "dic")
    desktop.settle()
    desktop.press("Return")
    assert title(desktop).startswith("dice.obj")


def test_a_small_window_shows_all_keys_and_what_is_wrong_with_the_file(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    desktop = Desktop(
        screen, tmp_path, "cube.obj", "--look", "plain", "--resolution", "320x240", "--watch"
    )
    try:
        plain = desktop.without_message()
        pages = []
        while (page := desktop.settle_after("h").tobytes()) != plain.tobytes():
            assert page not in pages
            pages.append(page)
        assert len(pages) > 2
        (tmp_path / "cube.obj").write_text("v 1 2\n")
        desktop.wait_for_change(plain)
        broken = desktop.without_message()
        assert (broken != plain).any()
        (tmp_path / "cube.obj").write_text(CUBE)
        desktop.wait_for_change(broken)
        assert (desktop.without_message() == plain).all()
        desktop.do("key", "q")
        assert desktop.finish() == (0, b"")
    finally:
        if desktop.process.poll() is None:
            desktop.process.kill()
            desktop.process.communicate()


def ask_to_close(desktop):
    """Send what a window manager sends when its close button is pressed."""
    x11 = ctypes.CDLL(ctypes.util.find_library("X11") or pytest.skip("needs libX11"))
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XInternAtom.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
    x11.XInternAtom.restype = ctypes.c_ulong
    x11.XSendEvent.argtypes = [
        *(ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long, ctypes.c_void_p)
    ]
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    display = x11.XOpenDisplay(desktop.screen.encode())
    window = int(desktop.window)
    protocols = x11.XInternAtom(display, b"WM_PROTOCOLS", 0)
    delete = x11.XInternAtom(display, b"WM_DELETE_WINDOW", 0)
    # An XEvent is 24 longs; an XClientMessageEvent begins with type, serial, send_event, display,
    # window, message_type, format, data.
    client_message = 33
    event = (ctypes.c_long * 24)(client_message, 0, 1, display, window, protocols, 32, delete)
    x11.XSendEvent(display, window, 0, 0, event)
    x11.XCloseDisplay(display)

"""The viewer in a real window on a virtual screen, with real key and mouse events."""

import contextlib
import ctypes
import ctypes.util
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from desktop import IDLE_SHARE, MARKS, Desktop, processor_seconds, until, virtual_screen
from PIL import Image

pytestmark = MARKS

SCREEN = (800, 600)
WINDOW = (400, 300)
CUBE = "\n".join(
    [
        *(f"v {x} {y} {z}" for z in (0, 1) for y in (0, 1) for x in (0, 1)),
        "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n",
    ]
)
# Messages pass at once: what is drawn when nothing happens any more has none.
COMMAND = (
    "import sys; from engine3d.apps.viewer import messages;"
    "messages.MESSAGE_SECONDS, messages.READ_A_SECOND = 0.05, 1e9;"
    "from engine3d.start import main; sys.exit(main())"
)


@pytest.fixture(scope="module")
def screen():
    with virtual_screen(*SCREEN) as screen:
        yield screen


class Viewer(Desktop):
    """A running viewer, and hands and eyes on its screen."""

    def __init__(self, screen, folder, *arguments, command="run"):
        command = ["-c", COMMAND, command, *arguments]
        super().__init__(screen, folder, command, XDG_STATE_HOME=str(folder))

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


@pytest.fixture
def desktop(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    size = f"{WINDOW[0]}x{WINDOW[1]}"
    with Viewer(screen, tmp_path, "cube.obj", "--look", "plain", "--size", size) as desktop:
        yield desktop


def covered(pixels, background=(43, 46, 53)):
    """Return how many pixels of the window show the model."""
    window = (pixels != 0).any(axis=2)
    return int((window & (pixels != background).any(axis=2)).sum())


def test_keys_mouse_and_screenshot(desktop):
    plain = desktop.settle()
    assert 0.1 < covered(plain) / (WINDOW[0] * WINDOW[1]) < 0.9
    assert (desktop.press("h") != plain).sum() > 1000
    desktop.press("Escape")
    assert (desktop.settle() == plain).all()
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
    before = covered(desktop.settle())
    desktop.do("key", "Tab", "keydown", "w")
    until(lambda: covered(desktop.look()) > before)
    desktop.do("keyup", "w", "key", "Escape")
    assert covered(desktop.settle()) > before
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
    assert (desktop.settle() != large).any()
    assert covered(turned) > 0
    ask_to_close(desktop)
    assert desktop.finish() == (0, b"")


LATE_MESSAGE = """
import ctypes, sys
from engine3d.apps.viewer.sdl import close_video, open_video
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = ctypes.c_void_p

def send():
    display, window = ctypes.c_void_p(x11.XOpenDisplay(None)), ctypes.c_ulong(12345)
    message = (ctypes.c_long * 24)(33, 0, 1, 0, 0, 0, 32)
    getattr(x11, sys.argv[1])(display, window, 0, ctypes.c_long(0), message)
    x11.XSync(display, 0)

sdl = open_video()
send()
close_video(sdl)  # SDL's own handler is gone now
send()
print("still here")
"""


def test_a_message_that_comes_after_its_window_closed_ends_nothing(screen):
    environment = {**os.environ, "DISPLAY": screen.name, "SDL_VIDEODRIVER": "x11"}

    def ask(request):
        command = [sys.executable, "-c", LATE_MESSAGE, request]
        return subprocess.run(command, env=environment, capture_output=True, text=True)

    assert ask("XSendEvent").stdout == "still here\n"
    other = ask("XMapWindow")
    assert other.returncode == 1 and "X_MapWindow" in other.stderr and not other.stdout


def greens(pixels):
    """How many pixels are greener than they are red or blue: what is right is said in green."""
    red, green, blue = np.moveaxis(pixels.astype(int), -1, 0)
    return int((green > np.maximum(red, blue) + 30).sum())


def test_lessons_are_read_played_with_and_checked(screen, tmp_path):
    with Viewer(screen, tmp_path, "lines", command="learn") as desktop:
        until(lambda: desktop.title == "3. Lines - step 1 of 6")
        first = desktop.settle()
        assert (desktop.settle_after("Right") != first).sum() > 1000
        assert desktop.title == "3. Lines - step 2 of 6"
        assert (desktop.settle_after("Left") == first).all()
        assert (desktop.settle_after("Up") != first).sum() > 1000
        assert (desktop.settle_after("Down") == first).all()
        wrong = desktop.settle_after("4", "9", "Return")
        right = desktop.settle_after("BackSpace", "BackSpace", "5", "0", "Return")
        assert greens(right) > 10 and not greens(wrong)
        assert (desktop.settle_after("h") != right).sum() > 10_000
        assert (desktop.settle_after("h") == right).all()
        desktop.settle_after("End")
        assert desktop.title == "3. Lines - step 6 of 6"
        desktop.do("key", "q")
        assert desktop.finish() == (0, b"")


def test_a_number_of_frames_ends_though_nothing_moves(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    environment = {**os.environ, "DISPLAY": screen.name}
    command = [sys.executable, "-m", "engine3d", "run", "cube.obj", "--frames", "3"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


STILL = [
    ("city", ["--scene", "city", "--triangles", "20000", "--camera", "fps"]),
    ("city", ["--scene", "city", "--triangles", "20000"]),
    ("solar", ["--scene", "solar", "--no-animate"]),
    ("cube.obj", ["cube.obj", "--watch"]),
]


def test_what_stands_still_costs_nothing(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    with contextlib.ExitStack() as opened:
        viewers = [
            opened.enter_context(Viewer(screen, tmp_path, *options, "--size", "400x300"))
            for _, options in STILL
        ]
        before = [processor_seconds(viewer.process.pid) for viewer in viewers]
        start = time.monotonic()
        time.sleep(4.0)
        for (name, _), viewer, spent in zip(STILL, viewers, before, strict=True):
            spent = processor_seconds(viewer.process.pid) - spent
            assert spent < IDLE_SHARE * (time.monotonic() - start), name
            assert f"{name} - engine3d - idle, last frame" in viewer.title


def test_clicks_select_and_keys_go_from_file_to_file(desktop):
    """Controls and letters are pressed as a user does, not sent."""
    (desktop.folder / "dice.obj").write_text(CUBE)
    plain = desktop.settle()
    desktop.do("mousemove", SCREEN[0] // 2, SCREEN[1] // 2, "click", "1")
    selected = desktop.wait_for_change(plain)
    outline = (selected == (255, 160, 40)).all(axis=2)
    assert outline.sum() > 200 and covered(desktop.settle()) > covered(plain)
    desktop.do("click", "--repeat", "2", "--delay", "50", "1")
    desktop.settle()
    desktop.settle_after("Right")
    assert desktop.title.startswith("dice.obj")
    desktop.settle_after("Prior")
    assert desktop.title.startswith("cube.obj")
    light = desktop.settle_after("k")
    assert (light == (228, 231, 236)).all(axis=2).sum() > 1000


def test_typed_letters_choose_a_file_in_the_dialog(desktop):
    """Keys and the texts that they type come as events of their own."""
    (desktop.folder / "dice.obj").write_text(CUBE)
    plain = desktop.settle()
    dialog = desktop.settle_after("ctrl+o")
    assert (dialog != plain).any(axis=2).sum() > 10_000
    desktop.do("type", "--delay", "50", "dic")
    assert (desktop.settle() != dialog).any()
    assert (desktop.settle_after("Escape") == plain).all()
    desktop.press("ctrl+o")
    desktop.do("type", "--delay", "50", "dic")
    desktop.settle()
    desktop.settle_after("Return")
    assert desktop.title.startswith("dice.obj")


def test_the_bar_is_clicked_and_hidden(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    size = (600, 440)
    options = ("--look", "plain", "--size", "x".join(map(str, size)))
    left, top = ((whole - side) // 2 for whole, side in zip(SCREEN, size, strict=True))
    with Viewer(screen, tmp_path, "cube.obj", *options) as desktop:
        desktop.do("mousemove", left + 300, top + 300)
        plain = desktop.settle()
        desktop.do("mousemove", left + size[0] - 25, top + 10, "click", "1")
        listed = desktop.wait_for_change(plain)
        desktop.do("mousemove", left + 500, top + 400)
        assert (desktop.settle() != plain).any(axis=2).sum() > 50_000 and listed.any()
        desktop.settle_after("Escape")
        alone = desktop.settle_after("F10")
        assert (alone != plain).any(axis=2)[top : top + 20, left : left + size[0]].mean() > 0.8
        desktop.do("key", "q")
        assert desktop.finish() == (0, b"")


def test_a_small_window_lists_commands_and_tells_what_is_wrong_with_the_file(screen, tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    options = ("--look", "plain", "--size", "320x240", "--watch")
    with Viewer(screen, tmp_path, "cube.obj", *options) as desktop:
        plain = desktop.settle()
        desktop.settle_after("F1")
        desktop.do("type", "--delay", "50", "wiref")
        desktop.settle()
        desktop.settle_after("Return")
        assert (desktop.settle_after("Escape") != plain).any()  # its edges
        desktop.settle_after("w")
        desktop.do("key", "w")
        until(lambda: (desktop.look() == plain).all())  # once what W says has gone
        (tmp_path / "cube.obj").write_text("v 1 2\n")
        desktop.wait_for_change(plain)
        assert (desktop.settle() != plain).any()
        (tmp_path / "cube.obj").write_text(CUBE)
        until(lambda: (desktop.look() == plain).all())
        desktop.do("key", "q")
        assert desktop.finish() == (0, b"")


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
    display = x11.XOpenDisplay(desktop.screen.name.encode())
    window = int(desktop.window)
    protocols = x11.XInternAtom(display, b"WM_PROTOCOLS", 0)
    delete = x11.XInternAtom(display, b"WM_DELETE_WINDOW", 0)
    # An XEvent is 24 longs; an XClientMessageEvent begins with type, serial, send_event, display,
    # window, message_type, format, data.
    client_message = 33
    event = (ctypes.c_long * 24)(client_message, 0, 1, display, window, protocols, 32, delete)
    x11.XSendEvent(display, window, 0, 0, event)
    x11.XCloseDisplay(display)

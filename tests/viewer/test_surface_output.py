"""What goes to the screen of a window without a graphics card: all that changed, and little more.

SDL's dummy driver has no screen; `Screen` stands for it, and gets only the sent rectangles.
"""

import ctypes
import subprocess
import sys

import numpy as np
import pytest
from desktop import MARKS, virtual_screen

import engine3d as e3d
from engine3d._native.canvas import copy_to_window
from engine3d.apps.viewer.sdl import load_sdl
from engine3d.apps.viewer.window import Window

sdl2 = load_sdl()
LOST = 77


class Screen:
    """The pixels that were sent to it; LOST where none were."""

    def __init__(self, monkeypatch):
        self.pixels = np.full((1, 1, 3), LOST, np.uint8)
        self.rows_sent = 0
        monkeypatch.setattr(sdl2, "SDL_UpdateWindowSurfaceRects", self.update)

    def update(self, window, rects, count):
        surface = sdl2.SDL_GetWindowSurface(window).contents
        memory = ctypes.string_at(surface.pixels, surface.pitch * surface.h)
        rows = np.frombuffer(memory, np.uint8).reshape(surface.h, surface.pitch)
        shown = rows[:, : 4 * surface.w].reshape(surface.h, surface.w, 4)[..., 2::-1]
        if self.pixels.shape != shown.shape:
            self.pixels = np.full(shown.shape, LOST, np.uint8)
        self.rows_sent = 0
        for rect in rects[:count]:
            assert rect.h > 0
            place = slice(rect.y, rect.y + rect.h), slice(rect.x, rect.x + rect.w)
            self.pixels[place] = shown[place]
            self.rows_sent += rect.h
        return 0


@pytest.fixture
def screen(monkeypatch):
    return Screen(monkeypatch)


@pytest.fixture
def window(monkeypatch, screen):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window((160, 120), "test", vsync=False) as window:
        window.events()
        yield window


def tell(window, kind):
    event = sdl2.SDL_Event()
    event.type, event.window.event = sdl2.SDL_WINDOWEVENT, kind
    event.window.windowID = sdl2.SDL_GetWindowID(window._window)
    sdl2.SDL_PushEvent(event)
    return window.events()


def change(pixels, random):
    """Draw a few boxes, as panels and buttons change."""
    height, width = pixels.shape[:2]
    for _ in range(random.integers(0, 4)):
        x, y = random.integers(0, width), random.integers(0, height)
        pixels[y : y + random.integers(1, 40), x : x + random.integers(1, 60)] = random.integers(
            0, 256, 4
        )


def fitted(pixels, size):
    """A picture as large as it fits into a window, the pixels nearest to centres, black around."""
    (width, height), (down, across) = size, pixels.shape[:2]
    wide = width * down > height * across
    room = (max(1, across * height // down), height) if wide else (width, width * down // across)
    whole = np.zeros((height, width, 3), np.uint8)
    left, top = (width - room[0]) // 2, (height - room[1]) // 2
    columns, rows = (
        (2 * np.arange(n) + 1) * m // (2 * n) for n, m in zip(room, (across, down), strict=True)
    )
    whole[top : top + room[1], left : left + room[0]] = pixels[rows][:, columns, :3]
    return whole


@pytest.mark.parametrize("seed", range(6))
def test_the_screen_shows_each_picture_whatever_happened_before(window, screen, seed):
    random = np.random.default_rng(seed)
    pixels = random.integers(0, 256, (120, 160, 4), np.uint8)
    for _ in range(60):
        match random.integers(0, 10):
            case 0:  # the screen loses what it showed
                screen.pixels[:] = LOST
                tell(window, sdl2.SDL_WINDOWEVENT_EXPOSED)
            case 1:  # another size, of which programs know by the event
                size = [int(side) for side in random.integers(64, 200, 2)]
                sdl2.SDL_SetWindowSize(window._window, *size)
                screen.pixels = np.full((1, 1, 3), LOST, np.uint8)
                window.events()
                pixels = random.integers(0, 256, (*size[::-1], 4), np.uint8)
            case 2:  # another theme
                pixels = pixels ^ random.integers(1, 256, 4, np.uint8)
        change(pixels, random)
        order = ("rgba", "bgra")[random.integers(0, 2)]
        window.present(pixels, order)
        expected = pixels[..., :3] if order == "rgba" else pixels[..., 2::-1]
        np.testing.assert_array_equal(screen.pixels, expected)


def test_only_rows_that_changed_are_sent(window, screen):
    pixels = np.random.default_rng(0).integers(0, 256, (120, 160, 4), np.uint8)
    window.present(pixels)
    assert screen.rows_sent == 120
    screen.rows_sent = 0
    window.present(pixels)
    assert screen.rows_sent == 0
    pixels[40:43, 7] += 1
    pixels[90, -1, 2] += 1
    pixels[5, :, 3] += 1  # alpha isn't looked at
    window.present(pixels)
    assert screen.rows_sent == 4
    pixels[10:110:2] += 1
    window.present(pixels)
    assert screen.rows_sent == 99


def test_a_window_that_was_covered_gets_all_again(window, screen):
    pixels = np.full((120, 160, 4), 9, np.uint8)
    window.present(pixels)
    screen.pixels[:] = LOST
    tell(window, sdl2.SDL_WINDOWEVENT_EXPOSED)
    shown = pixels.copy()
    pixels[:] = 33  # not presented
    window.expose()
    np.testing.assert_array_equal(screen.pixels, shown[..., :3])


def test_the_last_picture_fits_a_resized_window(window, screen):
    # Blocks: SDL's fixed point takes another pixel where two are equally near.
    blocks = np.random.default_rng(0).integers(0, 256, (5, 5, 4), np.uint8)
    pixels = blocks.repeat(15, 0).repeat(20, 1)
    for size in ((160, 120), (320, 120), (80, 160), (100, 75)):
        sdl2.SDL_SetWindowSize(window._window, *size)
        window.events()
        window.present(pixels)
        np.testing.assert_array_equal(screen.pixels, fitted(pixels, size))
        sdl2.SDL_SetWindowSize(window._window, 240, 180)
        window.events()
        window.expose()
        np.testing.assert_array_equal(screen.pixels, fitted(pixels, (240, 180)))


@pytest.mark.parametrize("width", [1, 3, 255, 256, 257, 1000])
@pytest.mark.parametrize("is_swapped", [False, True])
def test_copies_tell_which_rows_changed(width, is_swapped):
    random = np.random.default_rng(width)
    picture = random.integers(0, 256, (20, width, 4), np.uint8)
    expected = picture[..., [2, 1, 0, 3]] if is_swapped else picture.copy()
    expected[..., 3] = 255
    room = np.full((20, width + 5, 4), 9, np.uint8)
    room[:, :width] = expected
    rows = random.choice(20, 6, replace=False)
    room[rows, random.integers(0, width, 6), random.integers(0, 4, 6)] ^= 1
    changed = np.full(20, 7, np.uint8)
    copy_to_window(picture, room[:, :width], is_swapped, changed)
    np.testing.assert_array_equal(room[:, :width], expected)
    assert (room[:, width:] == 9).all()
    assert sorted(np.flatnonzero(changed)) == sorted(rows) and set(changed.tolist()) == {0, 1}


def test_copies_of_another_size_are_refused():
    picture, changed = np.zeros((4, 5, 4), np.uint8), np.zeros(4, np.uint8)
    with pytest.raises(ValueError, match="not as large"):
        copy_to_window(picture, np.zeros((4, 6, 4), np.uint8), True, changed)
    with pytest.raises(ValueError, match="as many flags"):
        copy_to_window(picture, np.zeros((4, 5, 4), np.uint8), True, changed[:3])


def test_read_only_pictures_are_presented(window, screen):
    pixels = np.full((120, 160, 4), 50, np.uint8)
    pixels.flags.writeable = False
    window.present(e3d.Canvas(pixels.copy()))
    window.present(pixels)
    assert (screen.pixels == 50).all()


#: Changes, hides and resizes a window, and compares it with a picture of the screen each time.
ON_A_REAL_SCREEN = """
import ctypes, os
import numpy as np
from PIL import ImageGrab
import engine3d as e3d
from engine3d.apps.viewer.sdl import load_sdl

sdl, random = load_sdl(), np.random.default_rng(5)

def shown(window):
    x, y = ctypes.c_int(), ctypes.c_int()
    sdl.SDL_GetWindowPosition(window._window, x, y)
    box = x.value, y.value, x.value + window.size[0], y.value + window.size[1]
    return np.asarray(ImageGrab.grab(box, xdisplay=os.environ["DISPLAY"]).convert("RGB"))

with e3d.Window((300, 200), vsync=False) as window:
    window.events(0.2)
    pixels = random.integers(0, 256, (200, 300, 4), np.uint8)
    for turn in range(30):
        if turn % 10 == 4:
            with e3d.Window((120, 90), vsync=False) as other:  # in the middle, over this one
                other.present(np.full((90, 120, 4), 255, np.uint8))
                other.events(0.2)
            window.events(0.2)
        if turn % 10 == 7:
            size = 300 - turn, 200 + turn
            sdl.SDL_SetWindowSize(window._window, *size)
            while window.size != size or pixels.shape[1::-1] != size:
                window.events(0.2)
                pixels = random.integers(0, 256, (size[1], size[0], 4), np.uint8)
        y = random.integers(0, 180)
        pixels[y : y + 20, 30:90] = random.integers(0, 256, 4)
        window.present(pixels)
        different = (shown(window) != pixels[..., :3]).any(axis=2)
        assert not different.any(), (turn, np.argwhere(different)[[0, -1]])
print("all shown")
"""


@MARKS[0]
@MARKS[1]
def test_a_real_window_shows_each_picture():
    with virtual_screen(640, 480) as screen:
        command = [sys.executable, "-c", ON_A_REAL_SCREEN]
        done = subprocess.run(
            command, env=screen.environment(), capture_output=True, text=True, check=False
        )
    assert done.stdout == "all shown\n", done.stderr

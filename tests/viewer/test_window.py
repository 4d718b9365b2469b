"""The window on SDL's dummy driver: real SDL events, no screen."""

import ctypes
import os
import subprocess
import sys
import time

import numpy as np
import pytest

import engine3d as e3d
from engine3d.viewer import input as events
from engine3d.viewer.settings import Settings
from engine3d.viewer.view_renderer import ViewRenderer
from engine3d.viewer.viewed_scene import ViewedScene
from engine3d.viewer.viewer import Viewer
from engine3d.viewer.window import Window, _is_opengl_on_the_cpu, find_screen, load_sdl

sdl2 = load_sdl()


@pytest.fixture
def window(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window("test", 160, 120, vsync=False) as window:
        window.events()
        yield window


def push(kind, **fields):
    """Put an event into SDL's queue; a field is named like ``key__keysym__sym``."""
    event = sdl2.SDL_Event()
    event.type = kind
    for name, value in fields.items():
        *path, last = name.split("__")
        target = event
        for step in path:
            target = getattr(target, step)
        setattr(target, last, value)
    assert sdl2.SDL_PushEvent(event) == 1


def push_key(symbol, scancode):
    push(sdl2.SDL_KEYDOWN, key__keysym__sym=symbol, key__keysym__scancode=scancode)
    push(sdl2.SDL_KEYUP, key__keysym__sym=symbol, key__keysym__scancode=scancode)


def shown_pixels(window):
    """Return what the window shows, read back from SDL."""
    width, height = window.size
    pixels = np.empty((height, width, 4), dtype=np.uint8)
    form = sdl2.SDL_PIXELFORMAT_RGBA32
    status = sdl2.SDL_RenderReadPixels(
        window._renderer, None, form, pixels.ctypes.data_as(ctypes.c_void_p), width * 4
    )
    assert status == 0
    return pixels


def test_the_window_shows_the_bytes_it_is_given(window):
    picture = np.random.default_rng(0).integers(0, 256, (120, 160, 4), dtype=np.uint8)
    picture[..., 3] = 255
    window.present(picture)
    np.testing.assert_array_equal(shown_pixels(window)[..., :3], picture[..., :3])


def test_another_size_of_picture_is_fine(window):
    window.present(np.full((30, 40, 4), 200, dtype=np.uint8))
    window.present(np.full((120, 160, 4), 100, dtype=np.uint8))
    assert (shown_pixels(window)[..., :3] == 100).all()


def test_pushed_events_come_out_translated(window):
    push_key(sdl2.SDLK_h, sdl2.SDL_SCANCODE_H)
    push(sdl2.SDL_QUIT)
    received = window.events()
    assert events.KeyDown("H", "H") in received
    assert any(isinstance(event, events.CloseRequested) for event in received)
    assert window.events() == []


def test_a_resize_is_reported(window):
    sdl2.SDL_SetWindowSize(window._window, 200, 150)
    assert events.Resized(200, 150) in window.events(0.1)
    assert window.size == (200, 150)


def test_a_viewer_draws_turns_and_quits(window):
    scene = e3d.Scene((10, 20, 30))
    scene.add(e3d.box())
    view_renderer = ViewRenderer(ViewedScene(scene, "box"), Settings({}), window.size)
    viewer = Viewer(view_renderer, window)
    push(sdl2.SDL_MOUSEBUTTONDOWN, button__button=sdl2.SDL_BUTTON_LEFT)
    push(sdl2.SDL_MOUSEMOTION, motion__xrel=20, motion__yrel=5)
    viewer.run(frames=1)
    assert viewer.view.azimuth < viewer.first_view.azimuth
    np.testing.assert_array_equal(shown_pixels(window)[..., :3], viewer.frame.color[..., :3])
    push_key(sdl2.SDLK_q, sdl2.SDL_SCANCODE_Q)
    viewer.run()
    assert not viewer.running


def test_closing_twice_and_opening_again(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for _ in range(2):
        window = Window("again", 64, 64, vsync=False)
        window.close()
        window.close()


def test_without_a_screen_the_error_says_so(monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(e3d.DisplayError, match="no screen"):
        find_screen()
    with pytest.raises(e3d.DisplayError, match="no screen"):
        Window("nowhere", 64, 64)


def test_a_screen_that_does_not_answer_is_no_screen(monkeypatch):
    monkeypatch.setenv("DISPLAY", ":9731")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.delenv("SDL_VIDEODRIVER", raising=False)
    with pytest.raises(e3d.DisplayError, match="no screen"):
        Window("nowhere", 64, 64)


def test_loading_sdl_prints_nothing():
    code = "from engine3d.viewer.window import load_sdl; load_sdl()"
    environment = {**os.environ, "SDL_VIDEODRIVER": "dummy"}
    done = subprocess.run(
        [sys.executable, "-W", "default", "-c", code],
        capture_output=True,
        text=True,
        env=environment,
        check=True,
    )
    assert "pysdl2" not in done.stderr.lower()


class OpenGL:
    """As much of SDL as tells which OpenGL it uses."""

    def __init__(self, name):
        self._name = None if name is None else ctypes.create_string_buffer(name)
        address = None if name is None else ctypes.addressof(self._name)
        self._get_string = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint)(lambda _: address)

    def SDL_GL_GetCurrentContext(self):
        return 1

    def SDL_GL_GetProcAddress(self, name):
        assert name == b"glGetString"
        return ctypes.cast(self._get_string, ctypes.c_void_p).value


@pytest.mark.parametrize(
    ("name", "on_the_cpu"),
    [
        (b"llvmpipe (LLVM 15.0.6, 256 bits)", True),
        (b"Google SwiftShader", True),
        (b"NVIDIA GeForce RTX 3060/PCIe/SSE2", False),
        (b"Mesa Intel(R) UHD Graphics 620 (KBL GT2)", False),
        (None, False),
    ],
)
def test_opengl_without_a_graphics_card_is_told_by_its_name(monkeypatch, name, on_the_cpu):
    monkeypatch.delenv("SDL_RENDER_DRIVER", raising=False)
    assert _is_opengl_on_the_cpu(OpenGL(name)) is on_the_cpu
    monkeypatch.setenv("SDL_RENDER_DRIVER", "opengl")
    assert not _is_opengl_on_the_cpu(OpenGL(name))


def test_vertical_sync_keeps_the_screens_rhythm(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    pixels = np.zeros((64, 64, 4), np.uint8)
    with Window("test", 64, 64, vsync=True) as window:
        window.present(pixels)
        start = time.perf_counter()
        for _ in range(12):
            window.present(pixels)
        assert time.perf_counter() - start > 11 / window.refresh_rate * 0.9

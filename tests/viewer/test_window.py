"""The window on SDL's dummy driver: real SDL events, no screen."""

import ctypes
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from missing_here import needs_no_screen

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.icon import FACES, icon
from engine3d.apps.viewer.presenting.surface_output import SurfaceOutput
from engine3d.apps.viewer.sdl import (
    BORDER_SECONDS,
    find_screen,
    is_opengl_on_the_cpu,
    load_sdl,
    refresh_rate,
)
from engine3d.apps.viewer.viewer import Viewer
from engine3d.apps.viewer.window import POINTERS, Window
from engine3d.stage.overlays.lettering import text_font
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

sdl2 = load_sdl()


@pytest.fixture
def window(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window((160, 120), "test", vsync=False) as window:
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
    surface = sdl2.SDL_GetWindowSurface(window._window).contents
    assert surface.format.contents.format == sdl2.SDL_PIXELFORMAT_RGB888
    memory = ctypes.string_at(surface.pixels, surface.pitch * surface.h)
    rows = np.frombuffer(memory, np.uint8).reshape(surface.h, surface.pitch)
    return rows[:, : 4 * surface.w].reshape(surface.h, surface.w, 4)[..., [2, 1, 0, 3]]


def test_the_window_shows_the_bytes_it_is_given(window):
    picture = np.random.default_rng(0).integers(0, 256, (120, 160, 4), dtype=np.uint8)
    picture[..., 3] = 255
    window.present(picture)
    np.testing.assert_array_equal(shown_pixels(window)[..., :3], picture[..., :3])


def test_another_size_of_picture_is_fine(window):
    window.present(np.full((30, 40, 4), 200, dtype=np.uint8))
    window.present(np.full((120, 160, 4), 100, dtype=np.uint8))
    assert (shown_pixels(window)[..., :3] == 100).all()


def test_pictures_of_all_kinds_are_shown(window):
    rgba = np.random.default_rng(1).integers(0, 256, (120, 160, 4), dtype=np.uint8)
    rgba[..., 3] = 255
    red, green, blue = (rgba[..., channel].astype(np.uint32) for channel in range(3))
    frame = e3d.render(e3d.Scene((9, 8, 7)), size=(160, 120))
    grey = rgba[..., 0]
    for picture, format, expected in [
        (rgba, None, rgba),
        (rgba[..., :3], None, rgba),
        (e3d.Canvas(rgba), None, rgba),
        (frame, None, frame.color),
        (grey, None, np.repeat(grey[..., None], 3, axis=2)),
        (rgba[..., [2, 1, 0, 3]], "bgra", rgba),
        (red << 16 | green << 8 | blue, "bgra", rgba),
        (blue << 16 | green << 8 | red | 0xFF000000, "rgba", rgba),
        (rgba[::-1, ::-1], None, rgba[::-1, ::-1]),
    ]:
        window.present(picture, format)
        np.testing.assert_array_equal(shown_pixels(window)[..., :3], expected[..., :3])


@pytest.mark.parametrize(
    ("picture", "format", "said"),
    [
        (np.zeros((4, 4), np.uint32), None, 'needs its format: "bgra" if words are 0xAARRGGBB'),
        (np.zeros((4, 4, 3), np.float32), None, "this one is \\(4, 4, 3\\) float32"),
        (np.zeros((4, 4, 2), np.uint8), None, "this one is \\(4, 4, 2\\) uint8"),
        (np.zeros((0, 4, 4), np.uint8), None, "no pixels"),
        (np.zeros((4, 4, 4), np.uint8), "argb", "format must be one of .rgba., .bgra."),
        ("a picture", None, "picture (is|must be) a Frame"),
    ],
)
def test_what_is_no_picture_is_told(window, picture, format, said):
    with pytest.raises(e3d.InvalidArgumentError, match=said):
        window.present(picture, format)


def test_a_picture_of_other_proportions_is_in_the_middle_and_so_is_the_mouse(window):
    window.present(np.full((30, 80, 4), 200, dtype=np.uint8))
    pixels = shown_pixels(window)[..., 0]
    assert (pixels[30:90] == 200).all() and not pixels[:30].any() and not pixels[90:].any()
    push(sdl2.SDL_MOUSEMOTION, motion__x=100, motion__y=40, motion__xrel=2, motion__yrel=0)
    assert window.events() == [events.MouseMotion(2, 0, 50, 5)]
    assert window.mouse == (50, 5)


def test_keys_and_buttons_that_are_down_are_known(window):
    push(sdl2.SDL_KEYDOWN, key__keysym__sym=sdl2.SDLK_z, key__keysym__scancode=sdl2.SDL_SCANCODE_W)
    push(sdl2.SDL_MOUSEBUTTONDOWN, button__button=sdl2.SDL_BUTTON_RIGHT)
    window.events()
    assert (window.keys, window.positions, window.buttons) == ({"Z"}, {"W"}, {"right"})
    push(sdl2.SDL_KEYUP, key__keysym__sym=sdl2.SDLK_z, key__keysym__scancode=sdl2.SDL_SCANCODE_W)
    push(sdl2.SDL_MOUSEBUTTONUP, button__button=sdl2.SDL_BUTTON_RIGHT)
    window.events()
    assert (window.keys, window.positions, window.buttons) == (set(), set(), set())
    push(sdl2.SDL_KEYDOWN, key__keysym__sym=sdl2.SDLK_a)
    push(sdl2.SDL_WINDOWEVENT, window__event=sdl2.SDL_WINDOWEVENT_FOCUS_LOST)
    window.events()
    assert window.keys == set()
    push(sdl2.SDL_WINDOWEVENT, window__event=sdl2.SDL_WINDOWEVENT_LEAVE)
    assert window.events() == [events.MouseLeft()] and window.mouse is None


def test_ticks_come_as_often_as_asked_for_and_tell_the_time(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    ticks = []
    with Window((64, 64), max_fps=50, vsync=False) as window:
        for event in window:
            if isinstance(event, events.Tick):
                ticks.append(event)
                window.present(np.zeros((64, 64, 4), np.uint8))
                if len(ticks) == 12:
                    break
        assert 10 < window.fps <= 51
    assert ticks[0] == events.Tick(0.0, 0.0)
    assert all(tick.dt >= 1 / 50 for tick in ticks[1:])
    assert ticks[-1].time == pytest.approx(sum(tick.dt for tick in ticks))


def test_a_waiting_window_has_no_ticks_and_ends_when_it_is_closed(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    received = []
    with Window((64, 64), wait=True) as window:
        for event in window:
            received.append(event)
            if len(received) == 1:
                push_key(sdl2.SDLK_a, sdl2.SDL_SCANCODE_A)
                push(sdl2.SDL_QUIT)
        assert window.closed
    kinds = [type(event) for event in received]
    assert events.Tick not in kinds
    assert kinds[-3:] == [events.KeyDown, events.KeyUp, events.CloseRequested]


def test_closing_in_the_loop_ends_it(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    window = Window((64, 64))
    count = 0
    for _ in window:
        count += 1
        window.close()
    assert count == 1
    with pytest.raises(e3d.InvalidArgumentError, match="the window is closed"):
        window.present(np.zeros((4, 4, 4), np.uint8))


def test_each_of_several_windows_gets_its_own_events(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window((64, 64), "one") as one, Window((64, 64), "two") as two:
        one.events(), two.events()
        number = sdl2.SDL_GetWindowID(two._window)
        push(sdl2.SDL_KEYDOWN, key__keysym__sym=sdl2.SDLK_a, key__windowID=number)
        close = sdl2.SDL_WINDOWEVENT_CLOSE
        push(sdl2.SDL_WINDOWEVENT, window__event=close, window__windowID=number)
        assert one.events() == []
        assert [type(event) for event in two.events()] == [events.KeyDown, events.CloseRequested]


@pytest.mark.parametrize(
    ("arguments", "options", "said"),
    [
        (((0, 10),), {}, "width must be"),
        ((10,), {}, r"size must be \(width, height\), not 10"),
        (((10, 20), 3), {}, "title must be a str"),
        (((10, 20),), {"max_fps": 0}, "max_fps must be a"),
        (((10, 20),), {"max_fps": "many"}, "max_fps must be a"),
    ],
)
def test_what_makes_no_window_is_told(arguments, options, said):
    with pytest.raises(e3d.InvalidArgumentError, match=said):
        Window(*arguments, **options)


def test_the_title_can_be_changed(window):
    window.title = "größer"
    assert window.title == "größer"
    assert sdl2.SDL_GetWindowTitle(window._window).decode() == "größer"


def test_a_text_is_copied_and_pasted(window):
    window.clipboard = "Grüße, 語"
    assert window.clipboard == "Grüße, 語"


def test_the_pointer_takes_every_shape(window):
    for shape in (*POINTERS, None, "arrow"):
        window.show_pointer(shape)
        assert sdl2.SDL_ShowCursor(sdl2.SDL_QUERY) == (shape is not None)
    with pytest.raises(e3d.InvalidArgumentError, match="size_nwse"):
        window.show_pointer("paw")


def test_the_icon_is_a_cube_on_nothing():
    pixels = icon()
    assert not pixels[[0, 0, -1, -1], [0, -1, 0, -1], 3].any()
    colors = {tuple(color) for color in pixels[pixels[..., 3] == 255].tolist()}
    assert colors == {(*color, 255) for _, color in FACES}


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
        window = Window((64, 64), "again", vsync=False)
        window.close()
        window.close()


@needs_no_screen
def test_without_a_screen_the_error_says_so(monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(e3d.errors.DisplayError, match="no screen"):
        find_screen()
    with pytest.raises(e3d.errors.DisplayError, match="no screen"):
        Window((64, 64), "nowhere")


@needs_no_screen
def test_a_screen_that_does_not_answer_is_no_screen(monkeypatch):
    monkeypatch.setenv("DISPLAY", ":9731")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.delenv("SDL_VIDEODRIVER", raising=False)
    with pytest.raises(e3d.errors.DisplayError, match="no screen"):
        Window((64, 64), "nowhere")


def test_loading_sdl_prints_nothing():
    code = "from engine3d.apps.viewer.sdl import load_sdl; load_sdl()"
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
    assert is_opengl_on_the_cpu(OpenGL(name)) is on_the_cpu
    monkeypatch.setenv("SDL_RENDER_DRIVER", "opengl")
    assert not is_opengl_on_the_cpu(OpenGL(name))


def test_vertical_sync_keeps_the_screens_rhythm(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    pixels = np.zeros((64, 64, 4), np.uint8)
    with Window((64, 64), "test", vsync=True) as window:
        window.present(pixels)
        start = time.perf_counter()
        for _ in range(12):
            window.present(pixels)
        assert time.perf_counter() - start > 11 / refresh_rate(sdl2, window._window) * 0.9


@pytest.fixture
def fine_window(monkeypatch):
    """A window whose drawable area is twice its size, as on a fine screen of Wayland or macOS."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    usual = SurfaceOutput.size

    def twice(output):
        width, height = usual.fget(output)
        return 2 * width, 2 * height

    monkeypatch.setattr(SurfaceOutput, "size", property(twice))
    with Window((400, 300), "test", vsync=False) as window:
        window.events()
        yield window


def test_on_a_fine_screen_pictures_have_all_pixels_and_the_mouse_counts_them(fine_window):
    assert fine_window.size == (800, 600) and fine_window.scale == 2
    fine_window.present(np.zeros((600, 800, 4), np.uint8))
    push(sdl2.SDL_MOUSEMOTION, motion__x=100, motion__y=299, motion__xrel=3, motion__yrel=-2)
    push(sdl2.SDL_MOUSEBUTTONDOWN, button__button=1, button__x=200, button__y=150)
    push(sdl2.SDL_MOUSEWHEEL, wheel__y=1, wheel__mouseX=10, wheel__mouseY=20)
    moved, pressed, turned = fine_window.events()
    assert moved == events.MouseMotion(6, -4, 200, 598)
    assert (pressed.x, pressed.y) == (400, 300)
    assert (turned.x, turned.y) == (20, 40)
    fine_window.present(np.zeros((300, 400, 4), np.uint8))  # a canvas that knows nothing of it
    push(sdl2.SDL_MOUSEMOTION, motion__x=100, motion__y=200, motion__xrel=1, motion__yrel=1)
    (moved,) = fine_window.events()
    assert (moved.x, moved.y) == (100, 200)


def test_positions_of_keys_have_the_layout_s_names(window, monkeypatch):
    assert [window.key_at(place) for place in ("W", "Left", "7", "no key")] == [
        *("W", "Left", "7", "no key")
    ]
    monkeypatch.setattr(sdl2, "SDL_GetKeyFromScancode", lambda code: {26: ord("z")}.get(code, 0))
    monkeypatch.setattr(window, "_sdl", sdl2)
    assert (window.key_at("W"), window.key_at("A")) == ("Z", "A")


def test_a_captured_mouse_counts_its_own_steps(fine_window, monkeypatch):
    monkeypatch.setattr(sdl2, "SDL_GetRelativeMouseMode", lambda: True)
    push(sdl2.SDL_MOUSEMOTION, motion__x=1, motion__y=1, motion__xrel=3, motion__yrel=-2)
    (moved,) = fine_window.events()
    assert (moved.dx, moved.dy) == (3, -2)


def test_texts_and_lists_are_twice_as_large_on_a_fine_screen(fine_window):
    scene = e3d.Scene()
    scene.add(e3d.box(), name="box")
    view_renderer = ViewRenderer(ViewedScene(scene, "test"), Settings({}), (400, 300))
    viewer = Viewer(view_renderer, fine_window)
    viewer.handle(events.KeyDown("O", "O"))
    viewer.draw()
    assert viewer.frame.color.shape == (600, 800, 4)
    assert view_renderer.text_scale(viewer.frame.canvas()) == 2
    assert viewer.panel._row_height == text_font(2).line_height == 35
    push(sdl2.SDL_MOUSEBUTTONDOWN, button__button=1, button__x=200, button__y=150)
    push(sdl2.SDL_MOUSEBUTTONUP, button__button=1, button__x=200, button__y=150)
    viewer.run_once()
    assert viewer.selected.node.name == "box"
    view_renderer.screen_scale = 1
    viewer.handle(events.Resized(400, 300))
    assert view_renderer.screen_scale == 2


class FramedScreen:
    """SDL, but that its screen has another size, a bar at the top, and frames windows, maybe late.

    Parameters
    ----------
    late : int
        How often borders are unknown before they are told.
    """

    def __init__(self, sdl, bar, size, borders, late=0):
        self._sdl, self._bar, self._size, self._borders = sdl, bar, size, borders
        self._late = late

    def SDL_GetCurrentVideoDriver(self):
        return b"x11"

    def __getattr__(self, name):
        return getattr(self._sdl, name)

    def SDL_GetDisplayUsableBounds(self, screen, area):
        area.x, area.y, area.w, area.h = 0, self._bar, *self._size
        return 0

    def SDL_GetWindowBordersSize(self, window, *borders):
        self._late -= 1
        if self._late >= 0:
            return 0
        for pointer, border in zip(borders, self._borders, strict=True):
            pointer._obj.value = border
        return 0


@pytest.mark.parametrize(
    "asked, size",
    [
        ((640, 480), (592, 366)),
        ((300, 480), (300, 366)),
        ((640, 200), (592, 200)),
        ((592, 366), (592, 366)),
        ((100, 80), (100, 80)),
    ],
)
def test_a_window_fits_the_screen_with_its_borders(asked, size, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window(asked) as window:
        window._sdl = FramedScreen(window._sdl, 10, (600, 400), (30, 4, 4, 4))
        window.fit_to_screen()
        assert window.size == size
        if asked != size:
            x, y = ctypes.c_int(), ctypes.c_int()
            window._sdl.SDL_GetWindowPosition(window._window, x, y)
            assert (x.value, y.value) == (4 + (592 - size[0]) // 2, 40 + (366 - size[1]) // 2)


def test_a_window_waits_for_the_title_bar_that_its_manager_adds(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window((640, 480)) as window:
        window._sdl = FramedScreen(window._sdl, 0, (640, 480), (30, 4, 4, 4), late=5)
        window.fit_to_screen()
        assert window.size == (632, 446)


def test_without_a_window_manager_a_window_waits_for_no_title_bar_long(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with Window((640, 480)) as window:
        window._sdl = FramedScreen(window._sdl, 0, (640, 480), (0, 0, 0, 0))
        start = time.monotonic()
        window.fit_to_screen()
        assert window.size == (640, 480)
        assert time.monotonic() - start >= BORDER_SECONDS
        window._sdl = FramedScreen(window._sdl, 0, (1000, 1000), (0, 0, 0, 0))
        monkeypatch.setattr(FramedScreen, "SDL_GetWindowBordersSize", None)
        window.fit_to_screen()  # it fits with any title bar

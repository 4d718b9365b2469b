"""The scale of screens, and windows and pictures that follow it."""

import shutil
import subprocess
import sys
from unittest.mock import Mock

import numpy as np
import pytest
from desktop import virtual_screen

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer import screen_scale as scales
from engine3d.apps.viewer import x11_errors
from engine3d.apps.viewer.program_window import ProgramWindow
from engine3d.apps.viewer.screen_scale import screen_scale, x11_scale
from engine3d.apps.viewer.viewer import Viewer
from engine3d.rendering.canvas import Canvas
from engine3d.stage.overlays.lettering import text_font
from engine3d.stage.overlays.overlay import draw_block
from engine3d.stage.overlays.ui_scale import scale_for
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene


@pytest.mark.parametrize(
    ("told", "set_dpi", "measured_dpi", "scale"),
    [
        ({}, 0, 0, 1),
        ({}, 96, 200, 1),
        ({}, 192, 96, 2),
        ({}, 120, 0, 1.25),
        ({}, 144, 0, 1.5),
        ({}, 72, 0, 0.75),
        ({}, 5000, 0, 4),
        ({"GDK_SCALE": "2"}, 0, 96, 2),
        ({"GDK_SCALE": "2"}, 192, 96, 2),
        ({"GDK_SCALE": "2", "GDK_DPI_SCALE": "0.5"}, 192, 96, 2),
        ({"GDK_SCALE": "2", "GDK_DPI_SCALE": "0.75"}, 0, 96, 1.5),
        ({"GDK_DPI_SCALE": "1.25"}, 96, 96, 1.25),
        ({"GDK_SCALE": "many", "GDK_DPI_SCALE": "-1"}, 0, 192, 2),
        ({"GDK_SCALE": "inf"}, 0, 96, 1),
        ({}, 0, 191.7, 2),  # of a size in whole millimetres
        ({}, 0, 109, 1),
        ({}, 0, 141, 1.25),
        ({}, 0, 30, 1),
        ({}, 0, 1000, 1),
    ],
)
def test_the_user_s_settings_tell_the_scale_before_the_screen_s_size(
    told, set_dpi, measured_dpi, scale
):
    assert x11_scale(told, set_dpi, (0.0, measured_dpi)) == scale
    assert x11_scale(told, set_dpi, (measured_dpi, 1000.0)) == scale


class Driver:
    """As much of SDL as tells how fine a screen is."""

    def __init__(self, name, dpi):
        self._name, self._dpi = name, dpi

    def SDL_GetCurrentVideoDriver(self):
        return self._name

    def SDL_GetDisplayDPI(self, display, diagonal, across, down):
        across._obj.value = self._dpi or 0.0
        return 0 if self._dpi else -1


@pytest.mark.parametrize(
    ("name", "dpi", "scale"),
    [
        (b"windows", 96, 1),
        (b"windows", 120, 1.25),
        (b"windows", 168, 1.75),
        (b"windows", None, 1),
        (b"wayland", 192, 1),
        (b"cocoa", 220, 1),
        (b"x11", 192, 2),
    ],
)
def test_each_system_tells_the_scale_in_its_way(name, dpi, scale, monkeypatch):
    for variable in ("GDK_SCALE", "GDK_DPI_SCALE"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr(scales, "x11_dpi", lambda display: (0.0, 96.0))
    assert screen_scale(Driver(name, dpi), 0) == scale


def test_x11_without_its_library_tells_what_sdl_knows(monkeypatch):
    """As on macOS, whose X server has the library under another name."""
    for variable in ("GDK_SCALE", "GDK_DPI_SCALE"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr(scales.ctypes, "CDLL", Mock(side_effect=OSError))
    monkeypatch.setattr(scales, "x11_dpi", scales.x11_dpi.__wrapped__)
    assert scales.x11_dpi(":0") == (0.0, 0.0)
    assert screen_scale(Driver(b"x11", 192), 0) == 2
    assert screen_scale(Driver(b"x11", None), 0) == 1


def test_no_system_needs_x11(monkeypatch):
    monkeypatch.setattr(x11_errors.ctypes, "CDLL", Mock(side_effect=OSError))
    monkeypatch.setattr(x11_errors, "_installed", [])
    x11_errors.forgive_late_messages()
    assert not x11_errors._installed


@pytest.mark.parametrize(
    ("size", "screen", "scale"),
    [
        ((1280, 720), 1, 1),
        ((1366, 768), 1, 1),
        ((1920, 1080), 1, 1.5),
        ((2560, 1440), 1, 2),
        ((3840, 2160), 1, 2),
        ((3840, 2160), 2.5, 2.5),
        ((1280, 720), 1.25, 1.25),
        ((1280, 720), 0.75, 0.75),
        ((400, 720), 2, 1.25),
        ((200, 2000), 2, 1),
        ((20000, 10000), 9, 4),
    ],
)
def test_texts_follow_the_screen_and_the_picture(size, screen, scale):
    assert scale_for(*size, screen) == scale


@pytest.mark.parametrize("scale", [1.25, 1.5, 2, 3])
def test_blocks_of_text_grow_as_a_whole(scale):
    def block(at):
        canvas = Canvas((1200, 300))
        draw_block(canvas, ["Hxx", "xxx"], scale=at)
        rows, columns = np.nonzero((canvas.pixels != Canvas((1, 1)).pixels).any(axis=2))
        return [rows.min(), columns.min(), np.ptp(rows) + 1, np.ptp(columns) + 1]

    for small, large in zip(block(1), block(scale), strict=True):
        assert abs(large - scale * small) <= 2 * scale


def edges(font):
    """The alphas of a row of letters whose stems are upright, row by row."""
    canvas = Canvas((400, 100))
    canvas.text(4, 0, "xzxz", "white", font=font)
    return canvas.pixels[..., 0].max(axis=1)


@pytest.mark.parametrize("scale", [0.5, 0.75, 1, 1.25, 1.5, 1.75, 2, 3, 4])
def test_texts_are_sharp_at_every_scale(scale):
    rows = edges(text_font(scale))
    inked = np.flatnonzero(rows)
    assert rows[inked[0]] > 150 and rows[inked[-1]] > 150


def a_box():
    scene = e3d.Scene()
    scene.add(e3d.box(), name="box")
    return ViewedScene(scene, "test")


def test_a_click_may_move_farther_on_a_fine_screen(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    selected = {}
    for scale in (1.0, 2.0):
        with (
            ProgramWindow((640, 480), (640, 480), "test", ui_scale=scale) as window,
            ViewRenderer(a_box(), Settings({}), window.size) as view_renderer,
        ):
            viewer = Viewer(view_renderer, window)
            viewer.draw()
            viewer.handle(events.MouseButton("left", True, x=320, y=240))
            viewer.handle(events.MouseMotion(6, 0, 326, 240))
            viewer.handle(events.MouseButton("left", False, x=326, y=240))
            selected[scale] = viewer.selected
    assert selected[1.0] is None and selected[2.0] is not None


@pytest.mark.parametrize(
    ("asked", "ui_scale", "size"),
    [
        (None, None, (200, 100)),
        (None, 1.5, (300, 150)),
        (None, 0.5, (200, 100)),
        ((90, 80), 2, (90, 80)),
    ],
)
def test_a_program_s_window_grows_with_the_scale(asked, ui_scale, size, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with ProgramWindow(asked, (200, 100), "test", ui_scale=ui_scale) as window:
        assert window.size == size
        assert window.scale == (ui_scale or 1.0)


def test_a_program_s_window_is_not_larger_than_the_screen(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with ProgramWindow(None, (1000, 700), "test", ui_scale=4) as window:
        assert window.size == (1024, 768)  # of the dummy screen


TELL = """
from engine3d.apps.viewer.program_window import ProgramWindow
with ProgramWindow(None, (400, 300), "test") as window:
    print(window.scale, *window.size)
"""


@pytest.mark.slow
@pytest.mark.skipif(not all(map(shutil.which, ("Xvfb", "xprop"))), reason="needs Xvfb, xprop")
@pytest.mark.parametrize(
    ("resources", "variables", "told"),
    [
        ("Xft.dpi: 192", {}, "2.0 800 600"),
        ("*dpi: 120", {}, "1.25 500 375"),
        ("Xft.antialias: 1", {"GDK_SCALE": "2", "GDK_DPI_SCALE": "0.75"}, "1.5 600 450"),
    ],
)
def test_a_window_follows_the_settings_of_its_x_server(resources, variables, told, tmp_path):
    xprop = ["xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER"]
    with virtual_screen(1024, 768) as screen:
        environment = {**screen.environment(), **variables}
        subprocess.run([*xprop, resources], env=environment, check=True)
        done = subprocess.run(
            [sys.executable, "-c", TELL], env=environment, capture_output=True, text=True
        )
    assert (done.stdout.strip(), done.stderr) == (told, "")

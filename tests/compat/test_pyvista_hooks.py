"""`install` in the place of VTK's drawing, and the entry point, in a process without OpenGL."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from compat.plotters import SIZE, plotter, without_opengl

import engine3d as e3d

pv = pytest.importorskip("pyvista", exc_type=ImportError)
if not hasattr(pv, "register_plotter_component"):
    pytest.skip("components of plotters came with PyVista 0.48", allow_module_level=True)

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def installed():
    without_opengl()
    from engine3d.compat import pyvista as door

    door.install()
    yield door
    door.uninstall()


def test_show_and_screenshot(installed, tmp_path):
    pl = plotter()
    pl.add_mesh(pv.Cube(), color="red")
    expected = pl.engine3d.screenshot()
    camera, pixels = pl.show(
        screenshot=tmp_path / "a.png", return_img=True, return_cpos=True, auto_close=False
    )
    assert (tmp_path / "a.png").stat().st_size > 100
    assert np.array_equal(pixels, expected)
    assert np.allclose(camera.focal_point, 0.0)
    assert pl.screenshot(None, transparent_background=True).shape == (SIZE[1], SIZE[0], 4)
    assert pl.screenshot(None, scale=2).shape == (2 * SIZE[1], 2 * SIZE[0], 3)
    assert np.array_equal(pl.image[..., :3], expected)
    pl.close()
    options = {"window_size": SIZE, "return_img": True, "show_axes": False}
    picture = pv.Cube().plot(off_screen=True, color="red", **options)
    assert np.array_equal(picture, expected)


@pytest.mark.parametrize("is_parallel", [False, True])
def test_depths_are_negative_distances(installed, is_parallel):
    pl = plotter()
    pl.add_mesh(pv.Plane(i_size=4, j_size=4))
    pl.camera_position = [(0, 0, 3), (0, 0, 0), (0, 1, 0)]
    if is_parallel:
        pl.enable_parallel_projection()
    pl.show(auto_close=False)
    depth = pl.get_image_depth()
    assert np.allclose(depth[np.isfinite(depth)], -3.0, rtol=1e-3)
    assert np.isfinite(depth).any()


@pytest.mark.parametrize("goes_on", [False, True])
def test_a_window_without_a_display_is_told(installed, monkeypatch, goes_on):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    pl = plotter(off_screen=False)
    pl.add_mesh(pv.Cube())
    with pytest.warns(e3d.errors.Engine3DWarning, match="not shown"):
        pl.show(interactive_update=goes_on)
    if goes_on:
        pl.update()
        pl.close()


class FakeWindow:
    """Keeps what is presented; tells events that a test puts into ``waiting``."""

    def __init__(self, size, title):
        self.size, self.title, self.closed = size, title, False
        self.pictures, self.waiting = [], []

    def present(self, pixels):
        assert not self.closed
        self.pictures.append(pixels)

    def events(self):
        found, self.waiting = self.waiting, []
        return found

    def close(self):
        self.closed = True


def test_a_window_stays_open_while_the_program_goes_on(installed, monkeypatch):
    from engine3d.compat.pyvista import _live_window

    opened = []

    def opens(*how):
        opened.append(FakeWindow(*how))
        return opened[-1]

    def update():
        pv.Plotter.last_update_time = 0.0  # of the last time that something was drawn
        pl.update()
        return window.pictures[-1]

    monkeypatch.setattr(_live_window, "Window", opens)
    pl = plotter(off_screen=False, title="Live")
    actor = pl.add_mesh(pv.Cube(), color="red", lighting=False)
    pl.show(interactive_update=True)
    (window,) = opened
    assert (window.size, window.title) == (SIZE, "Live")
    assert np.array_equal(window.pictures[-1], pl.screenshot())
    actor.prop.color = "blue"
    assert (update()[..., 2] > 200).any() and not (update()[..., 0] == 255).all()
    before = pl.camera.position
    middle = {"x": SIZE[0] // 2, "y": SIZE[1] // 2}
    window.waiting = [
        e3d.events.MouseButton("left", True, **middle),
        e3d.events.MouseMotion(20, 9, x=middle["x"] + 20, y=middle["y"] + 9),
        e3d.events.MouseButton("left", False, x=middle["x"] + 20, y=middle["y"] + 9),
    ]
    update()
    turned = pl.camera.position
    assert not np.allclose(turned, before)
    window.waiting = [e3d.events.Wheel(1.0, **middle)]
    update()
    assert np.linalg.norm(pl.camera.position) < np.linalg.norm(turned)
    window.waiting = [e3d.events.Resized(60, 50)]
    assert update().shape == (50, 60, 3)
    pl.close()
    assert window.closed


def test_a_window_that_the_user_closed_stays_closed(installed, monkeypatch):
    from engine3d.compat.pyvista import _live_window

    monkeypatch.setattr(_live_window, "Window", FakeWindow)
    pl = plotter(off_screen=False)
    pl.show(interactive_update=True)
    window = pl.render_window.live._window
    window.waiting = [e3d.events.CloseRequested()]
    for _ in range(2):
        pv.Plotter.last_update_time = 0.0
        pl.update()
    assert window.closed and len(window.pictures) == 1
    pl.close()


def test_uninstall_puts_back_what_was_there():
    from pyvista.plotting import plotter as module

    from engine3d.compat import pyvista as door

    before = module.image_from_window, module.run_image_filter
    door.install()
    door.install()
    assert module.image_from_window is not before[0]
    door.uninstall()
    door.uninstall()
    assert (module.image_from_window, module.run_image_filter) == before


def test_pyvista_finds_the_component_and_loads_no_opengl(tmp_path):
    """By the line of pyproject.toml, in metadata as pip writes it."""
    line = 'engine3d = "engine3d.compat.pyvista"'
    group = '[project.entry-points."pyvista.plotter_components"]'
    assert f"{group}\n{line}\n" in (ROOT / "pyproject.toml").read_text("utf-8")
    metadata = tmp_path / "component-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: component\nVersion: 1.0\n")
    points = f"[pyvista.plotter_components]\n{line}\n".replace('"', "")
    (metadata / "entry_points.txt").write_text(points)
    code = (
        f"import os, sys; sys.path.insert(0, {str(tmp_path)!r})\n"
        "os.environ['VTK_DEFAULT_OPENGL_WINDOW'] = 'vtkOSOpenGLRenderWindow'\n"
        "import pyvista as pv\n"
        "pl = pv.Plotter(off_screen=True, window_size=(40, 30)); pl.add_mesh(pv.Sphere())\n"
        "print(pl.engine3d.screenshot().shape)\n"
        "maps = open('/proc/self/maps').read() if sys.platform == 'linux' else ''\n"
        "print('libEGL' in maps or 'libGLX' in maps)\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "(30, 40, 3)\nFalse\n"


def test_depth_peeling_asks_no_opengl(installed):
    pl = plotter()
    pl.add_mesh(pv.Sphere(), opacity=0.5)
    assert pl.enable_depth_peeling()
    assert pl.renderer.GetUseDepthPeeling()
    assert pl.screenshot().shape == (SIZE[1], SIZE[0], 3)


@pytest.mark.parametrize(
    ("system", "is_found", "is_set"),
    [
        ("linux", False, True),
        ("linux", True, False),
        ("darwin", False, False),
        ("win32", False, False),
    ],
)
def test_opengl_is_missing_on_linux_alone(monkeypatch, system, is_found, is_set):
    from engine3d.compat.pyvista import _windows

    monkeypatch.delenv(_windows.VARIABLE, raising=False)
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(_windows, "_is_found", lambda name: is_found)
    _windows.prefer_no_opengl()
    assert (_windows.VARIABLE in os.environ) == is_set
    os.environ.pop(_windows.VARIABLE, None)

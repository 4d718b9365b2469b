"""`engine3d.show`: scenes in the viewer, pictures in a window, and what is left afterwards."""

import subprocess
import sys

import numpy as np
import pytest
from missing_here import needs_no_screen
from motion.moving_model import flag

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer import show as module
from engine3d.apps.viewer.picture_window import PictureView, PictureWindow, fitting_size
from engine3d.apps.viewer.viewer import Viewer
from engine3d.apps.viewer.window import Window


@pytest.fixture
def shown(monkeypatch):
    """What the viewers were made of that opened, on SDL's dummy driver; each shows three frames."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    viewers = []
    run = Viewer.run

    def run_shortly(viewer):
        viewers.append(viewer)
        run(viewer, frames=3)

    monkeypatch.setattr(Viewer, "run", run_shortly)
    return viewers


def covered(viewer):
    return (viewer.frame.color[:90, :, :3] != viewer.frame.color[0, 0, :3]).any(axis=2).mean()


def test_scenes_nodes_and_meshes_show_in_the_viewer(shown):
    scene = e3d.Scene((0, 0, 0))
    node = scene.add(e3d.box(), name="body", translation=(0, 2, 0))
    scene.add(e3d.torus(), parent=node)
    scene.add(e3d.box(), translation=(50, 0, 0))
    instances = e3d.InstancedMesh(e3d.box(), np.array([(0, 0, 0, 1), (3, 0, 0, 1)], np.float32))
    for thing in (scene, node, e3d.box(), instances):
        e3d.show(thing, size=(200, 150))
    titles = [viewer.view_renderer.viewed.title for viewer in shown]
    assert titles[:2] == ["scene", "body"]
    bounds = [viewer.view_renderer.viewed.scene.bounds for viewer in shown]
    assert bounds[0][1][0] > 50 > bounds[1][1][0]
    assert bounds[1][0][1] == pytest.approx(node.bounds[0][1])
    assert all(covered(viewer) > 0.001 for viewer in shown)


def test_a_scene_is_afterwards_as_it_was(shown):
    scene = e3d.Scene(e3d.linear(0.1, 0.2, 0.3))
    scene.add(e3d.box())
    lamp = scene.add(e3d.PointLight())
    dark = scene.add(e3d.PointLight())
    dark.visible = False
    before = scene.nodes, scene.background
    e3d.show(scene, size=(64, 64))
    assert (scene.nodes, scene.background) == before
    assert (lamp.visible, dark.visible) == (True, False)
    assert len(shown) == 1


def test_animations_of_a_scene_play_and_are_put_back(shown, tmp_path):
    scene = e3d.load_scene(flag(tmp_path / "flag.gltf"))
    before = scene.bounds
    e3d.show(scene, size=(64, 48))
    (viewer,) = shown
    assert viewer.playing and viewer.view_renderer.viewed.period == 2.0
    assert np.array_equal(scene.bounds, before)
    e3d.show(scene.find("flag"), size=(64, 48))
    assert not shown[1].playing and covered(shown[1]) > 0.001


def test_a_scene_with_a_camera_is_seen_from_there(shown):
    scene = e3d.Scene()
    scene.add(e3d.box())
    pose = e3d.look_at((3, 2, 4), (0, 0, 0))
    scene.add(e3d.PerspectiveCamera(yfov=0.5), pose=pose)
    e3d.show(scene, size=(64, 48))
    view = shown[0].view
    np.testing.assert_allclose(view.pose(), pose, atol=1e-6)
    assert view.yfov == 0.5


def test_an_update_moves_the_scene(shown):
    scene = e3d.Scene()
    node = scene.add(e3d.box())
    times = []

    def update(time):
        times.append(time)
        node.translation = (time, 0, 0)

    e3d.show(scene, size=(64, 48), update=update)
    assert len(times) == 3 and times == sorted(times) and times[-1] > 0
    assert node.translation[0] == times[-1]


def push_keys(monkeypatch, *received):
    """Let windows receive these events, one list each time they ask."""
    script = list(received)
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setattr(
        Window, "events", lambda self, timeout=0.0: script.pop(0) if script else [events.Exposed()]
    )
    presented = []
    present = Window.present

    def keep(self, picture, format=None):
        present(self, picture, format)
        presented.append(np.array(picture))

    monkeypatch.setattr(Window, "present", keep)
    return presented


@pytest.mark.parametrize("key", ["Q", "Escape"])
def test_pictures_show_until_a_key_closes_the_window(monkeypatch, key):
    frame = e3d.render(e3d.Scene(), size=(64, 48))
    for picture in (frame, e3d.Canvas((64, 48)), np.zeros((48, 64), np.uint8)):
        presented = push_keys(monkeypatch, [events.KeyDown(key, key)])
        e3d.show(picture)
        assert len(presented) == 1
        assert presented[0].shape == (336, 448, 4)


def test_words_of_another_order_show_when_their_format_is_said(monkeypatch):
    presented = push_keys(monkeypatch, [events.KeyDown("Q", "Q")])
    e3d.show(np.full((64, 64), 0x00112233, np.uint32), format="bgra", size=(64, 64))
    assert presented[0][10, 10].tolist() == [0x33, 0x22, 0x11, 0]


def test_the_wheel_and_keys_look_closer_and_r_fits_again(monkeypatch):
    picture = np.random.default_rng(0).integers(0, 256, (64, 64, 4), np.uint8)
    presented = push_keys(
        monkeypatch,
        [events.Wheel(3, 0, 0)],
        [events.KeyDown("R", "R")],
        [events.KeyDown("1", "1")],
        [events.MouseButton("left", True, x=10, y=10), events.MouseMotion(-5, 0, 5, 10)],
        [events.KeyDown("Q", "Q")],
    )
    monkeypatch.setattr(Window, "buttons", {"left"})
    e3d.show(picture, size=(64, 64))
    whole, close, fitted, real, moved = presented
    np.testing.assert_array_equal(whole, picture)
    np.testing.assert_array_equal(close[0, 0], picture[0, 0])
    assert (close != picture).any()
    np.testing.assert_array_equal(fitted, picture)
    np.testing.assert_array_equal(real, picture)
    np.testing.assert_array_equal(moved[:, :-5], picture[:, 5:])


def test_what_is_zoomed_stays_under_the_mouse():
    view = PictureView((300, 200), (600, 600))
    for at in ((140, 320), (599, 0)):
        before = view.pixel_at(*at)
        view.zoom(5, at)
        assert view.pixel_at(*at) == before
    view.fit()
    assert view.pixel_at(300, 300) == (150, 100)
    assert view.pixel_at(300, 50) is None


def test_the_title_tells_the_pixel_under_the_mouse(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    pixels = np.zeros((64, 64, 4), np.uint8)
    pixels[3, 2] = 10, 20, 30, 255
    with Window((64, 64), "picture", wait=True) as window:
        picture = PictureWindow(window, pixels, "rgba")
        picture._obey(events.MouseMotion(0, 0, 2, 3))
        assert window.title == "picture - 2, 3: 10 20 30 255"
        picture._obey(events.MouseMotion(0, 0, 70, 3))
        assert window.title == "picture"


def test_windows_suit_their_pictures():
    assert fitting_size((1280, 720), (1280, 720)) == (1280, 720)
    assert fitting_size((64, 48), (1280, 720)) == (448, 336)
    assert fitting_size((5000, 1000), (1280, 720)) == (1280, 256)
    assert fitting_size((1, 100000), (1280, 720)) == (1, 720)


@pytest.mark.parametrize(
    ("thing", "options", "said"),
    [
        (None, {}, "must be a scene, a node, a mesh or a picture"),
        (e3d.box(), {"up": "Y"}, "up must be one of"),
        (e3d.box(), {"period": 0}, "period must be a positive number"),
        (e3d.box(), {"update": 3}, "update must be a function or None, not 3"),
        (e3d.box(), {"size": (0, 3)}, "width must be"),
    ],
)
def test_what_cannot_be_shown_is_told(thing, options, said):
    with pytest.raises(e3d.InvalidArgumentError, match=said):
        e3d.show(thing, **options)


@needs_no_screen
@pytest.mark.parametrize("thing", [e3d.box(), np.zeros((4, 4), np.uint8)], ids=["mesh", "picture"])
def test_without_a_screen_one_error_says_so(monkeypatch, thing):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(e3d.errors.DisplayError, match="^no screen"):
        module.show(thing)


def test_what_shows_loads_sdl_when_a_window_opens():
    code = "import sys, engine3d as e; e.show, e.Window, e.events; print('sdl2' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_a_canvas_shows_itself_in_a_notebook():
    canvas = e3d.Canvas((20, 10))
    canvas.line(0, 0, 19, 9, (255, 0, 0))
    frame = e3d.render(e3d.Scene(), size=(20, 10))
    frame.color[...] = canvas.pixels
    assert canvas._repr_png_() == frame._repr_png_()
    assert e3d.Canvas(canvas.pixels[2:7, 3:9])._repr_png_().startswith(b"\x89PNG")
    assert e3d.Canvas((0, 5))._repr_png_() is None

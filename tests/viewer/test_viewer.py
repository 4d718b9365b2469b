"""The viewer's loop and its keys, with a scripted window and the real renderer."""

import math
import re
import time

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.keymap import BINDINGS
from engine3d.apps.viewer.viewer import Viewer
from engine3d.rendering.options import MODES
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (160, 120)


def key(name, **modifiers):
    return events.KeyDown(name, name, **modifiers)


def make_viewed_scene(**options):
    scene = e3d.Scene((10, 20, 30))
    scene.add(e3d.torus(0.5, 0.2, (24, 12)), name="torus")
    return ViewedScene(scene, "torus.obj", **options)


def make_viewer(script=(), viewed=None, **options):
    view_renderer = ViewRenderer(viewed or make_viewed_scene(), Settings({}), SIZE)
    window = ScriptedWindow(script, SIZE)
    return Viewer(view_renderer, window, **options), window


def play(*script, viewed=None, **options):
    """Run a viewer through a script of events, one a turn of the loop; return it and the window."""
    viewer, window = make_viewer([[event] for event in script], viewed, **options)
    viewer.run()
    return viewer, window


def test_the_first_frame_shows_the_model_framed():
    viewer, window = play(events.Exposed())
    pixels = window.shown[0]
    assert pixels.shape == (120, 160, 4)
    covered = (pixels[..., :3] != (10, 20, 30)).any(axis=2)
    rows, columns = np.nonzero(covered)
    assert 0 < rows.min() < 40 and 80 < rows.max() < 119
    assert columns.min() > 0 and columns.max() < 159


def test_nothing_is_drawn_while_nothing_changes():
    nothing = events.KeyUp("B", "B")
    _, window = play(events.Exposed(), nothing, nothing, nothing)
    assert len(window.shown) == 1


def test_a_playing_scene_is_drawn_every_turn_and_space_pauses_it():
    nothing = events.KeyUp("B", "B")
    viewer, window = play(nothing, nothing, nothing, viewed=make_viewed_scene(plays=True))
    assert len(window.shown) == 3
    assert viewer.view.azimuth != viewer.first_view.azimuth
    viewer, _ = play(key("Space"), viewed=make_viewed_scene(plays=True))
    assert not viewer.playing


def test_an_animated_scene_is_updated_with_the_time():
    times = []
    viewed = make_viewed_scene(update=times.append, period=2.0, plays=True)
    viewer, _ = play(*[events.Exposed()] * 4, viewed=viewed)
    assert times == sorted(times)
    assert viewer.view.azimuth == viewer.first_view.azimuth


def test_nothing_is_drawn_while_minimised():
    viewer, window = make_viewer([[events.Exposed()]] * 3, make_viewed_scene(plays=True))
    window.minimised = True
    viewer.run()
    assert window.shown == []


def test_frames_limit_the_loop():
    viewer, window = make_viewer([[]] * 100, make_viewed_scene(plays=True))
    viewer.run(frames=5)
    assert len(window.shown) == 5


@pytest.mark.parametrize("plays", [True, False])
def test_as_many_frames_as_asked_for_are_shown_though_nothing_moves(plays):
    viewer, window = make_viewer([[]] * 100, make_viewed_scene(plays=plays))
    viewer.run(frames=3)
    assert len(window.shown) == 3
    assert len(window._script) == 97


def test_the_title_has_the_name_and_what_frames_take():
    viewer, window = make_viewer([[]] * 400, make_viewed_scene(plays=True))
    viewer.run(frames=300)
    assert re.fullmatch(r"torus.obj - engine3d - \d+\.\d ms to draw, \d+ fps", window.titles[0])


def test_the_title_tells_what_recent_frames_take_and_that_nothing_moves(monkeypatch):
    """The first frames are slow; what moves later is fast, and then comes to rest."""
    now = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    viewer, window = make_viewer(viewed=make_viewed_scene(plays=True))
    take = [0.125]
    window.present = lambda pixels: now.__setitem__(0, now[0] + take[0])

    def turn(times):
        window._script = [[]] * times
        for _ in range(times):
            viewer.run_once()

    turn(8)
    assert window.titles[-1].endswith(" ms to draw, 8 fps")
    take[0] = 1 / 150
    turn(400)
    assert window.titles[-1].endswith(" ms to draw, 150 fps")
    viewer.handle(key("Space"))
    turn(2)
    assert re.search(r"idle, last frame \d+\.\d ms$", window.titles[-1])


def test_the_title_names_what_is_shown(tmp_path):
    path = tmp_path / "triangle.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    viewer, window = make_viewer([[]] * 3, make_viewed_scene(plays=True))
    viewer.run(frames=3)
    viewer.handle(events.FilesDropped((str(path),)))
    viewer.playing = True
    window._script = [[]]
    viewer.run(frames=1)
    assert window.titles[-1].startswith("triangle.obj - engine3d - ")


def test_q_and_the_close_button_end_the_loop():
    viewer, window = make_viewer([[key("Q")], [events.Exposed()]])
    viewer.run()
    assert not viewer.running
    assert len(window._script) == 1
    viewer, window = make_viewer([[events.CloseRequested()], [events.Exposed()]])
    viewer.run()
    assert len(window._script) == 1


def test_left_drag_orbits_right_drag_pans_middle_drag_approaches():
    left = [events.MouseButton("left", True), events.MouseMotion(30, 10)]
    viewer, _ = play(*left)
    assert viewer.view.azimuth < viewer.first_view.azimuth
    assert viewer.view.elevation > viewer.first_view.elevation
    for press in (
        events.MouseButton("right", True),
        events.MouseButton("left", True, shift=True),
        events.MouseButton("left", True, control=True),
    ):
        viewer, _ = play(press, events.MouseMotion(30, 10))
        assert viewer.view.azimuth == viewer.first_view.azimuth
        assert (viewer.view.target != viewer.first_view.target).any()
    viewer, _ = play(events.MouseButton("middle", True), events.MouseMotion(0, -30))
    assert viewer.view.distance < viewer.first_view.distance


def test_motion_without_a_button_does_nothing():
    click = [events.MouseButton("left", True), events.MouseButton("left", False)]
    viewer, _ = play(*click, events.MouseMotion(9, 9))
    np.testing.assert_array_equal(viewer.view.pose(), viewer.first_view.pose())


def test_the_wheel_approaches_and_r_resets():
    viewer, _ = play(events.Wheel(3))
    assert viewer.view.distance < viewer.first_view.distance
    viewer, _ = play(events.Wheel(3), key("R"))
    assert viewer.view.distance == viewer.first_view.distance
    assert viewer.orbit.view is viewer.view


@pytest.mark.parametrize(
    ("name", "azimuth", "elevation"),
    [
        ("1", 0.0, 0.0),
        ("3", math.pi / 2, 0.0),
        ("7", 0.0, math.pi / 2),
        ("9", math.pi / 4, math.atan(1 / math.sqrt(2))),
    ],
)
def test_digits_choose_views(name, azimuth, elevation):
    viewer, _ = play(key(name))
    assert (viewer.view.azimuth, viewer.view.elevation) == (azimuth, elevation)


def test_the_appearance_follows_the_keys():
    viewer, _ = play(key("W"))
    assert viewer.view_renderer.appearance.wireframe == "overlay"
    viewer, _ = play(key("W"), key("W"), key("W"))
    assert viewer.view_renderer.appearance.wireframe is None
    viewer, _ = play(key("E"), key("N"), key("F"), key("B"), key("5"), key("+"))
    appearance = viewer.view_renderer.appearance
    assert appearance.wireframe == "overlay"
    assert appearance.mode == "normal"
    assert appearance.normals == "flat"
    assert appearance.cull == "none"
    assert appearance.line_width == 2.0
    assert viewer.view.orthographic
    assert not appearance.ambient_occlusion
    viewer, _ = play(key("L", control=True))
    assert viewer.view_renderer.appearance.ambient_occlusion
    assert viewer.view_renderer.appearance.tone_mapping == "none"
    viewer, _ = play(key("T", control=True))
    assert viewer.view_renderer.appearance.tone_mapping == "neutral"
    viewer, _ = play(key("M", shift=True))
    assert viewer.view_renderer.appearance.mode == MODES[-1] == "material_id"


def test_lights_go_round():
    viewer, _ = make_viewer()
    names = viewer.view_renderer.lighting.names
    viewer, _ = play(key("L"))
    assert viewer.view_renderer.lighting.name == names[1]
    viewer, _ = play(*[key("L")] * len(names))
    assert viewer.view_renderer.lighting.name == names[0]


@pytest.mark.parametrize("binding", BINDINGS, ids=lambda binding: binding.action)
def test_every_key_draws_a_frame_and_twice_is_fine(binding, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    viewer, window = play(key(binding.keys[0]), key(binding.keys[0]), events.Exposed())
    assert window.shown or binding.action == "quit"


def test_keys_with_control_and_repeats_do_nothing():
    viewer, _ = play(key("W", control=True), key("W", repeat=True))
    assert viewer.view_renderer.appearance.wireframe is None


def test_help_statistics_and_messages_are_drawn_over_the_picture():
    _, plain = play(events.Exposed())
    _, helped = play(events.Exposed(), key("H"))
    assert (helped.shown[-1] != plain.shown[-1]).any()
    _, counted = play(events.Exposed(), statistics=True)
    assert (counted.shown[-1] != plain.shown[-1]).any()
    _, told = play(events.Exposed(), key("W"))
    assert (told.shown[-1][100:] != plain.shown[-1][100:]).any()


def test_walking_moves_looks_and_leaves():
    viewer, window = make_viewer()
    viewer.handle(key("Tab"))
    assert window.captured
    before = viewer.view.position()
    viewer.handle(events.KeyDown("Z", "W"))
    viewer.advance(0.1)
    assert np.linalg.norm(viewer.view.position() - before) > 0.01
    viewer.handle(events.KeyUp("Z", "W"))
    stood = viewer.view.position()
    viewer.advance(0.1)
    np.testing.assert_array_equal(viewer.view.position(), stood)
    azimuth = viewer.view.azimuth
    viewer.handle(events.MouseMotion(50, 0))
    assert viewer.view.azimuth != azimuth
    viewer.handle(key("Q"))
    assert viewer.running
    viewer.handle(key("Escape"))
    assert viewer.walker is None
    assert not window.captured


def test_walking_keys_are_let_go_when_the_focus_is_lost():
    viewer, _ = make_viewer(walking=True)
    viewer.handle(key("W"))
    assert viewer.held_positions == {"W"}
    viewer.handle(events.FocusLost())
    assert viewer.held_positions == set()


def test_letters_that_do_not_walk_still_act_while_walking():
    viewer, _ = make_viewer(walking=True)
    viewer.handle(key("G"))
    assert viewer.view_renderer.settings.grid


def test_arrows_look_while_walking():
    viewer, _ = make_viewer(walking=True)
    azimuth, stood = viewer.view.azimuth, viewer.view.position()
    viewer.handle(key("Right"))
    viewer.advance(0.1)
    assert viewer.view.azimuth < azimuth
    np.testing.assert_allclose(viewer.view.position(), stood, atol=1e-9)


def test_culling_is_frozen_while_c_is_held():
    viewer, _ = make_viewer(walking=True)
    seen = viewer.view_renderer.draw(viewer.view).color
    viewer.handle(key("C"))
    np.testing.assert_array_equal(viewer.view_renderer.draw(viewer.view).color, seen)
    draw = viewer.view_renderer.renderer.render
    calls = []

    def render(*arguments, **options):
        calls.append(options["culling_camera"])
        return draw(*arguments, **options)

    viewer.view_renderer.renderer.render = render
    viewer.draw()
    viewer.handle(events.KeyUp("C", "C"))
    assert viewer.changed
    viewer.draw()
    viewer.handle(key("C"))
    viewer.handle(events.FocusLost())
    viewer.draw()
    assert calls[0] is not None and calls[1:] == [None, None]


def test_a_resized_window_gets_frames_of_its_size():
    viewer, window = make_viewer([[events.Exposed()], [events.Resized(90, 70)]])
    turns = iter([SIZE, (90, 70)])
    original = window.events

    def resize(timeout=0.0):
        window.size = next(turns, (90, 70))
        return original(timeout)

    window.events = resize
    viewer.run()
    assert [pixels.shape[:2] for pixels in window.shown] == [(120, 160), (70, 90)]


def test_a_screenshot_is_the_picture_without_overlays(tmp_path, monkeypatch):
    from PIL import Image

    monkeypatch.chdir(tmp_path)
    _, plain = play(events.Exposed())
    play(key("F12"), key("F12"), statistics=True)
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["torus-screenshot-001.png", "torus-screenshot-002.png"]
    with Image.open(tmp_path / names[0]) as image:
        np.testing.assert_array_equal(np.asarray(image.convert("RGBA")), plain.shown[0])


def test_a_dropped_file_opens(tmp_path):
    path = tmp_path / "triangle.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    viewer, window = play(events.FilesDropped((str(path),)), events.Exposed())
    assert viewer.view_renderer.viewed.title == "triangle.obj"


def test_a_dropped_file_that_cannot_be_read_leaves_the_picture(tmp_path):
    path = tmp_path / "broken.obj"
    path.write_text("v 0 0\nf 1 2 3\n")
    viewer, _ = play(events.FilesDropped((str(path),)))
    assert viewer.view_renderer.viewed.title == "torus.obj"


def test_a_watched_file_is_loaded_again(tmp_path, monkeypatch):
    from engine3d.apps.viewer.model_files import ModelFiles
    from engine3d.base.files import watch
    from engine3d.stage.open_model import open_model

    monkeypatch.setattr(watch, "CHECK_SECONDS", 0.0)
    path = tmp_path / "shape.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    viewer, _ = make_viewer(viewed=open_model(path), files=ModelFiles([path], watch=True))
    viewer.handle(key("N"))
    path.write_text("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nf 1 2 3\nf 2 4 3\n")
    for _ in range(3):
        viewer.advance(0.01)
    meshes = [node.object for node in viewer.view_renderer.viewed.scene.nodes]
    assert [len(mesh.faces) for mesh in meshes if isinstance(mesh, e3d.Mesh)] == [2]
    assert viewer.view_renderer.appearance.mode == "normal"


TRIANGLE = "v {0} 0 0\nv {1} 0 0\nv {0} 1 0\nf 1 2 3\n"


def watching(tmp_path, monkeypatch, *names, **options):
    """A viewer of triangles in files that it watches, and their paths."""
    from engine3d.apps.viewer.model_files import ModelFiles
    from engine3d.base.files import watch

    monkeypatch.setattr(watch, "CHECK_SECONDS", 0.0)
    paths = [tmp_path / name for name in names]
    for path in paths:
        path.write_text(TRIANGLE.format(0, 1))
    files = ModelFiles(paths, watch=True, **options)
    viewer, window = make_viewer(viewed=files.reload(), files=files)
    return viewer, window, paths


def look(viewer):
    """Let the viewer find out what became of its files, and draw."""
    for _ in range(3):
        viewer.advance(0.01)
    viewer.draw()


def faces(viewer):
    meshes = [node.object for node in viewer.view_renderer.viewed.scene.nodes]
    return [len(mesh.faces) for mesh in meshes if isinstance(mesh, e3d.Mesh)]


def test_a_watched_file_that_is_broken_or_gone_is_told_until_it_is_whole(tmp_path, monkeypatch):
    viewer, window, (path,) = watching(tmp_path, monkeypatch, "shape.obj")
    now = [time.monotonic()]
    monkeypatch.setattr("engine3d.apps.viewer.viewer.clock.monotonic", lambda: now[0])
    look(viewer)
    plain = window.shown[-1]
    path.write_text("v 0 0\n")
    for _ in range(3):
        look(viewer)
        assert "shape.obj:1: " in viewer.messages.trouble
        assert (window.shown[-1][80:] != plain[80:]).any() and faces(viewer) == [1]
        now[0] += 60.0
    path.unlink()
    look(viewer)
    assert viewer.messages.trouble == "shape.obj is not there: this is what it was"
    path.write_text(TRIANGLE.format(0, 1) + "# whole\n")
    look(viewer)
    assert viewer.messages.trouble == ""
    now[0] += 60.0
    look(viewer)
    assert (window.shown[-1] == plain).all()


@pytest.mark.parametrize(
    ("low", "high", "framed"), [(0, 1.2, False), (500, 501, True), (0, 0.001, True), (0, 900, True)]
)
def test_a_watched_model_that_leaves_the_view_is_framed(tmp_path, monkeypatch, low, high, framed):
    viewer, window, (path,) = watching(tmp_path, monkeypatch, "shape.obj")
    viewer.handle(key("Right", shift=True))
    look(viewer)
    before = viewer.view.copy()
    path.write_text(TRIANGLE.format(low, high).replace(" 1 0\n", f" {high - low} 0\n"))
    look(viewer)
    assert (viewer.view.distance != before.distance) == framed
    assert viewer.view.azimuth == before.azimuth
    assert viewer.view.sees(viewer.view_renderer.bounds, viewer.view_renderer.aspect)
    if framed:
        viewer.handle(key("R"))
        assert viewer.view.sees(viewer.view_renderer.bounds, viewer.view_renderer.aspect)


def test_a_watched_model_keeps_its_colour(tmp_path, monkeypatch):
    viewer, _, (path,) = watching(tmp_path, monkeypatch, "shape.obj", color=(255, 0, 0))
    path.write_text(TRIANGLE.format(0, 1) + "f 1 3 2\n")
    look(viewer)
    nodes = viewer.view_renderer.viewed.scene.nodes
    (mesh,) = (node.object for node in nodes if isinstance(node.object, e3d.Mesh))
    assert len(mesh.faces) == 2
    assert tuple(mesh.materials[0].color) == (255, 0, 0)


def test_files_that_are_dropped_together_show_together(tmp_path):
    paths = [tmp_path / name for name in ("a.obj", "b.obj", "broken.obj")]
    for path, place in zip(paths, (0, 3, 6), strict=True):
        path.write_text(TRIANGLE.format(place, place + 1))
    viewer, window = make_viewer()
    viewer.opening.open([str(path) for path in paths[:2]])
    assert viewer.view_renderer.viewed.title == "a.obj, b.obj"
    assert faces(viewer) == [1, 1]
    low, high = viewer.view_renderer.viewed.scene.bounds
    assert (low[0], high[0]) == (0, 4)
    paths[2].write_text("v 0 0\n")
    viewer.opening.open([str(path) for path in paths])
    assert viewer.view_renderer.viewed.title == "a.obj, b.obj"
    assert "broken.obj:1: " in viewer.messages.said


def test_texts_are_as_large_as_the_screen_is_fine():
    sizes = []
    for screen, given in ((1, None), (2, None), (1, 2), (2, 1)):
        viewer, window = make_viewer([])
        window.size = (800, 600)
        window.scale = screen
        view_renderer = ViewRenderer(make_viewed_scene(), Settings({}, ui_scale=given), window.size)
        viewer = Viewer(view_renderer, window)
        viewer.draw()
        plain = window.shown[-1]
        viewer.say("hello")
        viewer.draw()
        sizes.append(int((window.shown[-1] != plain).any(axis=2).any(axis=1).sum()))
    assert sizes[1] == sizes[2] > 1.4 * sizes[0]
    assert sizes[3] == sizes[0]

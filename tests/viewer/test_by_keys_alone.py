"""What the mouse does to the model, done by keys: moving, turning lights, pointing, measuring."""

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (480, 360)


@pytest.fixture
def viewer():
    scene = e3d.Scene()
    scene.add(e3d.box(), name="box")
    viewed = ViewedScene(scene, "box.obj", themed=True, unit="m")
    viewer = Viewer(
        ViewRenderer(viewed, Settings({}, look="studio"), SIZE), ScriptedWindow((), SIZE)
    )
    viewer.draw()
    return viewer


def press(viewer, *keys, **modifiers):
    for key in keys:
        viewer.handle(events.KeyDown(key, key, **modifiers))
    viewer.draw()


def cross_of(viewer):
    """The pixel of the cross: the middle of what differs from the picture without it."""
    panel, viewer.panel = viewer.panel, None
    without = viewer._over_frame().copy()
    viewer.panel = panel
    panel.draw = lambda canvas, scale, theme: None
    rows, columns = np.nonzero((viewer._over_frame() != without).any(axis=2))
    return (columns.min() + columns.max()) / 2, (rows.min() + rows.max()) / 2


@pytest.mark.parametrize(("key", "back"), [("Left", "Right"), ("Up", "Down")])
def test_keys_move_the_camera_and_back(viewer, key, back):
    first = viewer.view.target.copy()
    place = viewer.frame.project(first)[0]
    press(viewer, key, shift=True, control=True)
    moved = viewer.frame.project(first)[0] - place
    expected = (18, 0) if key == "Left" else (0, 18)
    assert moved == pytest.approx(expected, abs=0.01)
    press(viewer, back, shift=True, control=True)
    assert viewer.view.target == pytest.approx(first)


def test_keys_turn_the_lights_as_a_drag_does(viewer):
    press(viewer, "L")
    before = viewer.frame.color.copy()
    press(viewer, "Home", shift=True)
    assert (viewer.frame.color != before).any()
    press(viewer, "End", shift=True)
    assert (viewer.frame.color == before).mean() > 0.999


def test_the_cross_selects_and_turns_round_what_is_there(viewer):
    press(viewer, "P")
    assert cross_of(viewer) == pytest.approx((240, 180), abs=1)
    press(viewer, "Return")
    assert viewer.selected.node.name == "box"
    press(viewer, *["Up"] * 9, *["Left"] * 4)
    x, y = cross_of(viewer)
    assert (x, y) == pytest.approx((232, 162), abs=1)
    place = viewer.view_renderer.pick(viewer.view, 0.0, round(x), round(y)).position
    press(viewer, "Return", shift=True)
    assert viewer.view.target == pytest.approx(place, abs=0.01)
    press(viewer, *["Right"] * 99, shift=True)
    press(viewer, "Return")
    assert viewer.selected is None
    press(viewer, "P")
    assert viewer.panel is None


def test_points_are_measured_by_keys(viewer):
    press(viewer, "M", control=True)
    panel = viewer.panel
    assert panel._at is None  # the mouse may be what one measures with
    front = np.array([(-0.5, -0.5, 0.5), (-0.5, 0.5, 0.5)])
    for x, y in viewer.frame.project(front)[0]:
        panel._at = (x + 3) / SIZE[0], y / SIZE[1]
        press(viewer, "Return")
    assert panel.rows()[-1].text == "distance 1 m"
    press(viewer, "Tab")
    assert panel.rows()[1].text == "[x] angle: 3 points"
    press(viewer, "Tab", "Tab", shift=True)
    panel._at = (0.5, 0.5)
    press(viewer, "Return")
    assert [row.text for row in panel.rows()][5:8] == ["box", "area 6 m²", "volume 1 m³"]
    press(viewer, "Delete")
    assert viewer.view_renderer.settings.measured == ()


def test_a_moving_cross_draws_no_frame(viewer):
    press(viewer, "P")
    frame = viewer.frame
    viewer.window._script = [[events.KeyDown("Left", "Left")]]
    shown = viewer.window.shown[-1]
    viewer.run_once()
    assert viewer.frame is frame and (viewer.window.shown[-1] != shown).any()


def test_a_terminal_shows_the_cross_in_its_picture(viewer):
    viewer.window.writes_text, viewer.window.text_room = True, (80, 24)
    viewer.window.write = lambda lines: None
    press(viewer, "P")
    assert (viewer.window.shown[-1] != viewer.frame.color).any()
    press(viewer, "Escape")
    assert (viewer.window.shown[-1] == viewer.frame.color).all()

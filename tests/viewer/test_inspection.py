"""The viewer's tools: section, explosion, measuring, the box with dimensions."""

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.tools.explosion_panel import ExplosionPanel
from engine3d.apps.viewer.tools.measuring_panel import MeasuringPanel
from engine3d.apps.viewer.tools.section_panel import SectionPanel
from engine3d.apps.viewer.tools.snapping import snap
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (480, 360)


def make_viewer(**options):
    scene = e3d.Scene()
    scene.add(e3d.box(), name="left", translation=(-1, 0, 0))
    scene.add(e3d.box(), name="right", translation=(1, 0, 0))
    options = {"themed": True, "unit": "m", **options}
    view_renderer = ViewRenderer(
        ViewedScene(scene, "some.obj", **options), Settings({}, look="studio"), SIZE
    )
    viewer = Viewer(view_renderer, ScriptedWindow(size=SIZE))
    viewer.draw()
    return viewer


def press(viewer, key, **modifiers):
    viewer.handle(events.KeyDown(key, key, **modifiers))
    viewer.draw()


def click(viewer, x, y):
    for down in (True, False):
        viewer.handle(events.MouseButton("left", down, x=int(x), y=int(y)))
    viewer.draw()


def click_row(viewer, number):
    panel = viewer.panel
    line = panel._heads + number + 0.5
    click(viewer, panel._box[0] + 20, panel._box[1] + 8 + int(line * panel._row_height))


def slider_at(panel, share):
    left, width = panel._track()
    line = panel._heads + panel.slider - panel._first + 0.5
    return left + round(share * width), panel._box[1] + 8 + int(line * panel._row_height)


def bounds(viewer):
    return np.array(viewer.view_renderer.viewed.scene.bounds)


def test_a_section_cuts_moves_turns_and_ends():
    viewer = make_viewer()
    whole, view = viewer.view_renderer.viewed, viewer.view.copy()
    press(viewer, "X", control=True)
    assert isinstance(viewer.panel, SectionPanel)
    assert bounds(viewer)[:, 0] == pytest.approx((-1.5, -0.5))  # right is cut off, at the middle
    assert viewer.view.distance == view.distance
    assert viewer.panel.rows()[3].detail == "X = 0 m"
    press(viewer, "F")
    assert bounds(viewer)[:, 0] == pytest.approx((0.5, 1.5))
    press(viewer, "Y")
    assert bounds(viewer)[:, 1] == pytest.approx((0.0, 0.5), abs=1e-4)
    assert viewer.panel.rows()[5].text == "all cuts are closed"
    press(viewer, "Right", shift=True)
    assert viewer.inspector.share == pytest.approx(0.6)
    assert bounds(viewer)[0, 1] == pytest.approx(0.1, abs=1e-4)
    press(viewer, "Escape")
    assert viewer.panel is None and bounds(viewer)[0, 1] == pytest.approx(0.1, abs=1e-4)
    press(viewer, "X", control=True)
    press(viewer, "X", control=True)
    assert viewer.panel is None and viewer.view_renderer.viewed is whole
    assert viewer.view.distance == view.distance and viewer.view.azimuth == view.azimuth


def test_the_slider_follows_the_mouse():
    viewer = make_viewer()
    press(viewer, "X", control=True)
    x, y = slider_at(viewer.panel, 0.25)
    viewer.handle(events.MouseButton("left", True, x=x, y=y))
    assert viewer.inspector.share == pytest.approx(0.25, abs=0.01)
    before = viewer.view.azimuth
    x, _ = slider_at(viewer.panel, 0.75)
    viewer.handle(events.MouseMotion(50, 30, x, y + 30))
    assert viewer.inspector.share == pytest.approx(0.75, abs=0.01)
    viewer.handle(events.MouseMotion(500, 0, 10_000, y))
    assert viewer.inspector.share == 1.0
    viewer.handle(events.MouseButton("left", False, x=x, y=y))
    viewer.handle(events.MouseMotion(-50, 0, x, y))
    assert viewer.inspector.share == 1.0 and viewer.view.azimuth == before


def test_rows_of_the_section_are_clicked():
    viewer = make_viewer()
    press(viewer, "X", control=True)
    click_row(viewer, 1)
    assert viewer.inspector.axis == 1
    click_row(viewer, 2)
    assert not viewer.inspector.from_above
    click_row(viewer, 0)
    assert bounds(viewer).tolist() == [[-1.5, -0.5, -0.5], [1.5, 0.5, 0.5]]
    assert viewer.panel.rows()[0].text == "[ ] cut the model"


def test_an_open_cut_is_told():
    scene = e3d.Scene()
    scene.add(e3d.plane(2.0), name="sheet")
    viewed = ViewedScene(scene, "sheet", themed=True)
    viewer = Viewer(ViewRenderer(viewed, Settings({}), SIZE), ScriptedWindow(size=SIZE))
    viewer.draw()
    press(viewer, "X", control=True)
    assert viewer.panel.rows()[5].text == "open: sheet"


def test_parts_move_apart_and_together():
    viewer = make_viewer(plays=True)
    assert viewer.playing
    distance = viewer.view.distance
    press(viewer, "E", control=True)
    assert isinstance(viewer.panel, ExplosionPanel) and not viewer.playing
    assert bounds(viewer)[:, 0].tolist() == [-2.0, 2.0]
    assert viewer.panel.rows()[1].text == "2 parts"
    assert viewer.view.distance > distance * 1.2
    press(viewer, "Escape")
    press(viewer, "X", control=True)
    assert bounds(viewer)[:, 0].tolist() == [-2.0, -1.0]
    press(viewer, "X", control=True)
    assert bounds(viewer)[:, 0].tolist() == [-2.0, 2.0]
    press(viewer, "E", control=True)
    click_row(viewer, 0)
    assert bounds(viewer)[:, 0].tolist() == [-1.5, 1.5]
    assert viewer.view.distance == pytest.approx(distance)


def test_the_first_view_shows_all_parts_that_are_apart():
    viewer = make_viewer()
    first = viewer.view.copy()
    press(viewer, "E", control=True)
    for _ in range(15):
        press(viewer, "Right", shift=True)
    press(viewer, "R")
    low, high = bounds(viewer)
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
    pixels, _ = viewer.frame.project(corners)
    assert (pixels > 0).all() and (pixels < SIZE).all()
    assert (viewer.view.azimuth, viewer.view.elevation) == (first.azimuth, first.elevation)
    press(viewer, "E", control=True)
    press(viewer, "R")
    assert viewer.view.distance == first.distance


def test_what_is_hidden_stays_hidden():
    viewer = make_viewer()
    viewer.view_renderer.visibility.toggle_object(1)
    press(viewer, "E", control=True)
    assert [entry.shown for entry in viewer.view_renderer.visibility.objects()] == [True, False]
    press(viewer, "E", control=True)
    assert [entry.shown for entry in viewer.view_renderer.visibility.objects()] == [True, False]


def test_the_background_and_the_lights_stay():
    viewer = make_viewer()
    press(viewer, "L")
    press(viewer, "K")
    theme, lights = viewer.view_renderer.theme, viewer.view_renderer.lighting.name
    press(viewer, "E", control=True)
    press(viewer, "Right", shift=True)
    assert viewer.view_renderer.theme is theme and viewer.view_renderer.lighting.name == lights


def test_a_distance_between_corners():
    viewer = make_viewer()
    press(viewer, "M", control=True)
    assert isinstance(viewer.panel, MeasuringPanel)
    corners = np.array([(-1.5, -0.5, 0.5), (-1.5, 0.5, 0.5)])
    pixels, _ = viewer.frame.project(corners)
    for x, y in pixels:
        click(viewer, x + 4, y)  # beside the corner, on the front
    assert viewer.panel.rows()[-1].text == "distance 1 m"
    assert viewer.selected is None
    measured = viewer.view_renderer.settings.measured
    assert len(measured) == 1 and measured[0].points == pytest.approx(corners)
    press(viewer, "Escape")
    assert viewer.view_renderer.settings.measured == measured
    press(viewer, "M", control=True)
    click_row(viewer, 4)
    assert viewer.view_renderer.settings.measured == ()


def test_the_surface_of_a_part():
    viewer = make_viewer()
    press(viewer, "M", control=True)
    click_row(viewer, 3)
    (x, y), _ = viewer.frame.project((-1.0, 0.0, 0.5))
    click(viewer, x, y)
    assert [row.text for row in viewer.panel.rows()][-3:] == ["left", "area 6 m²", "volume 1 m³"]
    click(viewer, 2, 2)
    assert "no surface" in viewer.messages.said


def test_clicks_snap_to_corners_and_visible_edges():
    viewer = make_viewer()

    def snapped(place):
        (x, y), _ = viewer.frame.project(place)
        hit = viewer.view_renderer.pick(viewer.view, 0.0, int(x), int(y))
        return snap(hit, viewer.frame)

    assert snapped((-0.52, 0.48, 0.5)).kind == "corner"
    edge = snapped((-0.52, 0.1, 0.5))
    assert edge.kind == "edge" and edge.point[0] == pytest.approx(-0.5)
    assert snapped((-1.0, 0.0, 0.5)).kind == "face"  # on the diagonal, which is no edge


def test_the_box_is_switched_and_drawn():
    viewer = make_viewer()
    before = viewer.frame.color.copy()
    press(viewer, "B", control=True)
    assert viewer.view_renderer.settings.dimensions
    assert (viewer.frame.color != before).any(axis=2).sum() > 1000
    press(viewer, "B", control=True)
    assert (viewer.frame.color == before).all()


def test_another_model_begins_whole(tmp_path):
    path = tmp_path / "box.obj"
    e3d.box().save(path)
    viewer = make_viewer()
    press(viewer, "X", control=True)
    viewer.opening.open([path])
    assert not viewer.inspector.is_cut and viewer.inspector.parts == 0
    assert bounds(viewer).tolist() == [[-0.5] * 3, [0.5] * 3]


def test_a_key_without_a_name_cuts_nothing_else():
    viewer = make_viewer()
    press(viewer, "X", control=True)
    press(viewer, "Z")
    before = bounds(viewer)
    press(viewer, "")
    assert (bounds(viewer) == before).all() and viewer.inspector.axis == 2


def test_a_second_click_measures_and_another_model_forgets():
    viewer = make_viewer()
    press(viewer, "M", control=True)
    distance = viewer.view.distance
    x, y = viewer.frame.project((1.0, 0.0, 0.5))[0]
    for down in (True, False):
        viewer.handle(events.MouseButton("left", down, x=int(x), y=int(y), clicks=2))
    viewer.draw()
    assert viewer.view.distance == distance and len(viewer.panel._points) == 1
    viewer.forget_scene()
    assert len(viewer.panel._points) == 0

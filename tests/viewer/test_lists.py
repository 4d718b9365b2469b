"""The lists of objects and materials, themes, statistics, and what the window writes to files."""

import numpy as np
import pytest
from PIL import Image
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.list_panels import Row, fitted
from engine3d.apps.viewer.recording import FRAMES
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.overlays.lettering import text_font
from engine3d.stage.overlays.theme import DARK, LIGHT
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (480, 360)
RED, GREEN = (
    e3d.Material(color=color, name=name)
    for color, name in [((1, 0, 0), "red"), ((0, 1, 0), "green")]
)


def make_viewer(**options):
    """A box of two materials, with a sphere below it in the tree; and three small instances."""
    scene = e3d.Scene(DARK.background)
    box = e3d.box()
    box.materials = [RED, GREEN]
    box.material_ids = np.arange(12, dtype=np.int32) // 6
    parent = scene.add(box, name="box")
    ball = e3d.uv_sphere(0.4, (16, 8))
    ball.materials = [e3d.Material(color=(1, 0, 0), name="red")]
    scene.add(ball, name="ball", parent=parent, translation=(1.5, 0, 0))
    poses = np.array([(x, -1.2, 0, 0.3) for x in (-1, 0, 1)], np.float32)
    scene.add(e3d.InstancedMesh(e3d.box(), poses))
    viewed = ViewedScene(scene, "some.obj", themed=True, **options)
    view_renderer = ViewRenderer(viewed, Settings({"mode": "unlit"}), SIZE)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE))


def press(viewer, key, **modifiers):
    viewer.handle(events.KeyDown(key, key, **modifiers))
    viewer.draw()


def click_row(viewer, number, button="left", shift=False):
    panel = viewer.panel
    y = panel._box[1] + 8 + int((number + 1.5) * panel._row_height)
    viewer.handle(events.MouseButton(button, True, shift, x=panel._box[0] + 20, y=y))
    viewer.handle(events.MouseButton(button, False, shift, x=panel._box[0] + 20, y=y))
    viewer.draw()


def seen(viewer):
    """The names of the objects that the picture shows."""
    frame = viewer.view_renderer.draw(viewer.view, 0.0, ("object_id",))
    nodes = {node.id: node.name for node in viewer.view_renderer.viewed.scene.nodes}
    return {nodes[number] for number in np.unique(frame.object_id).tolist() if number >= 0}


def test_keys_choose_objects_and_materials():
    viewer = make_viewer()
    for key in ("O", "Down", "Return"):
        press(viewer, key)
    assert "ball" not in seen(viewer) and "box" in seen(viewer)
    press(viewer, "Return")
    press(viewer, "Return", shift=True)
    assert seen(viewer) == {"ball"}
    press(viewer, "Home")
    assert viewer.panel.chosen == 0
    press(viewer, "End")
    assert viewer.panel.chosen == len(viewer.panel.rows()) - 1
    press(viewer, "W")  # a command, not a letter of a filter
    assert viewer.view_renderer.appearance.wireframe is not None and viewer.panel is not None


def test_keys_zoom_as_the_wheel_does():
    viewer = make_viewer()
    first = viewer.view.distance
    press(viewer, "+", control=True)
    assert viewer.view.distance < first
    for key in ("=", "-", "-"):
        press(viewer, key, control=True)
    assert viewer.view.distance == pytest.approx(first)


def colors(viewer):
    frame = viewer.view_renderer.draw(viewer.view)
    return {
        tuple(color) for color in np.unique(frame.color[..., :3].reshape(-1, 3), axis=0).tolist()
    }


def test_objects_are_listed_hidden_shown_and_seen_alone():
    viewer = make_viewer()
    press(viewer, "O")
    assert viewer.panel.rows() == [
        Row("[x] box", "12"),
        Row("[x] ball", f"{len(e3d.uv_sphere(0.4, (16, 8)).faces)}"),
        Row("[x] object 2", "36"),
    ]
    assert seen(viewer) == {"box", "ball", ""}
    click_row(viewer, 0)
    assert seen(viewer) == {"ball", ""} and viewer.panel.rows()[0].text == "[ ] box"
    click_row(viewer, 0)
    click_row(viewer, 1, "right")
    assert seen(viewer) == {"ball"}
    click_row(viewer, 1, shift=True)
    assert seen(viewer) == {"box", "ball", ""}
    assert viewer.selected is None and viewer.mouse.drag is None


def test_materials_are_listed_by_name_hidden_and_seen_alone():
    viewer = make_viewer()
    red, green, white = (255, 0, 0), (0, 255, 0), (255, 255, 255)
    press(viewer, "O")
    press(viewer, "O")
    assert [row.text for row in viewer.panel.rows()] == ["[x] red", "[x] green", "[x] unnamed"]
    assert [entry.triangles for entry in viewer.view_renderer.visibility.materials()][1:] == [6, 36]
    assert {red, green, white} <= colors(viewer)
    click_row(viewer, 0)
    assert red not in colors(viewer) and {green, white} <= colors(viewer)
    click_row(viewer, 1, "right")
    assert colors(viewer) == {green, DARK.background}
    click_row(viewer, 1, "right")
    assert {red, green, white} <= colors(viewer)
    press(viewer, "O")
    assert viewer.panel is None


def test_a_triangle_keeps_its_number_while_others_are_hidden():
    viewer = make_viewer()
    viewer.draw()
    frame = viewer.view_renderer.draw(viewer.view, 0.0, ("object_id", "face_id"))
    rows, columns = np.nonzero((frame.object_id == 0) & (frame.face_id >= 6))
    x, y = int(columns[len(columns) // 2]), int(rows[len(rows) // 2])
    viewer.select(x, y)
    number = viewer.selected.face_id
    assert number >= 6
    viewer.view_renderer.visibility.toggle_material(0)
    viewer.select(x, y)
    assert viewer.selected.face_id == number
    assert viewer._selection()[1:3] == [f"face {number} of 12", "material green"]


def test_a_long_list_scrolls_and_the_wheel_elsewhere_zooms():
    scene = e3d.Scene()
    for number in range(100):
        scene.add(e3d.box(), name=f"part {number}", translation=(number, 0, 0))
    view_renderer = ViewRenderer(ViewedScene(scene, "parts"), Settings({}), SIZE)
    viewer = Viewer(view_renderer, ScriptedWindow(size=SIZE))
    press(viewer, "O")
    distance = viewer.view.distance
    x, y = viewer.panel._box[0] + 5, viewer.panel._box[1] + 50
    viewer.handle(events.Wheel(-1000, x, y))
    viewer.draw()
    assert viewer.view.distance == distance
    click_row(viewer, viewer.panel._fit - 1)
    assert [
        entry.name for entry in viewer.view_renderer.visibility.objects() if not entry.shown
    ] == ["part 99"]
    viewer.handle(events.Wheel(1, 5, 200))
    assert viewer.view.distance < distance


@pytest.mark.parametrize("width", [60, 96, 160, 350])
def test_rows_fit_their_panel(width):
    font = text_font(1)
    for row in (Row("a"), Row("[x] name", "12"), Row("x" * 60, "7"), Row("a.obj", "/long/" * 20)):
        text, detail = fitted(row, width, font)
        assert font.width(text) + font.width(detail) <= width and (text or width < 96)
        assert text == row.text or text.endswith("…")
        assert detail == row.detail or detail.startswith("…")


def test_the_theme_changes_texts_and_the_background_of_models():
    viewer = make_viewer()
    press(viewer, "K")
    assert viewer.view_renderer.theme is LIGHT
    viewer.messages.said = ""
    viewer.draw()
    corner = viewer.frame.color[0, 0, :3].tolist()
    assert corner == list(LIGHT.background)
    press(viewer, "H")
    shown = viewer.window.shown[-1][..., :3].astype(int)
    assert (np.abs(shown - LIGHT.block[:3]).max(axis=2) < 20).mean() > 0.3
    press(viewer, "Escape")
    press(viewer, "K")
    assert viewer.view_renderer.staging.scene.background == pytest.approx(
        make_viewer().view_renderer.staging.scene.background
    )


def test_a_background_that_was_chosen_stays():
    scene = e3d.Scene((0, 0, 0))
    for viewed, settings in (
        (ViewedScene(scene, "own"), Settings({})),
        (ViewedScene(scene, "model", themed=True), Settings({}, background=(0, 0, 0))),
    ):
        view_renderer = ViewRenderer(viewed, settings, SIZE)
        view_renderer.staging.theme = LIGHT
        assert tuple(view_renderer.staging.scene.background) == (0, 0, 0)


def test_statistics_are_a_line_then_all_then_none():
    viewer = make_viewer()
    viewer.draw()
    viewer.draw()
    press(viewer, "Z")
    viewer.playing = True
    (line,) = viewer.statistics_lines()
    assert "frames per second" in line and " ms to draw, " in line and " triangles" in line
    viewer.playing = False
    (line,) = viewer.statistics_lines()
    assert "per second" not in line and " ms to draw, " in line
    press(viewer, "Z")
    assert len(viewer.statistics_lines()) > 10
    press(viewer, "Z")
    assert viewer.statistics is None


def test_statistics_at_rest_are_those_of_the_frame_that_is_shown():
    viewer = make_viewer()
    viewer.window._script = [[]] * 9
    viewer.statistics = "long"
    viewer.draw()
    viewer.frame_times.add(50.0, 60.0, 40.0)  # of a frame before it, in motion
    viewer.draw()
    told = []
    viewer._show = lambda pixels: told.append(viewer.statistics_lines())
    viewer.run_once()
    (lines,) = told
    last = viewer.frame_times.last()
    assert lines[0].split() == ["one", "frame", f"{1000 * last.seconds:.2f}", "ms"]
    assert lines[1].split() == ["core", f"{1000 * last.core_seconds:.2f}", "ms"]
    assert 1000 * last.seconds < 20_000


def test_a_turn_is_written_to_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    viewer = make_viewer()
    viewer.window._script = [[]] * 100
    view = viewer.view.copy()
    press(viewer, "F12", control=True)
    with Image.open(tmp_path / "some-turntable-001.gif") as image:
        assert (image.n_frames, image.size) == (FRAMES, SIZE)
    np.testing.assert_array_equal(viewer.view.pose(), view.pose())
    assert viewer.messages.said == "saved some-turntable-001.gif"
    assert len(viewer.window.shown) > FRAMES


@pytest.mark.parametrize("event", [events.KeyDown("Escape", "Escape"), events.CloseRequested()])
def test_a_turn_can_be_given_up(tmp_path, monkeypatch, event):
    monkeypatch.chdir(tmp_path)
    viewer = make_viewer()
    viewer.window._script = [[], [], [event]]
    press(viewer, "F12", control=True)
    assert list(tmp_path.iterdir()) == []
    assert viewer.view_renderer.size == SIZE
    assert viewer.running == isinstance(event, events.KeyDown)

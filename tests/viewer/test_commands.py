"""The list of commands: searched, chosen by keys and clicks, with present values."""

import pytest
from viewer.scripted_window import ScriptedWindow
from viewer.test_viewer import key, make_viewed_scene

from engine3d import events
from engine3d.apps.viewer.help_panel import CommandPanel
from engine3d.apps.viewer.keymap import BINDINGS, GESTURES, SECTIONS
from engine3d.apps.viewer.sampling import Sampling
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

SIZE = (640, 480)


@pytest.fixture
def viewer():
    view_renderer = ViewRenderer(make_viewed_scene(), Settings({}), SIZE)
    viewer = Viewer(view_renderer, ScriptedWindow(size=SIZE), sampling=Sampling())
    viewer.draw()
    return viewer


def press(viewer, name, typed="", **modifiers):
    """Press a key as SDL tells of it: the key, then what it types."""
    viewer.handle(key(name, **modifiers))
    if typed:
        viewer.handle(events.TextEntered(typed))


def write(viewer, text):
    for letter in text:
        press(viewer, letter.upper(), letter)


def row_of(viewer, text):
    return next(row for row in viewer.panel.rows() if row.text == text)


@pytest.mark.parametrize(("name", "typed"), [("H", "h"), ("F1", ""), ("/", "/")])
def test_keys_open_the_list_and_are_not_typed_into_it(viewer, name, typed):
    press(viewer, name, typed)
    assert isinstance(viewer.panel, CommandPanel) and viewer.panel.filter == ""
    press(viewer, "Escape")
    assert viewer.panel is None


def test_a_slash_that_takes_shift_and_another_key_opens_the_list(viewer):
    press(viewer, ":", "/", shift=True)
    assert isinstance(viewer.panel, CommandPanel) and viewer.panel.filter == ""


def test_every_command_is_listed_with_its_keys_and_what_it_is_now(viewer):
    press(viewer, "H")
    rows = {(row.text, row.key) for row in viewer.panel.rows()}
    assert {(one.help, " ".join(one.keys)) for one in BINDINGS} <= rows
    assert {(text, gesture) for gesture, text in GESTURES} <= rows
    titles = [row.text for row in viewer.panel.rows() if row.is_title]
    assert titles == [*SECTIONS, "Mouse"]
    wireframe = row_of(viewer, "wireframe")
    assert (wireframe.key, wireframe.detail, wireframe.is_lit) == ("W", "off", False)


@pytest.mark.parametrize("binding", BINDINGS, ids=lambda binding: binding.action)
def test_values_are_told_before_and_after_each_command(viewer, binding, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    viewer.window._script = [[]] * 99
    assert binding.value is None or binding.value(viewer).text is not None
    viewer.perform(binding.action)
    assert binding.value is None or binding.value(viewer).text is not None


@pytest.mark.parametrize(
    ("action", "before", "after"),
    [
        ("cycle_wireframe", ("off", False), ("overlay", True)),
        ("cycle_mode", ("lit", False), ("unlit", True)),
        ("toggle_textures", ("on", True), ("off", False)),
        ("toggle_grid", ("off", False), ("on", True)),
        ("toggle_orthographic", ("perspective", False), ("orthographic", True)),
        ("cycle_samples", ("automatic", False), ("1", True)),
        ("toggle_walking", ("off", False), ("on", True)),
        ("freeze_culling", ("off", False), ("on", True)),
        ("cycle_statistics", ("off", False), ("a line", True)),
        ("cycle_debug", ("off", False), ("boxes", True)),
        ("turn_z_up", ("", False), ("+Z", True)),
        ("play_faster", ("1×", False), ("2×", True)),
        ("toggle_playing", ("paused", False), ("playing", True)),
        ("toggle_controls", ("off", False), ("on", True)),
    ],
)
def test_commands_change_what_is_told_of_them(viewer, action, before, after):
    (binding,) = (one for one in BINDINGS if one.action == action)
    assert tuple(binding.value(viewer)) == before
    viewer.perform(action)
    assert tuple(binding.value(viewer)) == after


def test_typed_words_filter_and_enter_does_the_chosen_one(viewer):
    press(viewer, "H", "h")
    write(viewer, "wire")
    assert [row.text for row in viewer.panel.rows()] == ["Drawing", "wireframe"]
    press(viewer, "Return")
    assert viewer.view_renderer.appearance.wireframe == "overlay"
    assert row_of(viewer, "wireframe").detail == "overlay" and row_of(viewer, "wireframe").is_lit
    press(viewer, "Return", shift=True)
    assert viewer.view_renderer.appearance.wireframe is None
    for _ in "wire":
        press(viewer, "Backspace")
    write(viewer, "nothing like it")
    assert viewer.panel.rows() == []
    press(viewer, "Return")
    press(viewer, "Down")
    viewer.draw()
    assert isinstance(viewer.panel, CommandPanel)


def test_arrows_choose_commands_and_pass_over_headings(viewer):
    press(viewer, "H")
    chosen = []
    for _ in range(len(BINDINGS) + 3):
        chosen.append(viewer.panel.rows()[viewer.panel.chosen].text)
        press(viewer, "Down")
    assert chosen[: len(BINDINGS)] == [one.help for one in BINDINGS]
    assert chosen[-1] == BINDINGS[-1].help
    press(viewer, "Home")
    assert viewer.panel.rows()[viewer.panel.chosen].text == BINDINGS[0].help


def click(viewer, text, button="left"):
    """Click the row of a command."""
    viewer.draw()
    panel = viewer.panel
    number = [row.text for row in panel.rows()].index(text)
    left, top, _, _ = panel._box
    y = top + 8 + int((panel._heads + number - panel._first + 0.5) * panel._row_height)
    for down in (True, False):
        viewer.handle(events.MouseButton(button, down, x=left + 20, y=y))


def test_clicks_do_what_a_row_says_forwards_and_backwards(viewer):
    press(viewer, "H")
    click(viewer, "wireframe")
    assert viewer.view_renderer.appearance.wireframe == "overlay"
    click(viewer, "wireframe", "right")
    assert viewer.view_renderer.appearance.wireframe is None
    assert isinstance(viewer.panel, CommandPanel) and viewer.selected is None
    click(viewer, "Drawing")
    assert isinstance(viewer.panel, CommandPanel)
    write(viewer, "top")
    click(viewer, "top")
    assert viewer.panel is None and viewer.view.elevation > 1.5


def test_walking_has_a_list_of_its_own_in_the_letters_of_the_layout(viewer):
    viewer.window.layout = {"W": "Z", "A": "Q", "Q": "A", "Z": "W"}
    press(viewer, "Tab")
    assert viewer.window.captured
    press(viewer, "H")
    assert not viewer.window.captured
    rows = {row.text: row for row in viewer.panel.rows()}
    assert rows["walk"].key == "Z Q S D" and rows["up, down, without a ground"].key == "E A"
    assert rows["wireframe"].key == "W" and rows["statistics"].key == ""
    assert rows["next model of the folder"].key == "PageDown" and "orbit" not in rows
    azimuth = viewer.view.azimuth
    viewer.handle(events.MouseMotion(40, 0, 300, 200))
    assert viewer.view.azimuth == azimuth
    click(viewer, "wireframe")
    assert viewer.view_renderer.appearance.wireframe == "overlay"
    press(viewer, "Escape")
    assert viewer.panel is None and viewer.walker is not None and viewer.window.captured


def test_a_terminal_gets_the_lines_around_the_chosen_one(viewer):
    viewer.window.text_room = (78, 12)
    press(viewer, "H")
    for _ in range(30):
        press(viewer, "Down")
    lines = viewer.panel.lines()
    assert len(lines) == 12 and sum(line.startswith("> ") for line in lines) == 1
    assert BINDINGS[30].help in next(line for line in lines if line.startswith("> "))


def test_what_only_changes_the_list_draws_no_frame(viewer):
    press(viewer, "H")
    viewer.draw()
    frame = viewer.frame
    viewer.window._script = [[key("Down")], [events.TextEntered("x")], [events.Wheel(-1, 30, 60)]]
    for _ in range(3):
        viewer.run_once()
    assert viewer.frame is frame and len(viewer.window.shown) > 3

"""Motion by mouse and keys: menus, fields of Properties, the time line."""

import functools

import numpy as np
import pytest
from editor.ui.editor_hands import click, do, find, press, settle

from engine3d import events
from engine3d.apps.editor.motion_copies import motions_in
from engine3d.apps.editor.scene_state import SceneState
from engine3d.apps.editor.ui.motion import motion_actions as actions
from engine3d.apps.editor.ui.motion import motion_fields, timeline_panel
from engine3d.model.scene.animation import Spin, Track


def motions(editor):
    return motions_in(editor.workspace.scene)


def entry(editor, label):
    return next(each for each in editor._entries if each.label == label)


def select(editor, *names):
    nodes = [find(editor, name) for name in names]
    editor.workspace.document.selection.set(nodes)
    settle(editor)
    return nodes


@pytest.mark.parametrize("label, kind", [("Spin", 0), ("Set a key", 1), ("Path", 2), ("Orbit", 3)])
def test_the_menu_lets_the_selected_node_move(editor, label, kind):
    workspace = editor.workspace
    before = SceneState(workspace.scene)
    assert not entry(editor, label).is_enabled()
    (cab,) = select(editor, "Cab")
    assert entry(editor, label).is_enabled()
    entry(editor, label).act()
    settle(editor)
    assert [motion.node for motion in motions(editor)[kind]] == [cab]
    assert "Cab" in workspace.document.undo_label
    press(editor, "Z", control=True)
    assert SceneState(workspace.scene) == before


def test_the_last_selected_node_circles_the_one_before(editor):
    smoke, cab = select(editor, "Smoke", "Cab")
    entry(editor, "Orbit").act()
    (orbit,) = motions(editor).orbits
    assert orbit.node is cab and orbit.about is smoke


class Hand:
    """Dear ImGui, but that one field is changed, and all lists are open."""

    def __init__(self, imgui):
        self.imgui, self.at, self.fields = imgui, -1, []

    def __getattr__(self, name):
        return getattr(self.imgui, name)

    def _touches(self, label):
        self.fields.append(label)
        return len(self.fields) - 1 == self.at

    def drag_float(self, label, value, *how):
        shown = self.imgui.drag_float(label, value, *how)
        return (True, value + 0.25) if self._touches(label) else shown

    def drag_float3(self, label, values, *how):
        shown = self.imgui.drag_float3(label, values, *how)
        return (True, [value + 0.5 for value in values]) if self._touches(label) else shown

    def checkbox(self, label, value):
        shown = self.imgui.checkbox(label, value)
        return (True, not value) if self._touches(label) else shown

    def radio_button(self, label, active):
        return self.imgui.radio_button(label, active) | self._touches(label)

    def small_button(self, label):
        return self.imgui.small_button(label) | self._touches(label)

    def begin_combo(self, label, shown):
        self.imgui.text(label)
        return True

    def end_combo(self):
        pass

    def selectable(self, label, chosen):
        return (self.imgui.selectable(label, chosen)[0] | self._touches(label), chosen)


@pytest.mark.parametrize("title", list(actions.ADDED))
def test_every_field_of_a_motion_changes_it_and_is_undone(editor, monkeypatch, title):
    workspace = editor.workspace
    select(editor, "Smoke", "Cab")
    actions.ADDED[title](workspace)
    workspace.document.animator.seek(0.5)
    before, position = SceneState(workspace.scene), workspace.document.history.position
    hand = Hand(motion_fields.imgui)
    monkeypatch.setattr(motion_fields, "imgui", hand)
    settle(editor)
    count = len(hand.fields) // 3
    changed = set()
    for at in range(count):
        hand.fields, hand.at = [], at
        editor._pictures_due = 1
        editor.turn(0.0)
        hand.at = -1
        if workspace.document.history.position > position:
            changed.add(hand.fields[at])
            settle(editor)
            workspace.undo()
            assert SceneState(workspace.scene) == before
    assert not [each for each in workspace.console.entries if each.level == "error"]
    assert f"Remove the {title.lower()}" in changed and len(changed) >= 5
    wanted = {
        "Spin": {"X", "Axis", "Seconds a turn", "The other way round", "Phase, turns"},
        "Orbit": {"Radius", "Axis", "Seconds a turn", "the origin of the parent"},
        "Path": {"##point", "x", "Add a point", "Add where it is now", "goes back", "+Z", "Round"},
        "Keyframes": {"Repeat", "Set a key (K)"},
    }
    assert wanted[title] <= {name.lstrip("#") for name in changed} | changed


def show_timeline(editor):
    timeline_panel.imgui.set_window_focus("Timeline")
    settle(editor)
    settle(editor)


@pytest.fixture
def spans(monkeypatch):
    """The last places of the time line, and of its lanes."""
    found = {}
    real = timeline_panel._draw_track

    def note(span, middle, track, time):
        found[track.node.name] = span, middle
        real(span, middle, track, time)

    monkeypatch.setattr(timeline_panel, "_draw_track", note)
    return found


def test_keys_set_keys_and_go_from_one_to_the_next(editor):
    workspace = editor.workspace
    (cab,) = select(editor, "Cab")
    press(editor, "K")
    actions.seek(workspace, 1.0)
    cab.translation = (0, 5, 0)
    press(editor, "K")
    (track,) = motions(editor).tracks
    assert track.times.tolist() == [0, 1] and track.translations[:, 1].tolist() == [0, 5]
    press(editor, "J")
    assert actions.time_of(workspace) == 0 and cab.translation.tolist() == [0, 0, 0]
    press(editor, "L")
    assert actions.time_of(workspace) == 1
    press(editor, "K", shift=True)
    assert motions(editor).tracks[0].times.tolist() == [0]
    press(editor, "Z", control=True)
    assert motions(editor).tracks == (track,)


def test_a_node_stays_where_it_was_put_when_its_last_key_is_set(editor):
    (cab,) = select(editor, "Cab")
    press(editor, "K")
    start = cab.translation
    for rise in (1.0, 2.0):  # the second time the key is the last one already
        actions.seek(editor.workspace, 2.01)
        settle(editor)
        cab.translation = cab.translation + np.array((0.0, 1.0, 0.0))
        press(editor, "K")
        settle(editor)
        np.testing.assert_allclose(cab.translation, start + np.array((0.0, rise, 0.0)))


def test_the_time_line_scrubs_and_drags_and_deletes_keys(editor, spans):
    workspace = editor.workspace
    (cab,) = select(editor, "Cab")
    for time, place in ((0.0, 0.0), (2.0, 4.0), (4.0, 0.0)):
        actions.seek(workspace, time)
        cab.translation = (0, place, 0)
        actions.set_key(workspace)
    show_timeline(editor)
    span, middle = spans["Cab"]
    assert span.length == 4.0
    ruler = middle - 1.5 * timeline_panel.imgui.get_frame_height()
    click(editor, span.place(1.0), ruler)
    assert abs(actions.time_of(workspace) - 1.0) < 0.05 and abs(cab.translation[1] - 2.0) < 0.1
    assert not workspace.is_moving
    position = workspace.document.history.position
    x, y = int(span.place(2.0)), int(middle)
    at = functools.partial(events.MouseMotion, 0, 0)
    do(editor, at(x, y), events.MouseButton("left", True, x=x, y=y))
    assert actions.time_of(workspace) == 2.0
    for step in (10, 20, 30):
        do(editor, at(x + step, y))
    do(editor, events.MouseButton("left", False, x=x + 30, y=y))
    (track,) = motions(editor).tracks
    wanted = span.time(span.place(2.0) + 30)
    assert abs(track.times[1] - wanted) < 0.1 and actions.time_of(workspace) == track.times[1]
    assert workspace.document.history.position == position + 1
    x = int(span.place(float(track.times[1])))
    do(editor, at(x, y), events.MouseButton("right", True, x=x, y=y))
    do(editor, events.MouseButton("right", False, x=x, y=y))
    assert motions(editor).tracks[0].times.tolist() == [0, 4]
    assert "Delete a key" in workspace.console.entries[-1].text


def test_playing_draws_and_pausing_brings_the_time_back(editor):
    workspace = editor.workspace
    select(editor, "Cab")
    entry(editor, "Spin").act()
    still = settle(editor)
    press(editor, "Space")
    assert workspace.is_moving
    workspace.document.animator.seek(9.5)
    press(editor, "Space")
    assert 1.5 <= workspace.document.animator.time < 4.0
    assert (settle(editor) != still).any()
    press(editor, "Home", shift=True)
    assert workspace.document.animator.time == 0.0


def test_ways_are_drawn_over_the_scene(editor):
    select(editor, "Smoke", "Cab")
    plain = settle(editor)
    for label in ("Orbit", "Path"):
        entry(editor, label).act()
        assert (settle(editor) != plain).any()
        plain = settle(editor)
    assert isinstance(motions(editor).orbits[0].place(0.0), np.ndarray)


def test_a_ruler_has_round_steps():
    found = [timeline_panel.ruler_step(least) for least in (0.3, 0.5, 0.6, 1.1, 3.0, 7.0, 70.0)]
    assert found == [0.5, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0]


def test_thousands_of_moving_nodes_do_not_slow_the_time_line(editor):
    workspace = editor.workspace
    with_many = [workspace.scene.add(name=f"n{number}") for number in range(5000)]
    workspace.document.animator.spin(with_many, period=3)
    show_timeline(editor)
    panel = editor._panels["Timeline"]
    rows = panel._found_rows()
    assert len(rows) == 5000 and panel._found_rows() is rows
    assert isinstance(rows[0][1][0], Spin) and not isinstance(rows[0][1][0], Track)


def test_the_frame_in_the_view_is_that_of_the_time(editor):
    (cab,) = select(editor, "Cab")
    entry(editor, "Spin").act()
    editor.workspace.plays = True
    for _ in range(3):
        settle(editor)
    editor.workspace.plays = False
    figures, frame = editor._scene._figures, editor._scene._frame
    for time, said in ((0.0, "0.00 s, frame 0"), (0.5, "0.50 s, frame 12"), (2.0, "frame 48")):
        editor.workspace.document.animator.seek(time)
        assert figures.text(frame).endswith(said)
    editor.workspace.display.fps = 30
    assert figures.text(frame).endswith("frame 60")

"""What keys alone do: ways through the tree, between panels, to parents, to commands, to files."""

import numpy as np
import pytest
from editor.ui.editor_hands import do, find, press, settle

import engine3d as e3d
from engine3d import events
from engine3d.apps.editor.scene_state import SceneState
from engine3d.apps.editor.ui.keyboard.panel_focus import focused_panel
from engine3d.apps.editor.ui.keys_window import KeysWindow
from engine3d.apps.editor.ui.workspace import PANELS


def type_text(editor, text):
    do(editor, *(events.TextEntered(letter) for letter in text))


def go_to(editor, panel):
    editor.workspace.go_to(panel)
    settle(editor)
    settle(editor)


def selected(editor):
    return [node.name for node in editor.workspace.document.selection.nodes]


@pytest.fixture
def planets(editor):
    """An editor with two nodes and one below the first, beside nothing else."""
    workspace = editor.workspace
    workspace.new()
    workspace.panels.offers_start = False
    scene = workspace.scene
    for node in list(scene.nodes):
        scene.remove(node)
    sun = scene.add(e3d.uv_sphere(), name="sun")
    scene.add(e3d.uv_sphere(0.2), name="earth", parent=sun, translation=(2, 0, 0))
    scene.add(e3d.uv_sphere(0.1), name="moon", translation=(3, 0, 0))
    settle(editor)
    return editor


def test_enter_takes_the_first_scene_to_start_from(editor):
    press(editor, "N", control=True)
    assert editor.workspace.panels.offers_start
    editor.workspace.scene.add(name="gone")
    press(editor, "Return")
    assert not editor.workspace.panels.offers_start
    assert [node.name for node in editor.workspace.scene.nodes] == ["key light", "camera"]


def test_f6_goes_from_panel_to_panel_and_back(editor):
    go_to(editor, "Hierarchy")
    seen = []
    for _ in PANELS:
        seen.append(focused_panel())
        press(editor, "F6")
    assert tuple(seen) == PANELS and focused_panel() == PANELS[0]
    press(editor, "F6", shift=True)
    assert focused_panel() == PANELS[-1]
    editor.workspace.panels.closed = {"Hierarchy", "Scene"}
    press(editor, "F6")
    assert focused_panel() == "Properties"


def test_f6_leads_away_from_a_text(editor):
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "F2")
    press(editor, "F6")
    assert focused_panel() == "Scene"
    assert find(editor, "Cab")


def test_arrows_go_through_the_tree_and_open_it(planets):
    go_to(planets, "Hierarchy")
    steps = (
        ("Down", ["sun"]),
        ("Down", ["moon"]),
        ("Down", ["moon"]),
        ("Up", ["sun"]),
        ("Right", ["sun"]),
        ("Right", ["earth"]),
        ("Left", ["sun"]),
        ("Left", ["sun"]),
        ("Down", ["moon"]),
        ("PageUp", ["sun"]),
    )
    for key, names in steps:
        press(planets, key)
        assert selected(planets) == names, key
    assert not planets.workspace.hierarchy.is_open(find(planets, "sun"))


def test_shift_and_arrows_select_several_rows(planets):
    go_to(planets, "Hierarchy")
    planets.workspace.hierarchy.set_open(find(planets, "sun"), True)
    planets.workspace.document.selection.set([find(planets, "moon")])
    press(planets, "Up", shift=True)
    press(planets, "Up", shift=True)
    assert selected(planets) == ["earth", "moon", "sun"], "the last one reached is active"
    press(planets, "Down", shift=True)
    assert selected(planets) == ["moon", "earth"]


def test_enter_in_the_tree_leads_to_properties(planets):
    go_to(planets, "Hierarchy")
    press(planets, "Down")
    press(planets, "Return")
    assert focused_panel() == "Properties"
    press(planets, "Return")
    type_text(planets, "star")
    press(planets, "Tab")
    assert planets.workspace.document.selection.active.name == "star", "Tab takes it, too"
    assert len(planets.workspace.document.history.steps) == 1


def test_the_search_of_the_tree_leads_to_what_it_found(planets):
    press(planets, "F", control=True)
    settle(planets)
    type_text(planets, "ear")
    assert planets.workspace.hierarchy.search == "ear"
    press(planets, "Return")
    assert selected(planets) == ["earth"]
    press(planets, "Up")
    press(planets, "Up")
    assert selected(planets) == ["sun"], "arrows go on in the tree"


def test_nothing_is_gone_to_below_a_node_of_which_only_the_name_was_found(planets):
    for name in ("sun", "moon"):
        planets.workspace.hierarchy.search = name
        go_to(planets, "Hierarchy")
        planets.workspace.document.selection.set([find(planets, name)])
        press(planets, "Right")
        assert selected(planets) == [name]
    planets.workspace.hierarchy.search = "n"  # sun and moon, not earth
    planets.workspace.document.selection.set([find(planets, "sun")])
    press(planets, "Right")
    assert selected(planets) == ["sun"]
    assert not [entry for entry in planets.workspace.console.entries if "Error" in entry.text]


def test_a_parent_is_chosen_by_its_name_and_taken_back(planets):
    workspace, moon, earth = planets.workspace, find(planets, "moon"), find(planets, "earth")
    before, place = SceneState(workspace.scene), moon.world_pose
    workspace.document.selection.set([moon])
    press(planets, "P", control=True)
    type_text(planets, "eart")
    press(planets, "Return")
    assert moon.parent is earth and workspace.hierarchy.is_open(earth)
    np.testing.assert_allclose(moon.world_pose, place)
    press(planets, "P", control=True, shift=True)
    assert moon.parent is None
    press(planets, "P", control=True, shift=True)
    assert len(workspace.document.history.steps) == 2, "it was there already"
    workspace.undo()
    workspace.undo()
    assert SceneState(workspace.scene) == before


def test_what_is_below_a_node_is_no_parent_of_it(planets):
    planets.workspace.document.selection.set([find(planets, "sun")])
    press(planets, "P", control=True)
    from imgui_bundle import imgui

    type_text(planets, "earth")
    told = len(planets.workspace.console.entries)
    press(planets, "Return")
    assert imgui.is_popup_open("", imgui.PopupFlags_.any_popup), "nothing was found to choose"
    assert len(planets.workspace.console.entries) == told
    for _ in "earth":
        press(planets, "Backspace")
    type_text(planets, "moon")
    press(planets, "Return")
    assert find(planets, "sun").parent is find(planets, "moon"), "it is still typed into"
    press(planets, "Z", control=True)
    press(planets, "P", control=True)
    press(planets, "Escape")
    press(planets, "Delete")
    assert [node.name for node in planets.workspace.scene.nodes] == ["moon"], "it is closed"


def test_arrows_choose_in_a_list(planets):
    moon = find(planets, "moon")
    planets.workspace.document.selection.set([moon])
    press(planets, "P", control=True)
    for key in ("Down", "Down", "Down", "Up", "Return"):
        press(planets, key)
    assert moon.parent is find(planets, "sun"), "after none, of sun and earth"


def test_nodes_are_pasted_below_another(planets):
    workspace, moon = planets.workspace, find(planets, "moon")
    workspace.document.selection.set([moon])
    press(planets, "C", control=True)
    workspace.document.selection.set([find(planets, "earth")])
    press(planets, "V", control=True, shift=True)
    twin = workspace.document.selection.active
    assert twin is not moon and twin.parent is find(planets, "earth")
    np.testing.assert_allclose(twin.world_pose, moon.world_pose)
    workspace.undo()
    assert len(workspace.scene.nodes) == 3


def test_a_command_is_found_by_its_name(planets):
    press(planets, "F3")
    type_text(planets, "add sphere")
    press(planets, "Return")
    assert selected(planets) == ["sphere"]
    press(planets, "F3")
    type_text(planets, "go timeline")
    press(planets, "Return")
    settle(planets)
    assert focused_panel() == "Timeline"


@pytest.mark.parametrize(
    "tool, key, changed",
    [
        ("W", "Right", ("translation", (3.25, 0, 0))),
        ("W", "Up", ("translation", (3, 0, -0.25))),
        ("W", "PageUp", ("translation", (3, 0.25, 0))),
        ("E", "Right", ("euler", (0, np.radians(15), 0))),
        ("E", "PageDown", ("euler", (0, 0, -np.radians(15)))),
        ("R", "Up", ("scale", (1.1, 1.1, 1.1))),
    ],
)
def test_arrows_move_turn_and_scale_what_is_selected(planets, tool, key, changed):
    moon = find(planets, "moon")
    planets.workspace.look_from("Front")
    planets.workspace.document.selection.set([moon])
    before = SceneState(planets.workspace.scene)
    press(planets, tool)
    press(planets, key)
    name, value = changed
    np.testing.assert_allclose(getattr(moon, name), value, atol=1e-12)
    back = {"Right": "Left", "Up": "Down", "PageUp": "PageDown", "PageDown": "PageUp"}[key]
    press(planets, back)
    np.testing.assert_allclose(moon.world_pose[:3, 3], (3, 0, 0), atol=1e-12)
    np.testing.assert_allclose(moon.scale, 1)
    planets.workspace.undo()
    planets.workspace.undo()
    assert SceneState(planets.workspace.scene) == before


def test_shift_makes_a_tenth_of_a_step_along_the_axes_that_one_sees(planets):
    moon = find(planets, "moon")
    planets.workspace.look_from("Right")
    planets.workspace.document.selection.set([moon])
    press(planets, "W")
    press(planets, "Right", shift=True)
    np.testing.assert_allclose(moon.translation, (3, 0, -0.025))


def test_arrows_leave_flat_nodes_and_rendered_views_alone(planets):
    workspace, moon = planets.workspace, find(planets, "moon")
    moon.scale = (1, 0, 1)
    workspace.document.selection.set([moon])
    workspace.tools.is_local = True
    for tool in "WER":
        press(planets, tool)
        press(planets, "PageUp")
    assert not [entry for entry in workspace.console.entries if "Error" in entry.text]
    workspace.display.as_rendered = True
    steps = len(workspace.document.history.steps)
    press(planets, "Right")
    assert len(workspace.document.history.steps) == steps


def test_a_held_arrow_is_one_step(planets):
    workspace, moon = planets.workspace, find(planets, "moon")
    workspace.document.selection.set([moon])
    press(planets, "W")
    from imgui_bundle import imgui

    imgui.get_io().key_repeat_delay = imgui.get_io().key_repeat_rate = 1e-4
    do(planets, events.KeyDown("Right", "Right"))
    settle(planets)
    do(planets, events.KeyUp("Right", "Right"))
    assert moon.translation[0] > 3.3
    assert len(workspace.document.history.steps) == 1


def test_keys_turn_and_move_the_view_and_bring_it_nearer(editor):
    view = editor.workspace.view
    azimuth, elevation, distance = view.azimuth, view.elevation, view.distance
    press(editor, "6")
    press(editor, "8")
    assert view.azimuth == pytest.approx(azimuth + np.radians(15))
    assert view.elevation == pytest.approx(elevation + np.radians(15))
    press(editor, "4")
    press(editor, "2")
    assert (view.azimuth, view.elevation) == pytest.approx((azimuth, elevation))
    for shift in (False, True):  # most keyboards type a plus with Shift
        press(editor, "+", shift=shift)
        assert view.distance < distance
        press(editor, "-")
        assert view.distance == pytest.approx(distance)
    for place, sign, change in (("6", "-", 15), ("4", "'", 0)):  # of the row of digits on AZERTY
        do(editor, events.KeyDown(sign, place), events.KeyUp(sign, place))
        assert view.azimuth == pytest.approx(azimuth + np.radians(change))
    target, (right, up, _) = view.target.copy(), view.rotation().T
    for key, axis in (("6", right), ("8", up)):
        press(editor, key, control=True)
        assert np.dot(view.target - target, axis) > 0, key
        press(editor, {"6": "4", "8": "2"}[key], control=True)
        np.testing.assert_allclose(view.target, target, atol=1e-9)


def test_a_file_is_chosen_by_arrows_and_enter(editor, tmp_path, monkeypatch):
    folder = tmp_path / "models"
    folder.mkdir()
    e3d.save_scene(e3d.Scene(), folder / "a.e3d.json")
    e3d.save_scene(e3d.Scene(), folder / "b.e3d.json")
    dialog = editor._files._dialog
    monkeypatch.setattr(dialog._last, "of_known", str(tmp_path))
    press(editor, "O", control=True)
    settle(editor)
    type_text(editor, "models")
    press(editor, "Return")
    settle(editor)
    assert dialog._folder == str(folder)
    do(editor, events.KeyDown("Left Alt", "Left Alt"), events.KeyDown("Up", "Up"))
    do(editor, events.KeyUp("Up", "Up"), events.KeyUp("Left Alt", "Left Alt"))
    assert dialog._folder == str(tmp_path)
    settle(editor)
    for key in ("Down", "Return"):
        press(editor, key)
    settle(editor)
    assert dialog._folder == str(folder)
    for key in ("Down", "Down", "Return"):
        press(editor, key)
    assert editor.workspace.document.path == str(folder / "b.e3d.json")


@pytest.mark.parametrize("typed", ["", "mine"])
def test_a_new_file_keeps_its_name_in_another_folder(editor, tmp_path, monkeypatch, typed):
    (tmp_path / "here").mkdir()
    monkeypatch.setattr(editor._files._dialog._last, "of_new", str(tmp_path))
    press(editor, "S", control=True)
    settle(editor)
    type_text(editor, typed)
    for key in ("Down", "Return"):
        press(editor, key)
    settle(editor)
    press(editor, "Return")
    assert (tmp_path / "here" / f"{typed or 'scene'}.e3d.json").exists()


def test_what_is_typed_in_the_list_of_keys_is_looked_for_there(editor):
    cab = find(editor, "Cab")
    editor.workspace.document.selection.set([cab])
    press(editor, "F1")
    settle(editor)
    for letter in "he":
        do(editor, events.KeyDown(letter.upper(), letter.upper()), events.TextEntered(letter))
        do(editor, events.KeyUp(letter.upper(), letter.upper()))
    (keys,) = (one for one in editor._dialogs if isinstance(one, KeysWindow))
    assert keys._search == "he"
    assert cab.visible and editor.workspace.tools.chosen == "select"
    press(editor, "Escape")
    assert not editor.workspace.panels.shows_keys


def test_arrows_and_space_act_again_after_a_dialog(planets):
    workspace, moon = planets.workspace, find(planets, "moon")
    workspace.document.animator.spin(moon, period=5)
    workspace.document.selection.set([moon])
    press(planets, "W")
    for dialog in ("P", "S"):
        press(planets, dialog, control=True)
        settle(planets)
        press(planets, "Escape")
        settle(planets)
        before = moon.translation[1]
        press(planets, "PageUp")
        assert moon.translation[1] == before + 0.25, dialog
    go_to(planets, "Hierarchy")
    press(planets, "F2")
    settle(planets)
    press(planets, "Return")
    settle(planets)
    press(planets, "Space")
    assert workspace.plays

"""What keys do in the editor: to the scene, to names, to time, and to questions."""

import functools
from types import SimpleNamespace

import pytest
from editor.ui.editor_hands import click, do, find, press, scene_corner, settle

import engine3d as e3d
from engine3d import events
from engine3d.apps.editor.scene_state import SceneState
from engine3d.apps.editor.ui.keys_window import KeysWindow


def test_keys_duplicate_delete_and_undo(editor):
    scene, workspace = editor.workspace.scene, editor.workspace
    count = len(scene.nodes)
    cab = find(editor, "Cab")
    workspace.document.selection.set([cab])
    press(editor, "D", control=True)
    assert len(scene.nodes) == count + 1
    assert workspace.document.selection.active.name == "Cab 2"
    press(editor, "Delete")
    assert len(scene.nodes) == count
    press(editor, "Z", control=True)
    press(editor, "Z", control=True)
    assert len(scene.nodes) == count and not workspace.document.is_modified
    press(editor, "Z", control=True, shift=True)
    assert len(scene.nodes) == count + 1 and workspace.document.is_modified


def test_keys_that_come_at_once_count_one_after_the_other(editor):
    nodes = editor.workspace.scene.nodes
    name = "Left Ctrl"
    for key in "AQAQ":
        editor._late += [
            events.KeyDown(name, name, False, True),
            events.KeyDown(key, key, False, True),
            *(events.KeyUp(name, name), events.KeyUp(key, key))[:: 1 if key == "Q" else -1],
        ]
    while editor._pictures_due or editor._late:
        editor.turn(0.0)
    assert editor.workspace.wants_exit
    assert len(nodes) > 1 and editor.workspace.document.selection.nodes == ()


@pytest.fixture
def on_macos(monkeypatch):
    monkeypatch.setattr("engine3d.base.command_key.sys", SimpleNamespace(platform="darwin"))


@pytest.mark.parametrize("name", ["Left GUI", "Right GUI", "Left Ctrl", "Right Ctrl"])
def test_cmd_and_control_are_held_for_commands_on_macos(on_macos, editor, name):
    from imgui_bundle import imgui

    count = len(editor.workspace.scene.nodes)
    editor.workspace.document.selection.set([find(editor, "Cab")])
    do(editor, events.KeyDown(name, name, False, True))
    assert imgui.get_io().key_ctrl and not imgui.get_io().key_super
    do(editor, events.KeyDown("D", "D", False, True), events.KeyUp("D", "D"))
    assert len(editor.workspace.scene.nodes) == count + 1
    do(editor, events.KeyUp(name, name))
    assert not imgui.get_io().key_ctrl and not imgui.get_io().key_super


def test_the_windows_key_is_not_control_elsewhere(editor):
    count = len(editor.workspace.scene.nodes)
    editor.workspace.document.selection.set([find(editor, "Cab")])
    do(editor, events.KeyDown("Left GUI", "Left GUI"))
    press(editor, "D")
    assert len(editor.workspace.scene.nodes) == count


def test_the_list_of_keys_names_cmd_on_macos(on_macos, editor):
    shown = [" ".join(row) for row in KeysWindow(editor.workspace, editor._entries)._shown_rows()]
    assert any(row.startswith("Cmd+Shift+Z ") for row in shown)
    assert any(row.startswith("Cmd while a handle is dragged ") for row in shown)
    assert [row for row in shown if "Ctrl" in row] == ["Ctrl+M New material Edit"]


def test_f2_renames(editor):
    cab = find(editor, "Cab")
    editor.workspace.document.selection.set([cab])
    press(editor, "F2")
    do(editor, *(events.TextEntered(letter) for letter in "Hütte"))
    press(editor, "Return")
    assert cab.name == "Hütte"
    press(editor, "Z", control=True)
    assert cab.name == "Cab"


def test_letters_choose_tools_unless_somebody_types(editor):
    press(editor, "W")
    assert editor.workspace.tools.chosen == "move"
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "F2")
    press(editor, "E")
    assert editor.workspace.tools.chosen == "move"


def test_time_goes_on_until_space_is_pressed_again(editor):
    workspace, base = editor.workspace, find(editor, "Base")
    press(editor, "Space")
    assert not workspace.plays and "nothing moves" in workspace.console.entries[-1].text
    workspace.document.animator.spin(base, period=5)
    still = settle(editor)
    press(editor, "Space")
    assert workspace.document.animator.time > 0 and editor._pictures_due
    press(editor, "Space")
    time, paused = workspace.document.animator.time, settle(editor)
    assert (paused != still).any() and (settle(editor) == paused).all()
    assert workspace.document.animator.time == time and not workspace.document.is_modified
    workspace.rewind()
    assert base.rotation.tolist() == [0, 0, 0, 1]


@pytest.mark.parametrize("key, shift", [("Home", True), ("Home", False), ("End", False)])
def test_space_plays_after_keys_that_lead_to_an_end(editor, key, shift):
    workspace = editor.workspace
    workspace.document.animator.spin(find(editor, "Base"), period=5)
    x, y = scene_corner(editor)
    click(editor, x + 5, y + 60)  # the panel of the scene has the keyboard
    workspace.document.selection.set([find(editor, "Base")])
    press(editor, key, shift=shift)
    press(editor, "Space")
    assert workspace.plays and workspace.tools.chosen == "select"


@pytest.mark.parametrize(
    "key, answer", [("Return", "one"), ("Keypad Enter", "one"), ("Escape", "three")]
)
def test_a_question_hears_keys(editor, key, answer):
    given = []
    answers = ("one", "two", "three")
    editor._files._ask("Which?", {name: functools.partial(given.append, name) for name in answers})
    settle(editor)
    press(editor, key)
    assert given == [answer]
    press(editor, key)
    assert given == [answer], "the question is closed"


def test_a_question_hears_the_arrows(editor):
    given = []
    answers = ("one", "two", "three")
    editor._files._ask("Which?", {name: functools.partial(given.append, name) for name in answers})
    settle(editor)
    press(editor, "Right")
    press(editor, "Return")
    assert given == ["two"]


def test_a_new_material_of_the_selection_is_one_step(editor):
    document = editor.workspace.document
    meshes = [node for node in document.scene.nodes if isinstance(node.object, e3d.Mesh)]
    before = SceneState(document.scene)
    for nodes in (meshes[:2], []):
        document.selection.set(nodes)
        press(editor, "M", control=True)
        assert len(document.history.steps) == 1
        (made,) = [one for one in document.resources.kept_materials if one.name == "material"]
        assert all(made in node.object.materials for node in nodes)
        document.undo()
        assert SceneState(document.scene) == before and document.resources.kept_materials == ()


def test_f10_opens_the_menus_for_arrows_and_enter_each_time_from_the_first(editor):
    for key in ("F10", "Down", "Return"):
        press(editor, key)
    assert editor._files._dialog._title == "Open a file", "the second line of the first menu"
    press(editor, "Escape")
    for lines, tool in ((2, "move"), (3, "rotate")):
        for key in ("F10", "Right", "Right", "Right", *["Down"] * lines, "Return"):
            press(editor, key)
        assert editor.workspace.tools.chosen == tool

"""Files in the editor's window: dropped, chosen, saved, loaded into nodes, left behind."""

import os
import time
from importlib.resources import files

import pytest
from editor.ui.editor_hands import SIZE, click, do, find, middle_of, press, settle

import engine3d as e3d
from engine3d import data, events
from engine3d.apps.editor.recovery import root_of


def test_files_that_are_dropped_are_added_and_a_bad_one_is_told(editor, tmp_path):
    teapot = str(files(data) / "models" / "teapot.obj")
    count = len(editor.workspace.scene.nodes)
    bad = tmp_path / "bad.obj"
    bad.write_text("f 1 2 3\n")
    do(editor, events.FilesDropped((str(bad), teapot)))
    added = editor.workspace.scene.nodes[count:]
    assert [node.name for node in added][0] == "teapot" and added[1].parent is added[0]
    errors = [entry.text for entry in editor.workspace.console.filtered(["error"])]
    assert len(errors) == 1 and "bad.obj" in errors[0]
    press(editor, "Z", control=True)
    assert len(editor.workspace.scene.nodes) == count


def test_an_image_paints_the_node_that_it_is_dropped_onto(editor):
    cab = find(editor, "Cab")
    image = str(files(data) / "models" / "teapot.tga")
    x, y = middle_of(editor, cab)
    do(editor, events.MouseMotion(0, 0, x, y), events.FilesDropped((image,)))
    assert cab.object.materials[0].texture is not None
    press(editor, "Z", control=True)
    assert cab.object.materials[0].texture is None


def test_a_scene_is_saved_and_opened_again(editor, tmp_path):
    asked, path = editor._files, tmp_path / "train.e3d.json"
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "Delete")
    names = [node.name for node in editor.workspace.scene.nodes]
    press(editor, "S", control=True)
    asked._dialog._go(str(tmp_path))
    do(editor, *(events.TextEntered(letter) for letter in "train"))
    press(editor, "Return")
    assert path.exists() and not editor.workspace.document.is_modified
    assert editor.window.title == "train.e3d.json - engine3d"
    press(editor, "N", control=True)
    assert [node.name for node in editor.workspace.scene.nodes] == ["key light", "camera"]
    press(editor, "O", control=True)
    settle(editor)
    assert asked._dialog._recent.paths() == (str(path), str(files(data) / "models" / "train.asc"))
    asked._dialog._name = path.name
    asked._dialog._finish()
    settle(editor)
    assert [node.name for node in editor.workspace.scene.nodes] == names


def test_a_file_is_opened_by_two_clicks(editor, tmp_path):
    (tmp_path / "inside").mkdir()
    e3d.box().save(tmp_path / "inside" / "box.obj")
    dialog = editor._files._dialog
    press(editor, "O", control=True)
    dialog._go(str(tmp_path))
    settle(editor)
    x = SIZE[0] // 2
    y = next(y for y in range(120, 400, 9) if click(editor, x, y) or dialog._name == "inside")
    for _ in range(2):
        time.sleep(0.4)  # this is another double click
        click(editor, x, y)
        click(editor, x, y)
    assert editor.workspace.document.scene.nodes[0].name == "box"
    assert not editor.workspace.console.filtered(["error"])


def test_what_is_not_saved_is_asked_about(editor):
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "Delete")
    do(editor, events.CloseRequested())
    assert not editor.workspace.wants_exit
    assert list(editor._files._answers) == ["Save", "Discard", "Cancel"]
    press(editor, "Z", control=True)  # keys do nothing to the scene behind the question
    assert editor.workspace.document.is_modified
    editor._files._answers["Discard"]()
    assert editor.workspace.wants_exit


def test_a_scene_that_was_left_behind_is_offered(editor, monkeypatch):
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "Delete")
    count = len(editor.workspace.scene.nodes)
    assert editor.workspace._autosave.save()
    monkeypatch.setattr("engine3d.apps.editor.autosave._is_locked", lambda path: False)
    editor._files.offer_recovery()
    settle(editor)
    editor.workspace._autosave._path = None  # as if its process had ended
    editor._files._answers["Recover"]()
    settle(editor)
    assert len(editor.workspace.scene.nodes) == count and editor.workspace.document.is_modified


@pytest.mark.parametrize(
    ("system", "environment", "root"),
    [
        ("posix", {}, "/"),
        ("posix", {"SYSTEMDRIVE": "D:"}, "/"),
        ("nt", {"SYSTEMDRIVE": "D:"}, "D:/"),
        ("nt", {"SYSTEMDRIVE": ""}, "C:/"),
        ("nt", {}, "C:/"),
    ],
)
def test_what_is_left_behind_names_its_files_from_a_root(system, environment, root):
    assert root_of(system, environment) == root


def test_a_texture_is_loaded_into_a_slot(editor, tmp_path):
    workspace, material = editor.workspace, find(editor, "Cab").object.materials[0]
    assert not workspace.load_texture(str(tmp_path / "none.png"), [material], "texture")
    assert "none.png" in workspace.console.entries[-1].text
    image = str(files(data) / "models" / "teapot.tga")
    assert workspace.load_texture(image, [material], "texture")
    assert material.texture.pixels.shape[2] == 4
    workspace.undo()
    assert material.texture is None


def test_a_mesh_is_loaded_into_a_node_and_removed(editor, tmp_path):
    workspace, cab = editor.workspace, find(editor, "Cab")
    old = cab.object
    assert not workspace.load_mesh(str(tmp_path / "none.obj"), cab)
    assert workspace.load_mesh(str(files(data) / "models" / "teapot.obj"), cab)
    assert cab.object is not old
    workspace.undo()
    assert cab.object is old


def test_a_new_file_does_not_go_where_a_mesh_was_loaded(editor, tmp_path):
    dialog, cab = editor._files._dialog, find(editor, "Cab")
    editor._files.load_mesh(cab)
    dialog._go(str(tmp_path))
    settle(editor)
    press(editor, "Escape")
    editor._files.load_mesh(cab)
    assert dialog._folder == str(tmp_path), "the next mesh lies beside the last one"
    dialog.ask("Save the scene", {"Scenes": (".e3d.json",)}, print, name="scene.e3d.json")
    assert dialog._folder == os.getcwd()


def test_what_is_exported_goes_beside_the_scene(editor, tmp_path):
    assert editor.workspace.save(str(tmp_path / "train.e3d.json"))
    editor._files.export()
    assert editor._files._dialog._folder == str(tmp_path)
    editor._files._dialog._go(str(tmp_path.parent))
    editor._files.export()
    assert editor._files._dialog._folder == str(tmp_path.parent), "where the last one went"


def test_a_file_that_is_opened_by_keys_ends_the_choice_of_starts(editor, tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.box(), name="one")
    e3d.save_scene(scene, tmp_path / "a.e3d.json")
    press(editor, "N", control=True)
    assert editor.workspace.panels.offers_start
    press(editor, "O", control=True)
    dialog = editor._files._dialog
    dialog._go(str(tmp_path))
    dialog._name = "a.e3d.json"
    dialog._finish()
    settle(editor)
    press(editor, "Return")  # would choose the first start
    assert not editor.workspace.panels.offers_start
    assert [node.name for node in editor.workspace.scene.nodes] == ["one"]

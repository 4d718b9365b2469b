"""Menus say what undo does, and stand still where nothing is to be done; the clipboard works."""

import itertools

import numpy as np
from editor.ui.editor_hands import click, do, find, middle_of, press, settle

import engine3d as e3d
from engine3d import events
from engine3d.apps.editor.ui import menus
from engine3d.apps.editor.ui.materials import material_actions as actions
from engine3d.apps.editor.ui.materials import materials_panel


def entry(editor, label):
    return next(each for each in editor._entries if each.label == label)


def test_undo_and_redo_name_their_step(editor):
    undo, redo = entry(editor, "Undo"), entry(editor, "Redo")
    assert (undo.says(), redo.says()) == ("Undo", "Redo")
    assert not undo.is_enabled() and not redo.is_enabled()
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "D", control=True)
    assert undo.says() == "Undo duplicate 'Cab'" and undo.is_enabled()
    press(editor, "Z", control=True)
    assert redo.says() == "Redo duplicate 'Cab'" and redo.is_enabled() and not undo.is_enabled()


def test_what_needs_a_selection_waits_for_one(editor):
    waiting = {each.label for each in editor._entries if not each.is_enabled()}
    assert {"Cut", "Copy", "Rename", "Duplicate", "Group", "Delete", "Set a key"} <= waiting
    assert {"Paste", "Select all", "Save"}.isdisjoint(waiting)
    editor.workspace.document.selection.set([find(editor, "Cab")])
    now = {each.label for each in editor._entries if not each.is_enabled()}
    assert "Cut" in waiting - now


def test_keys_copy_cut_and_paste(editor):
    workspace = editor.workspace
    scene, count = workspace.scene, len(workspace.scene.nodes)
    cab = find(editor, "Cab")
    workspace.document.selection.set([cab])
    press(editor, "C", control=True)
    assert '"Cab"' in editor.window.clipboard and len(scene.nodes) == count
    press(editor, "V", control=True)
    pasted = workspace.document.selection.active
    assert len(scene.nodes) == count + 1 and pasted.object is cab.object
    press(editor, "X", control=True)
    assert len(scene.nodes) == count and entry(editor, "Undo").says() == "Undo cut 'Cab 2'"
    press(editor, "V", control=True)
    press(editor, "Z", control=True)
    press(editor, "Z", control=True)
    press(editor, "Z", control=True)
    assert len(scene.nodes) == count and not workspace.document.is_modified


def test_text_that_is_no_node_is_told(editor):
    editor.window.clipboard = "hello"
    press(editor, "V", control=True)
    last = editor.workspace.console.entries[-1]
    assert last.level == "error" and "the clipboard holds no nodes" in last.text


def test_recent_files_are_in_the_menu(editor, tmp_path, monkeypatch):
    path = tmp_path / "a.e3d.json"
    scene = e3d.Scene()
    scene.add(e3d.box(), name="one")
    e3d.save_scene(scene, path)
    editor.workspace.recent.add(path)
    places, real = {}, menus.imgui.menu_item_simple
    draw = menus._draw_recent

    def note(label, *rest):
        at = menus.imgui.get_cursor_screen_pos()
        places[label] = int(at.x) + 20, int(at.y) + 8
        return real(label, *rest)

    def note_recent(*given):
        at = menus.imgui.get_cursor_screen_pos()
        places["Open recent"] = int(at.x) + 20, int(at.y) + 8
        draw(*given)

    monkeypatch.setattr(menus.imgui, "menu_item_simple", note)
    monkeypatch.setattr(menus, "_draw_recent", note_recent)
    click(editor, 20, 10)
    click(editor, *places["Open recent"])
    (label,) = (each for each in places if each.startswith("a.e3d.json"))
    click(editor, *places[label])
    assert [node.name for node in editor.workspace.scene.nodes] == ["one"]
    editor.workspace.recent.clear()
    assert editor.workspace.recent.paths() == ()


def test_the_view_tells_how_many_objects_it_draws(editor):
    figures, frame = editor._scene._figures, editor._scene._frame
    text = figures.text(frame)
    count = sum(isinstance(node.object, e3d.Mesh) for node in editor.workspace.scene.nodes)
    assert f"{count} of {count} objects drawn" in text
    assert " fps" in text or "at rest" in text
    editor.workspace.scene.add(e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1)] * 5))
    editor.workspace.scene.add(e3d.box(), translation=(0, 0, 1e4))
    assert f"of {count + 6} objects" in figures.text(frame)
    assert "draws" in text and "triangles" in text and " ms" in text


def test_the_grid_is_no_object_and_no_draw_of_the_view(editor):
    workspace, texts = editor.workspace, []
    workspace.scene.add(e3d.DirectionalLight())
    for shown in (False, True):
        editor._scene._overlays.shown["grid"] = shown
        settle(editor)
        texts.append(editor._scene._figures.text(editor._scene._frame).split(", ")[2:])
    assert texts[0] == texts[1]
    for node in workspace.scene.nodes:
        node.visible = False
    settle(editor)
    assert ", 0 draws, " in editor._scene._figures.text(editor._scene._frame)


def test_a_material_is_dropped_on_what_is_under_the_mouse(editor):
    workspace = editor.workspace
    panel = editor._panels["Materials"]
    material = e3d.Material(color=(250, 0, 250), name="pink")
    workspace.resources.keep(material)
    materials_panel.imgui.set_window_focus("Materials")
    settle(editor)
    places = {}
    real = panel._draw_cell

    def note(each, offset, height):
        at = materials_panel.imgui.get_cursor_screen_pos()
        places[each.name] = int(at.x + offset + 20), int(at.y + 20)
        real(each, offset, height)

    panel._draw_cell = note
    for _ in range(4):
        settle(editor)
    cab = find(editor, "Cab")
    x, y = middle_of(editor, cab)
    start = places["pink"]
    do(
        editor,
        events.MouseMotion(0, 0, *start),
        events.MouseButton("left", True, x=start[0], y=start[1]),
    )
    for step in (0.3, 0.6, 1.0):
        place = [int(a + (b - a) * step) for a, b in zip(start, (x, y), strict=True)]
        do(editor, events.MouseMotion(0, 0, *place))
    do(editor, events.MouseButton("left", False, x=x, y=y))
    assert material in cab.object.materials
    assert "Give pink to 'Cab'" in workspace.console.entries[-1].text
    click(editor, *start)
    assert panel._chosen is material


def test_buttons_of_materials_make_and_copy_them(editor):
    workspace = editor.workspace
    workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "M", control=True)
    material = workspace.resources.find("material", "material")
    assert set(find(editor, "Cab").object.materials) == {material}
    twin = actions.add(workspace, material)
    actions.rename(workspace, twin, "other")
    actions.set_physical(workspace, [twin], True)
    assert twin.is_physical and not material.is_physical and twin.name == "other"
    actions.discard(workspace, material)
    assert "nodes use" in workspace.console.entries[-1].text
    actions.discard(workspace, twin)
    assert workspace.resources.find("other") is None
    for _ in range(4):
        workspace.undo()
    assert twin.name == "material 2"


def test_a_name_of_gltf_is_asked_about(editor, tmp_path):
    files = editor._files
    files._save_or_export(str(tmp_path / "x.glb"), lambda: None)
    settle(editor)
    assert list(files._answers) == ["Save as x.e3d.json", "Export as x.glb", "Cancel"]
    files._answers["Export as x.glb"]()
    assert (tmp_path / "x.glb").exists() and not list(tmp_path.glob("*.json"))
    assert editor.workspace.document.path is None
    files._answers["Save as x.e3d.json"]()
    assert (tmp_path / "x.e3d.json").exists()


def test_pictures_and_turns_are_drawn_from_the_dialog(editor, tmp_path):
    dialog = editor._rendering
    press(editor, "F12")
    settle(editor)
    dialog.choices.size = (64, 48)
    dialog.choices.what = "turn"
    dialog.choices.pictures = 3
    shots = dialog.shots()
    assert len(shots) == 3 and len({shot.pose.tobytes() for shot in shots}) == 3
    press(editor, "Escape")
    dialog.render_to(str(tmp_path / "turn.webp"))
    assert dialog.is_waiting
    while dialog.is_waiting:
        settle(editor)
    assert (tmp_path / "turn.webp").exists()
    assert "Render 3 pictures" in editor.workspace.console.entries[-1].text


def test_a_window_that_closes_stops_the_drawing(editor, tmp_path):
    dialog = editor._rendering
    dialog.choices.what, dialog.choices.pictures = "turn", 400
    dialog.render_to(str(tmp_path / "turn.webp"))
    dialog.close()
    assert not (tmp_path / "turn.webp").exists() and not dialog.is_waiting


def test_what_others_hide_is_culled_by_a_switch_of_its_own(editor):
    workspace, ball = editor.workspace, e3d.uv_sphere(0.5)
    for place in itertools.product(range(10), repeat=3):
        workspace.scene.add(ball, translation=1.5 * np.array(place))
    workspace.frame(())
    frustum, hidden = entry(editor, "Frustum culling"), entry(editor, "Occlusion culling")

    def drawn():
        for _ in range(2):  # what hides others is known from the picture before
            workspace.changes += 1
            settle(editor)
        return editor._scene._frame.stats["instances_drawn"]

    fewer = drawn()
    hidden.act()
    assert frustum.is_on() and not hidden.is_on() and drawn() > max(fewer, 1000)
    frustum.act()
    assert not hidden.is_enabled() and not hidden.is_on()
    hidden.act()
    frustum.act()
    assert hidden.is_enabled() and drawn() < 1000


def test_frustum_culling_is_switched_and_changes_what_is_drawn_but_not_the_picture(editor):
    workspace = editor.workspace
    workspace.scene.add(e3d.box(), translation=(0.0, 0.0, 1e5))
    workspace.frame([find(editor, "Cab")])
    culling, figures = entry(editor, "Frustum culling"), editor._scene._figures
    texts, pictures = [], []
    for _ in range(2):
        settle(editor)
        texts.append(figures.text(editor._scene._frame).split(", ")[2])
        pictures.append(editor._scene._frame.color.tobytes())
        culling.act()
    count = sum(isinstance(node.object, e3d.Mesh) for node in workspace.scene.nodes)
    assert texts[1] == f"{count} of {count} objects drawn" != texts[0]
    assert pictures[0] == pictures[1] and culling.is_on()

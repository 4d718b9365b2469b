"""Properties shows what is selected; what it sets, fog and colliders, fits the scene."""

import ast
from pathlib import Path

import numpy as np
from editor.ui.editor_hands import click, do, find, middle_of, press, settle

from engine3d import events
from engine3d.apps.editor import ui
from engine3d.apps.editor.ui.properties import fields, fog_fields
from engine3d.apps.editor.ui.properties.collider_fields import COLLIDERS, KINDS
from engine3d.apps.editor.value_commands import SetValues
from engine3d.model.scene.fog import ExponentialFog, Fog


def test_every_panel_of_a_selected_light_camera_and_mesh_is_laid_out(editor):
    pictures = set()
    for name in ("Light01", "Camera01", "Cab"):
        editor.workspace.document.selection.set([find(editor, name)])
        pictures.add(settle(editor)[:, -200:].tobytes())
    assert len(pictures) == 3


def test_every_kind_of_collider_fits_a_mesh(editor):
    cab = find(editor, "Cab")
    for name, make in COLLIDERS.items():
        cab.collider = make(cab.object)
        assert KINDS.get(type(cab.collider), "none") == name
    workspace = editor.workspace
    workspace.document.selection.set([cab])
    settle(editor)


def test_fog_is_set_dragged_and_undone(editor):
    workspace = editor.workspace
    scene, assigned = workspace.scene, []
    workspace.document.selection.set([])
    before = settle(editor)
    for kind in (Fog, ExponentialFog):
        fog = fog_fields._new_fog(kind, scene, workspace.bounds.radius)
        workspace.do(SetValues([scene], {"fog": fog}))
        x, y = middle_of(editor, find(editor, "Cab"))  # of the scene, not of the panel
        assert (settle(editor)[y, x] != before[y, x]).any() and scene.fog == fog
        workspace.undo()
        assert scene.fog is None
    fog = Fog((9, 8, 7), 1.0, 2.0)
    for name, value in (("near", 5.0), ("far", 0.5), ("far", 0.0)):
        assigned.append(fog_fields._with(fog, name, value))
        assert getattr(assigned[-1], name) == max(value, 1e-4) and assigned[-1].color == (9, 8, 7)
    assert assigned[0].far > 5.0 and assigned[1].near < 0.5
    assert fog_fields._with(ExponentialFog((9, 8, 7), 1.0), "density", 0.25).density == 0.25


def test_a_click_on_a_number_lets_one_type_it(editor, monkeypatch):
    cab, places = find(editor, "Cab"), {}
    real = fields.imgui.drag_float

    def note(label, *rest):
        at = fields.imgui.get_cursor_screen_pos()
        places[label] = int(at.x) + 15, int(at.y) + 8
        return real(label, *rest)

    monkeypatch.setattr(fields.imgui, "drag_float", note)
    editor.workspace.document.selection.set([cab])
    settle(editor)
    before = cab.translation.copy()
    click(editor, *places["##Position 1"])
    press(editor, "A", control=True)
    do(editor, events.TextEntered("7.5"))
    press(editor, "Return")
    assert cab.translation.tolist() == [before[0], 7.5, before[2]]
    assert editor.workspace.document.selection.nodes == (cab,)
    press(editor, "Z", control=True)
    assert cab.translation.tolist() == before.tolist()


def test_one_number_of_a_uniform_scale_changes_the_others_in_proportion(editor):
    workspace, cab, base = editor.workspace, find(editor, "Cab"), find(editor, "Base")
    cab.scale, base.scale = (1, 2, 3), (4, 4, 0)
    workspace.tools.is_uniform = True
    workspace.document.selection.set([cab, base])
    workspace.go_to("Properties")
    settle(editor)
    # The section, position, rotation, and the third number of the scale.
    settle(editor)
    for _ in range(10):
        press(editor, "Tab")
    for letter in "0.5":
        do(editor, events.TextEntered(letter))
    press(editor, "Return")
    np.testing.assert_allclose(cab.scale, (1 / 6, 1 / 3, 0.5), rtol=1e-6)
    np.testing.assert_allclose(base.scale, 0.5)
    assert len(workspace.document.history.steps) == 1
    workspace.undo()
    assert cab.scale.tolist() == [1, 2, 3] and base.scale.tolist() == [4, 4, 0]


def test_labels_stand_before_what_they_name():
    named = ("drag_", "input_", "slider_", "color_edit", "combo", "begin_combo")
    seen = 0
    for path in sorted(Path(ui.__file__).parent.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
                continue
            if node.func.attr.startswith(named) and ast.unparse(node.func.value) == "imgui":
                seen += 1
                label = ast.unparse(node.args[0]).lstrip("f").strip("'\"")
                assert label.startswith("##"), f"{path.name}:{node.lineno}: {label}"
    assert seen > 20

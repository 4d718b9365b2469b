"""Properties shows what is selected; what it sets, fog and colliders, fits the scene."""

from editor.ui.editor_hands import click, do, find, middle_of, press, settle

from engine3d import events
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

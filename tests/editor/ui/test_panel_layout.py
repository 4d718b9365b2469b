"""Which panels are open, and where, is kept from one editor to the next."""

import itertools

from editor.ui.editor_hands import settle

from engine3d.apps.editor.ui.panel_layout import layout_path, load_layout, save_layout
from engine3d.apps.editor.ui.workspace import PANELS, Workspace


def test_panels_can_be_closed_and_come_back(editor):
    everything = settle(editor)
    editor.workspace.panels.closed.add("Console")
    assert (settle(editor) != everything).any()
    editor.workspace.panels.wants_usual_places = True
    assert (settle(editor) == everything).all() and not editor.workspace.panels.closed


def test_nothing_of_an_old_picture_stays_where_panels_are_closed(editor):
    closed = editor.workspace.panels.closed
    several = [set(), set(PANELS), *map(set, itertools.combinations(PANELS, 2)), {"Scene"}]
    for names in several:
        closed.clear()
        closed |= names
        settle(editor)
        editor._pixels[:] = (255, 0, 255, 255)
        shown = settle(editor)
        assert not (shown == (255, 0, 255, 255)).all(-1).any(), names


def test_closed_panels_and_steps_are_kept(editor):
    editor.workspace.panels.closed.add("Resources")
    editor.workspace.tools.steps["rotate"] = 22.5
    save_layout(editor.workspace)
    again = Workspace()
    assert load_layout(again, (1000, 640))
    assert (again.panels.closed, again.tools.steps) == (
        editor.workspace.panels.closed,
        editor.workspace.tools.steps,
    )
    layout_path().write_text("[engine3d][Editor]\nmove=-1\nturn=x\nscale\nclosed=Console,Cat\n")
    damaged = Workspace()
    assert load_layout(damaged, (1000, 640))
    assert damaged.tools.steps == Workspace().tools.steps and damaged.panels.closed <= {"Console"}


def test_places_of_panels_are_kept(editor):
    save_layout(editor.workspace)
    assert "[Docking]" in layout_path().read_text("utf-8")


def test_places_from_before_panels_had_ids_are_not_used(editor):
    save_layout(editor.workspace)
    assert load_layout(Workspace(), (1000, 640))
    text = layout_path().read_text("utf-8")
    layout_path().write_text(text.replace("form=2\n", ""), "utf-8")
    assert not load_layout(Workspace(), (1000, 640))


def test_a_layout_that_cannot_be_kept_does_no_harm(editor, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    save_layout(editor.workspace)
    assert not layout_path().exists()

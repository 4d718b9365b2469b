"""The editor's window draws when something happens, and goes on after an error of a panel."""

import numpy as np
import pytest
from editor.ui.editor_hands import click, do, find, row_of, settle

import engine3d as e3d
from engine3d import events
from engine3d.apps.editor.ui.hierarchy_panel import HierarchyPanel


def test_nothing_is_drawn_while_nothing_happens(editor):
    drawn = []
    editor.window.present = drawn.append
    for _ in range(5):
        editor.turn(0.0)
    assert drawn == []
    do(editor, events.MouseMotion(1, 1, 5, 5))
    assert len(drawn) >= 1


def test_a_click_in_the_tree_selects(editor):
    base = find(editor, "Base")
    click(editor, *row_of(editor, base))
    assert editor.workspace.document.selection.nodes == (base,)


def test_an_error_of_a_panel_is_told_and_the_editor_goes_on(editor, monkeypatch):
    def fail(self, *arguments):
        raise ZeroDivisionError("planted")

    with monkeypatch.context() as patched:
        patched.setattr(HierarchyPanel, "_draw_name", fail)
        settle(editor)
    errors = [entry.text for entry in editor.workspace.console.filtered(["error"], "planted")]
    assert errors[-1] == "ZeroDivisionError: planted"
    settle(editor)
    click(editor, *row_of(editor, find(editor, "Base")))
    assert editor.workspace.document.selection.active.name == "Base"


def test_an_error_amid_a_picture_ends_it(editor, monkeypatch):
    with monkeypatch.context() as patched:
        patched.setattr(editor, "_guarded", lambda act: raise_from(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            settle(editor)
    first = settle(editor)
    assert (settle(editor) == first).all()


def test_the_bounds_hold_the_scene_without_a_look_at_each_node(editor, monkeypatch):
    workspace = editor.workspace
    workspace.document.animator.spin(find(editor, "Base"), period=5)
    workspace.document.animator.seek(1.0)
    with monkeypatch.context() as patched:  # which takes microseconds a node
        patched.setattr(e3d.Node, "world_pose", property(lambda node: raise_from(AssertionError)))
        center, radius = workspace.bounds
    assert np.allclose(np.linalg.norm(workspace.scene.bounds - center, axis=1), radius)


def raise_from(kind):
    raise kind("planted")

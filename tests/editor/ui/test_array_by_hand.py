"""The dialog of arrays repeats the selected nodes by the keyboard alone."""

import pytest
from editor.ui.editor_hands import do, find, press, settle

from engine3d import events
from engine3d.apps.editor.array_command import MOST_PLACES


@pytest.fixture
def cab(editor):
    cab = find(editor, "Cab")
    editor.workspace.document.selection.set([cab])
    press(editor, "D", control=True, shift=True)
    return cab


def cabs(editor):
    return [node for node in editor.workspace.scene.nodes if node.name.startswith("Cab")]


def test_counts_and_distances_are_typed(editor, cab):
    for text in ("3", "50", "2"):
        do(editor, events.TextEntered(text))
        press(editor, "Tab")
    do(editor, events.TextEntered("8"))
    press(editor, "Return")
    assert len(cabs(editor)) == 6
    offsets = {tuple(node.translation - cab.translation) for node in cabs(editor)}
    assert offsets == {(x, y, 0.0) for x in (0.0, 50.0, 100.0) for y in (0.0, 8.0)}
    press(editor, "Z", control=True)
    assert cabs(editor) == [cab] and not editor._told


def test_escape_and_too_many_change_nothing(editor, cab):
    do(editor, events.TextEntered(str(MOST_PLACES)))
    press(editor, "Tab")
    press(editor, "Tab")
    do(editor, events.TextEntered("2"))
    press(editor, "Return")
    assert cabs(editor) == [cab]
    press(editor, "Escape")
    press(editor, "Escape")
    settle(editor)
    press(editor, "Z", control=True)
    assert cabs(editor) == [cab] and not editor.workspace.document.is_modified

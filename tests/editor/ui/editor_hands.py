"""What acts on an editor's window as hands and eyes do: clicks, drags, keys, and looks for places.

Without imgui_bundle, the tests that import this are skipped.
"""

import numpy as np
import pytest

from engine3d import events

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

from engine3d.apps.editor.ui.editor_window import SETTLING

SIZE = (1000, 640)


def settle(editor):
    """Draw until nothing changes any more; return the picture."""
    for _ in range(SETTLING):
        editor._pictures_due = 1
        editor.turn(0.0)
    return editor._pixels.copy()


def do(editor, *happened):
    """Let things happen, each a picture after the last one."""
    for event in happened:
        editor._take(event)
        settle(editor)


def press(editor, key, *, control=False, shift=False):
    held = ["Left Ctrl"] * control + ["Left Shift"] * shift
    downs = [*(events.KeyDown(name, name, shift, control) for name in held)]
    ups = [events.KeyUp(name, name) for name in held]
    do(editor, *downs, events.KeyDown(key, key, shift, control), events.KeyUp(key, key), *ups)


def click(editor, x, y, *, shift=False):
    at = {"x": int(x), "y": int(y)}
    if shift:
        do(editor, events.KeyDown("Left Shift", "Left Shift", True))
    do(editor, events.MouseMotion(0, 0, **at))
    do(editor, *(events.MouseButton("left", down, shift, **at) for down in (True, False)))
    if shift:
        do(editor, events.KeyUp("Left Shift", "Left Shift"))


def drag(editor, button, *places):
    (x, y), *others = places
    do(editor, events.MouseMotion(0, 0, x, y), events.MouseButton(button, True, x=x, y=y))
    do(editor, *(events.MouseMotion(0, 0, *place) for place in others))
    x, y = places[-1]
    do(editor, events.MouseButton(button, False, x=x, y=y))


def scene_corner(editor):
    """Where the picture of the scene is in the window: it is there byte for byte."""
    shown, scene = editor._pixels, editor._scene._frame.color
    height, width = scene.shape[:2]
    first = scene[height // 2].view(np.uint32)[:, 0]
    for y in range(shown.shape[0] - height + 1):
        row = shown[y + height // 2].view(np.uint32)[:, 0]
        windows = np.lib.stride_tricks.sliding_window_view(row, width)
        for x in np.flatnonzero((windows[:, ::37] == first[::37]).all(axis=1)):
            if np.array_equal(shown[y : y + height, x : x + width], scene):
                return int(x), y
    raise AssertionError("the scene is not in the window")


def middle_of(editor, node):
    """A pixel of the window where a node shows, in the middle of what shows."""
    rows, columns = np.nonzero(editor._scene._frame.object_id == node.id)
    middle = np.argmin(np.hypot(rows - rows.mean(), columns - columns.mean()))
    x, y = scene_corner(editor)
    return x + int(columns[middle]), y + int(rows[middle])


def row_of(editor, node):
    """Where a node's row is: what changes on the left when it is selected."""
    selection = editor.workspace.document.selection
    selection.set()
    before = settle(editor)
    selection.set([node])
    changed = (settle(editor) != before).any(-1)
    changed[:, scene_corner(editor)[0] :] = False
    selection.set()
    settle(editor)
    rows, columns = np.nonzero(changed)
    assert len(rows)
    return columns.mean(), rows.mean()


def find(editor, name):
    return next(node for node in editor.workspace.scene.nodes if node.name == name)

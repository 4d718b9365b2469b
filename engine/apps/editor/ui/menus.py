"""The menu bar and keyboard shortcuts, both defined by the same entries.

In: the workspace. Out: the changed workspace. Shortcuts are those on which Blender and Unity agree.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from . import selection_actions as actions
from .files import Files
from .hierarchy_panel import HierarchyPanel, draw_add_menu
from .translated_imgui import imgui
from .workspace import PANELS, Workspace


class Entry(NamedTuple):
    """A line of a menu.

    Attributes
    ----------
    menu, label, keys : str
        ``keys`` as menus show them: "Ctrl+Shift+Z"; a letter alone counts where nobody types.
    act : callable
    """

    menu: str
    label: str
    keys: str
    act: Callable[[], object]


def entries(workspace: Workspace, files: Files, hierarchy: HierarchyPanel) -> list[Entry]:
    """Return all entries of all menus."""

    def rename():
        if workspace.document.selection.active is not None:
            hierarchy.rename(workspace.document.selection.active)

    def frame_selected():
        workspace.frame(workspace.document.selection.nodes)

    def choose(tool):
        return lambda: setattr(workspace.tools, "chosen", tool)

    return [
        Entry("File", "New", "Ctrl+N", files.new),
        Entry("File", "Open ...", "Ctrl+O", files.open),
        Entry("File", "Add a file ...", "Ctrl+I", files.add),
        Entry("File", "Save", "Ctrl+S", files.save),
        Entry("File", "Save as ...", "Ctrl+Shift+S", files.save_as),
        Entry("File", "Exit", "Ctrl+Q", files.exit),
        Entry("Edit", "Undo", "Ctrl+Z", workspace.undo),
        Entry("Edit", "Redo", "Ctrl+Shift+Z", workspace.redo),
        Entry("Edit", "Rename", "F2", rename),
        Entry("Edit", "Duplicate", "Ctrl+D", lambda: actions.duplicate(workspace)),
        Entry("Edit", "Group", "Ctrl+G", lambda: actions.group(workspace)),
        Entry("Edit", "Delete", "Delete", lambda: actions.delete(workspace)),
        Entry("Edit", "Put on the ground", "End", lambda: actions.put_on_ground(workspace)),
        Entry("Edit", "Hide or show", "H", lambda: actions.toggle_visible(workspace)),
        Entry("Edit", "Select all", "Ctrl+A", lambda: actions.select_all(workspace)),
        Entry("View", "Frame the selection", "F", frame_selected),
        Entry("View", "Frame all", "Home", lambda: workspace.frame(())),
        Entry("View", "Play or pause", "Space", workspace.play_or_pause),
        Entry("Tools", "Select", "Q", choose("select")),
        Entry("Tools", "Move", "W", choose("move")),
        Entry("Tools", "Turn", "E", choose("turn")),
        Entry("Tools", "Scale", "R", choose("scale")),
    ]


def draw_menus(workspace: Workspace, listed: list[Entry]) -> None:
    """Lay the menu bar out."""
    if not imgui.begin_main_menu_bar():
        return
    for menu in dict.fromkeys(entry.menu for entry in listed):
        if imgui.begin_menu(menu):
            for entry in listed:
                if entry.menu == menu and imgui.menu_item_simple(entry.label, entry.keys):
                    entry.act()
            imgui.end_menu()
    if imgui.begin_menu("Add"):
        draw_add_menu(workspace)
        imgui.end_menu()
    if imgui.begin_menu("Window"):
        _draw_window_menu(workspace)
        imgui.end_menu()
    imgui.end_main_menu_bar()


def _draw_window_menu(workspace: Workspace) -> None:
    """Lay out the menu of open panels."""
    for name in PANELS:
        changed, is_open = imgui.menu_item(name, "", name not in workspace.panels.closed)
        if changed:
            (workspace.panels.closed.discard if is_open else workspace.panels.closed.add)(name)
    imgui.separator()
    if imgui.menu_item_simple("Usual places"):
        workspace.panels.wants_usual_places = True


def press_keys(listed: list[Entry]) -> None:
    """Run the actions of pressed shortcuts, unless a text field is active."""
    io = imgui.get_io()
    popup = imgui.is_popup_open("", imgui.PopupFlags_.any_popup)
    if io.want_text_input or popup or imgui.is_mouse_down(1):
        return
    for entry in listed:
        # Space activates the item that keyboard navigation has chosen
        if entry.keys == "Space" and io.nav_visible:
            continue
        *modifiers, key = entry.keys.split("+")
        held = io.key_ctrl == ("Ctrl" in modifiers) and io.key_shift == ("Shift" in modifiers)
        if held and not io.key_alt and imgui.is_key_pressed(getattr(imgui.Key, key.lower()), False):
            entry.act()

"""The way of the keyboard from panel to panel.

In: which panel the keyboard is to go to. Out: ImGui's focus.
"""

from __future__ import annotations

from ..translated_imgui import imgui
from ..translated_imgui import label as labelled
from ..workspace import PANELS, Workspace

#: Panels whose arrows choose or move something, and do not go from field to field.
_OWN_ARROWS = ("Hierarchy", "Scene")
_TREE = "Hierarchy"


def focused_panel() -> str:
    """Return the name of the panel that has the keyboard; "" if none has."""
    window = imgui.get_current_context().nav_window
    root = None if window is None else window.root_window
    for name in PANELS:
        panel = imgui.internal.find_window_by_name(labelled(name))
        if root is not None and panel is not None and panel.id_ == root.id_:
            return name
    return ""


def to_panel(workspace: Workspace, step: int) -> None:
    """Let the keyboard go on to the next open panel; to the one before for -1."""
    names = [name for name in PANELS if name not in workspace.panels.closed]
    if not names:
        return
    now = focused_panel()
    place = names.index(now) + step if now in names else min(step, 0)
    workspace.go_to(names[place % len(names)])


def restore_cursor(workspace: Workspace) -> None:
    """Show ImGui's cursor, or hide it, as it was before a dialog: it takes arrows and Space."""
    panels = workspace.panels
    opened = imgui.is_popup_open("", imgui.PopupFlags_.any_popup)
    has_dialog = opened or panels.shows_keys or panels.offers_start
    if panels.has_dialog and not has_dialog:
        imgui.set_nav_cursor_visible(panels.shows_cursor)
    elif not has_dialog:
        panels.shows_cursor = imgui.get_io().nav_visible
    panels.has_dialog = has_dialog


def focus_panel(workspace: Workspace) -> None:
    """Give the keyboard to the panel that it is to go to, before panels are laid out."""
    name = workspace.panels.goes_to
    panel = imgui.internal.find_window_by_name(labelled(name)) if name else None
    if panel is None:
        return  # it is laid out for the first time now
    workspace.panels.goes_to = ""
    imgui.internal.focus_window(panel)
    workspace.panels.goes_to_rows = name == _TREE and not workspace.panels.goes_to_search
    if name not in _OWN_ARROWS:
        imgui.internal.nav_init_window(panel, False)
    imgui.set_nav_cursor_visible(name not in _OWN_ARROWS)

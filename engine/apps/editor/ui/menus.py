"""The menu bar and keyboard shortcuts, both defined by the same entries.

In: the workspace. Out: the changed workspace. Shortcuts are those on which Blender and Unity agree.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from functools import cache, partial
from typing import NamedTuple

from ....errors import printable
from . import clipboard_actions as clipboard
from . import selection_actions as actions
from .array_dialog import ArrayDialog
from .files import Files
from .hierarchy_panel import HierarchyPanel, draw_add_menu
from .keyboard.command_search import CommandSearch
from .keyboard.owned_keys import own
from .keyboard.panel_focus import to_panel
from .keyboard.parent_choice import ParentChoice, put_below
from .materials.material_actions import add_to_selected
from .motion import motion_actions as motion
from .render_dialog import RenderDialog
from .translated_imgui import imgui
from .translated_imgui import label as labelled
from .view.standard_views import STANDARD_VIEWS
from .workspace import PANELS, Workspace

#: The entry below which recent files are.
OPEN = "Open ..."
_WINDOW = "Window"
#: Keys of entries that would also lead ImGui's cursor to the first or last item of a panel, which
#: Space then presses.
_OWNED = ("home", "end")
#: Keys that count also while somebody types: they lead away from the text.
_LEADING_AWAY = ("F1", "F3", "F6", "Shift+F6", "F10")
#: Keys that are in several places, or called otherwise.
_PLACES = {"+": ("equal", "keypad_add"), "-": ("minus", "keypad_subtract")}
#: By how much a key turns the view, in radians, and how many steps of the wheel it approaches.
_TURN, _NEARER = math.radians(15.0), 2.0
_ASIDE = 0.1  # of the picture's height, by which a key moves the view


class Entry(NamedTuple):
    """A line of a menu.

    Attributes
    ----------
    menu, label, keys : str
        ``keys`` as menus show them: "Ctrl+Shift+Z"; a letter alone counts where nobody types.
    act : callable
    is_enabled : callable
        Whether there is something to do.
    says : callable, optional
        The label as it is shown now.
    is_on : callable
        Whether a mark shows before the label: of what is switched on and off.
    """

    menu: str
    label: str
    keys: str
    act: Callable[[], object]
    is_enabled: Callable[[], bool] = lambda: True
    says: Callable[[], str] | None = None
    is_on: Callable[[], bool] = lambda: False


def entries(
    workspace: Workspace,
    files: Files,
    hierarchy: HierarchyPanel,
    rendering: RenderDialog,
    arrays: ArrayDialog,
    parents: ParentChoice,
    commands: CommandSearch,
) -> list[Entry]:
    """Return all entries of all menus."""

    def rename():
        if workspace.document.selection.active is not None:
            hierarchy.rename(workspace.document.selection.active)

    def frame_selected():
        workspace.frame(workspace.document.selection.nodes)

    def show_keys():
        workspace.panels.shows_keys = not workspace.panels.shows_keys
        workspace.hold_keys()

    def switch_culling():
        workspace.display.culls = not workspace.display.culls

    def switch_culling_of_hidden():
        workspace.display.culls_hidden = not workspace.display.culls_hidden

    def go_to_menus():
        workspace.panels.goes_to_menus = True

    def is_any_selected():
        return bool(workspace.document.selection.nodes)

    def of_selection(label, keys, act):
        return Entry("Edit", label, keys, lambda: act(workspace), is_any_selected)

    def choose(tool):
        def take():
            workspace.tools.chosen = tool
            workspace.go_to("Scene")  # whose arrow keys the tool has

        return take

    def search():
        workspace.panels.goes_to_search = True
        workspace.go_to("Hierarchy")

    return [
        Entry("File", "New", "Ctrl+N", files.new),
        Entry("File", OPEN, "Ctrl+O", files.open),
        Entry("File", "Add a file ...", "Ctrl+I", files.add),
        Entry("File", "Save", "Ctrl+S", files.save),
        Entry("File", "Save as ...", "Ctrl+Shift+S", files.save_as),
        Entry("File", "Export as glTF ...", "Ctrl+E", files.export),
        Entry("File", "Render ...", "F12", rendering.open),
        Entry("File", "Exit", "Ctrl+Q", files.exit),
        *_history_entries(workspace),
        Entry("Edit", "Cut", "Ctrl+X", lambda: clipboard.cut(workspace), is_any_selected),
        Entry("Edit", "Copy", "Ctrl+C", lambda: clipboard.copy(workspace), is_any_selected),
        Entry("Edit", "Paste", "Ctrl+V", lambda: clipboard.paste(workspace)),
        of_selection("Paste below", "Ctrl+Shift+V", clipboard.paste_below),
        Entry("Edit", "Rename", "F2", rename, is_any_selected),
        of_selection("Duplicate", "Ctrl+D", actions.duplicate),
        Entry("Edit", "Array ...", "Ctrl+Shift+D", arrays.open, is_any_selected),
        of_selection("Group", "Ctrl+G", actions.group),
        Entry("Edit", "Parent to ...", "Ctrl+P", parents.open, is_any_selected),
        Entry(
            "Edit",
            "To the top of the tree",
            "Ctrl+Shift+P",
            lambda: put_below(workspace, None),
            is_any_selected,
        ),
        of_selection("Delete", "Delete", actions.delete),
        of_selection("Put on the ground", "End", actions.put_on_ground),
        of_selection("Hide or show", "H", actions.toggle_visible),
        Entry("Edit", "Select all", "Ctrl+A", lambda: actions.select_all(workspace)),
        Entry("Edit", "Search the tree", "Ctrl+F", search),
        Entry("View", "Frame the selection", "F", frame_selected, is_any_selected),
        Entry("View", "Frame all", "Home", lambda: workspace.frame(())),
        *(
            Entry("View", name, key, partial(workspace.look_from, name))
            for name, (_, _, key) in STANDARD_VIEWS.items()
        ),
        *_turning_entries(workspace),
        Entry("View", "Orthographic or perspective", "5", workspace.toggle_orthographic),
        Entry("View", "Look through a camera", "0", workspace.look_through),
        Entry("View", "Frustum culling", "", switch_culling, is_on=lambda: workspace.display.culls),
        Entry(
            "View",
            "Occlusion culling",
            "",
            switch_culling_of_hidden,
            lambda: workspace.display.culls,
            is_on=lambda: workspace.display.culling == "all",
        ),
        Entry("View", "Play or pause", "Space", workspace.play_or_pause),
        Entry("Edit", "New material", "Ctrl+M", lambda: add_to_selected(workspace)),
        Entry("Tools", "Select", "Q", choose("select")),
        Entry("Tools", "Move", "W", choose("move")),
        Entry("Tools", "Rotate", "E", choose("rotate")),
        Entry("Tools", "Scale", "R", choose("scale")),
        *_motion_entries(workspace, is_any_selected),
        Entry(_WINDOW, "To the next panel", "F6", lambda: to_panel(workspace, 1)),
        Entry(_WINDOW, "To the panel before", "Shift+F6", lambda: to_panel(workspace, -1)),
        Entry("Help", "Keys and mouse", "F1", show_keys),
        Entry("Help", "Find a command ...", "F3", commands.open),
        Entry("Help", "Go to the menus", "F10", go_to_menus),
    ]


def _history_entries(workspace: Workspace) -> list[Entry]:
    """Return the entries that undo and redo, which say what."""

    def is_any(which: str):
        return lambda: getattr(workspace.document.history, which) is not None

    def says(which: str):
        return lambda: getattr(workspace.document, which)

    return [
        Entry("Edit", "Undo", "Ctrl+Z", workspace.undo, is_any("last"), says("undo_label")),
        Entry("Edit", "Redo", "Ctrl+Shift+Z", workspace.redo, is_any("next"), says("redo_label")),
    ]


def _turning_entries(workspace: Workspace) -> list[Entry]:
    """Return the entries that turn and move the view, and bring it nearer."""

    def turn(azimuth: float, elevation: float):
        return lambda: workspace.turn(azimuth * _TURN, elevation * _TURN)

    def move(right: float, up: float):
        return lambda: workspace.move_view(right, up)

    return [
        Entry("View", "Turn to the left", "4", turn(-1.0, 0.0)),
        Entry("View", "Turn to the right", "6", turn(1.0, 0.0)),
        Entry("View", "Turn up", "8", turn(0.0, 1.0)),
        Entry("View", "Turn down", "2", turn(0.0, -1.0)),
        Entry("View", "Move to the left", "Ctrl+4", move(-_ASIDE, 0.0)),
        Entry("View", "Move to the right", "Ctrl+6", move(_ASIDE, 0.0)),
        Entry("View", "Move up", "Ctrl+8", move(0.0, _ASIDE)),
        Entry("View", "Move down", "Ctrl+2", move(0.0, -_ASIDE)),
        Entry("View", "Nearer", "+", lambda: workspace.approach(_NEARER)),
        Entry("View", "Farther", "-", lambda: workspace.approach(-_NEARER)),
    ]


def _motion_entries(workspace: Workspace, is_any_selected: Callable[[], bool]) -> list[Entry]:
    """Return the entries of what moves."""

    def moves():
        return workspace.document.moves

    def to_key(step):
        return lambda: motion.go_to_key(workspace, step)

    def key(label, keys, act):
        return Entry("Motion", label, keys, lambda: act(workspace), is_any_selected)

    return [
        key("Spin", "", motion.spin),
        key("Orbit", "", motion.orbit),
        key("Path", "", motion.path),
        key("Set a key", "K", motion.set_key),
        key("Delete the key", "Shift+K", motion.delete_key),
        Entry("Motion", "To the key before", "J", to_key(-1), moves),
        Entry("Motion", "To the next key", "L", to_key(1), moves),
        Entry("Motion", "To time 0", "Shift+Home", workspace.rewind, moves),
    ]


def draw_menus(workspace: Workspace, listed: list[Entry], files: Files) -> None:
    """Lay the menu bar out."""
    if not imgui.begin_main_menu_bar():
        return
    menus = list(dict.fromkeys(entry.menu for entry in listed))
    if workspace.panels.goes_to_menus:
        bar = imgui.internal.get_current_window()
        imgui.internal.focus_window(bar)
        # Without this, arrows would go on from the menu that was open last.
        layer, first = imgui.internal.NavLayer.menu, imgui.get_id(labelled(menus[0]))
        imgui.internal.set_nav_id(first, layer, 0, imgui.internal.ImRect())
        imgui.open_popup(menus[0])
        workspace.panels.goes_to_menus = False
    for menu in menus:
        if menu == _WINDOW and imgui.begin_menu("Add"):
            draw_add_menu(workspace)
            imgui.end_menu()
        _draw_menu(menu, listed, workspace, files)
    imgui.end_main_menu_bar()


def _draw_menu(menu: str, listed: list[Entry], workspace: Workspace, files: Files) -> None:
    if not imgui.begin_menu(menu):
        return
    for entry in listed:
        if entry.menu != menu:
            continue
        if _draw_entry(entry):
            entry.act()
        if entry.label == OPEN:
            _draw_recent(workspace, files)
    if menu == _WINDOW:
        _draw_panels(workspace)
    imgui.end_menu()


def _draw_recent(workspace: Workspace, files: Files) -> None:
    """Lay out the menu of files that were opened lately."""
    if not imgui.begin_menu("Open recent"):
        return
    paths = workspace.recent.paths()
    if not paths:
        imgui.text_disabled("none yet")
    for path in paths:
        if imgui.menu_item_simple(f"{printable(os.path.basename(path))}###{path}"):
            files.open_recent(path)
        imgui.set_item_tooltip(printable(path))
    imgui.separator()
    if imgui.menu_item_simple("Forget them", None, False, bool(paths)):
        workspace.recent.clear()
    imgui.end_menu()


def _draw_entry(entry: Entry) -> bool:
    """Lay out a line of a menu; return whether it was chosen."""
    label = entry.label if entry.says is None else f"{entry.says()}###{entry.label}"
    return imgui.menu_item_simple(label, entry.keys, entry.is_on(), entry.is_enabled())


def _draw_panels(workspace: Workspace) -> None:
    """Lay out which panels are open."""
    imgui.separator()
    for name in PANELS:
        changed, is_open = imgui.menu_item(name, "", name not in workspace.panels.closed)
        if changed:
            (workspace.panels.closed.discard if is_open else workspace.panels.closed.add)(name)
    imgui.separator()
    if imgui.menu_item_simple("Reset the layout"):
        workspace.panels.wants_usual_places = True


def press_keys(listed: list[Entry]) -> None:
    """Run the actions of pressed shortcuts, unless a text field is active."""
    io = imgui.get_io()
    popup = imgui.is_popup_open("", imgui.PopupFlags_.any_popup)
    if popup or imgui.is_mouse_down(1):
        return
    if not io.want_text_input:
        own("menus", _OWNED)
    for entry in listed:
        if not entry.keys or (io.want_text_input and entry.keys not in _LEADING_AWAY):
            continue
        # Space activates the item that keyboard navigation has chosen
        if entry.keys == "Space" and io.nav_visible:
            continue
        control, shift, keys = _chord(entry.keys)
        held = io.key_ctrl == control and shift in (None, io.key_shift) and not io.key_alt
        if held and any(imgui.is_key_pressed(key, False) for key in keys) and entry.is_enabled():
            entry.act()


@cache
def _chord(keys: str) -> tuple[bool, bool | None, tuple[imgui.Key, ...]]:
    """Return whether Ctrl and Shift are held, and the keys; a digit's is on the keypad, too.

    Shift may be held or not, None, for a plus: many keyboards type it with Shift.
    """
    *modifiers, key = keys[:-1].split("+")  # the last one may be the plus itself
    key += keys[-1]
    names = _PLACES.get(key) or (key.lower(),)
    if key.isdigit():
        names = f"_{key}", f"keypad{key}"
    shift = None if key == "+" else "Shift" in modifiers
    return "Ctrl" in modifiers, shift, tuple(getattr(imgui.Key, name) for name in names)

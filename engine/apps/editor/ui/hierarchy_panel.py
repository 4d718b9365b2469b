"""The panel of the node tree: selection, renaming, dragging, visibility, search.

In: the workspace. Out: commands. Only visible rows are laid out.
"""

from __future__ import annotations

from ....base.language import translated, translated_count
from ....model.scene.nodes import Node
from ..hierarchy import Row
from ..new_things.adding import GROUPS
from ..node_commands import Reparent
from ..value_commands import SetValues
from . import clipboard_actions
from .keyboard.owned_keys import ENTER, own, pressed
from .keyboard.parent_choice import ParentChoice
from .keyboard.row_in_view import scroll_to_row
from .keyboard.tree_cursor import TreeCursor
from .materials import material_actions
from .panel_layout import begin_panel
from .selection_actions import add, delete, duplicate, group
from .translated_imgui import imgui
from .workspace import Workspace

_PAYLOAD = "node"
#: Keys that lead from the search to what it found.
_TO_ROWS = ("down_arrow", *ENTER)


class HierarchyPanel:
    """Shows the tree.

    Parameters
    ----------
    workspace : Workspace
    parents : ParentChoice
        Asks for another parent.
    """

    def __init__(self, workspace: Workspace, parents: ParentChoice) -> None:
        self._workspace = workspace
        self._parents = parents
        self._cursor = TreeCursor(workspace)
        self._renamed: Node | None = None
        self._name = ""
        self._focuses = False
        self._seen = -1

    def rename(self, node: Node) -> None:
        """Start editing a node's name."""
        self._renamed, self._name, self._focuses = node, node.name, True
        self._workspace.hold_keys()
        self._workspace.panels.closed.discard("Hierarchy")
        self._workspace.hierarchy.reveal(node)

    def draw(self) -> None:
        """Lay the panel out."""
        shown = begin_panel("Hierarchy")
        if shown:
            self._draw_head()
            panels = self._workspace.panels
            if panels.goes_to_rows:
                panels.goes_to_rows = False
                imgui.internal.clear_active_id()  # of the search, which would keep the keyboard
                imgui.set_next_window_focus()
            if imgui.begin_child("rows"):
                self._draw_rows()
            imgui.end_child()
            self._accept_drop(None)
        imgui.end()

    def _draw_head(self) -> None:
        hierarchy = self._workspace.hierarchy
        if imgui.button("Add"):
            imgui.open_popup("add")
        imgui.same_line()
        imgui.set_next_item_width(-1.0)
        panels = self._workspace.panels
        if panels.goes_to_search:
            panels.goes_to_search = False
            imgui.set_keyboard_focus_here()
        _, hierarchy.search = imgui.input_text_with_hint("##search", "Search", hierarchy.search)
        if imgui.is_item_focused():
            own("search", _TO_ROWS)
            if any(pressed(key, again=False) for key in _TO_ROWS):
                panels.goes_to_rows = True
                self._select_found()
        if imgui.begin_popup("add"):
            draw_add_menu(self._workspace)
            imgui.end_popup()

    def _select_found(self) -> None:
        """Select the first node that the search found."""
        found = (row.node for row in self._workspace.hierarchy.rows() if row.is_match)
        node = next(found, None)
        if node is not None:
            self._workspace.document.selection.set([node])

    def _draw_rows(self) -> None:
        rows = self._workspace.hierarchy.rows()
        self._cursor.press_keys(rows)
        rows = self._workspace.hierarchy.rows()  # keys open and close nodes
        self._scroll_to_selected(rows)
        clipper = imgui.ListClipper()
        clipper.begin(len(rows), imgui.get_text_line_height_with_spacing())
        while clipper.step():
            for number in range(clipper.display_start, clipper.display_end):
                self._draw_row(rows[number], rows)
        if (
            imgui.is_window_hovered()
            and imgui.is_mouse_clicked(0)
            and not imgui.is_any_item_hovered()
        ):
            self._workspace.document.selection.set()
        if imgui.begin_popup_context_window("menu", imgui.PopupFlags_.no_open_over_items):
            draw_add_menu(self._workspace)
            imgui.end_popup()

    def _scroll_to_selected(self, rows) -> None:
        """Scroll to a node that was selected elsewhere."""
        selection = self._workspace.document.selection
        if selection.version == self._seen:
            return
        self._seen = selection.version
        place = None if selection.active is None else rows.place(selection.active)
        if place is not None:
            scroll_to_row(place)

    def _draw_row(self, row: Row, rows) -> None:
        node = row.node
        imgui.push_id(node.id)
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + row.depth * imgui.get_font_size())
        self._draw_arrow(row)
        imgui.same_line()
        if node is self._renamed:
            self._draw_renaming()
        else:
            self._draw_name(row, rows)
            self._draw_eye(node)
        imgui.pop_id()

    def _draw_arrow(self, row: Row) -> None:
        side = imgui.get_text_line_height()
        corner = imgui.get_cursor_screen_pos()
        if imgui.invisible_button("open", (side, side)) and row.has_children:
            below = imgui.get_io().key_shift
            self._workspace.hierarchy.set_open(row.node, not row.is_open, below=below)
        if row.has_children:
            x, y, part = corner.x + side / 2, corner.y + side / 2, side / 4
            points = [(-part, -part), (part, 0.0), (-part, part)]
            if row.is_open:
                points = [(-part, -part), (part, -part), (0.0, part)]
            color = imgui.get_color_u32(imgui.Col_.text)
            corners = [(x + dx, y + dy) for dx, dy in points]
            imgui.get_window_draw_list().add_triangle_filled(*corners, color)

    def _draw_name(self, row: Row, rows) -> None:
        node, selection = row.node, self._workspace.document.selection
        faded = not node.shown
        if faded:
            imgui.push_style_color(
                imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled)
            )
        width = imgui.get_content_region_avail().x - 2 * imgui.get_font_size()
        flags = imgui.SelectableFlags_.allow_double_click
        label = f"{node.name or translated('node {number}', number=node.id)}###name"
        clicked, _ = imgui.selectable(label, node in selection, flags, (max(width, 1.0), 0.0))
        if faded:
            imgui.pop_style_color()
        if clicked and imgui.is_mouse_double_clicked(0):
            self._workspace.frame((node,))
        elif clicked:
            self._cursor.click(node, rows)
            self._seen = selection.version
        if imgui.begin_popup_context_item("node"):
            if node not in selection:
                selection.set([node])
            self._draw_node_menu(node)
            imgui.end_popup()
        self._drag_and_drop(node)

    def _draw_eye(self, node: Node) -> None:
        imgui.same_line()
        imgui.push_style_var(imgui.StyleVar_.frame_padding, (0.0, 0.0))
        changed, visible = imgui.checkbox("##visible", node.visible)
        imgui.pop_style_var()
        imgui.set_item_tooltip("visible")
        if changed:
            selection = self._workspace.document.selection
            nodes = selection.nodes if node in selection else (node,)
            self._workspace.do(SetValues(nodes, {"visible": visible}))

    def _draw_renaming(self) -> None:
        if self._focuses:
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(-1.0)
        flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
        entered, self._name = imgui.input_text("##rename", self._name, flags)
        node = self._renamed
        if entered or (imgui.is_item_deactivated() and not self._focuses):
            self._renamed = None
            if not imgui.is_key_pressed(imgui.Key.escape) and self._name != node.name:
                self._workspace.do(SetValues([node], {"name": self._name}, translated("Rename")))
        self._focuses = False

    def _draw_node_menu(self, node: Node) -> None:
        workspace = self._workspace
        if imgui.menu_item_simple("Rename", "F2"):
            self.rename(node)
        if imgui.menu_item_simple("Cut", "Ctrl+X"):
            clipboard_actions.cut(workspace)
        if imgui.menu_item_simple("Copy", "Ctrl+C"):
            clipboard_actions.copy(workspace)
        if imgui.menu_item_simple("Paste", "Ctrl+V"):
            clipboard_actions.paste(workspace)
        if imgui.menu_item_simple("Paste below", "Ctrl+Shift+V"):
            clipboard_actions.paste_below(workspace)
        if imgui.menu_item_simple("Duplicate", "Ctrl+D"):
            duplicate(workspace)
        if imgui.menu_item_simple("Group", "Ctrl+G"):
            group(workspace)
        if imgui.menu_item_simple("Parent to ...", "Ctrl+P"):
            self._parents.open()
        if imgui.menu_item_simple("Delete", "Del"):
            delete(workspace)
        imgui.separator()
        if imgui.begin_menu("Add below"):
            draw_add_menu(workspace, node)
            imgui.end_menu()

    def _drag_and_drop(self, node: Node) -> None:
        if imgui.begin_drag_drop_source():
            imgui.set_drag_drop_payload_py_id(_PAYLOAD, node.id)
            selection = self._workspace.document.selection
            count = len(selection) if node in selection else 1
            imgui.text(
                node.name
                if count == 1
                else translated_count("{count:,} node", "{count:,} nodes", count)
            )
            imgui.end_drag_drop_source()
        self._accept_drop(node)

    def _accept_drop(self, parent: Node | None) -> None:
        if not imgui.begin_drag_drop_target():
            return
        material_actions.accept(self._workspace, parent)
        payload = imgui.accept_drag_drop_payload_py_id(_PAYLOAD)
        if payload is not None:
            scene, selection = self._workspace.scene, self._workspace.document.selection
            node = scene.data.node_of(payload.data_id)
            if node is not None and node is not parent:
                nodes = selection.topmost() if node in selection else (node,)
                self._workspace.do(Reparent(scene, nodes, parent))
                if parent is not None:
                    self._workspace.hierarchy.set_open(parent, True)
        imgui.end_drag_drop_target()


def draw_add_menu(workspace: Workspace, parent: Node | None = None) -> None:
    """Lay out the menu of things to add, below a node or at the top."""
    for number, titles in enumerate(GROUPS):
        if number:
            imgui.separator()
        for name in titles:
            if imgui.menu_item_simple(name):
                add(workspace, name, parent)

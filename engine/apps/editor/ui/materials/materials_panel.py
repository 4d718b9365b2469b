"""The panel of materials: a list with pictures, and the values of the chosen one.

In: the workspace's resources. Out: commands. Materials are dragged from here onto nodes of the view
and of the tree.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from .....base.language import translated_count
from .....model.materials.material import Material
from ....imgui_painter.imgui_painter import ImguiPainter
from ...resource_list import Entry
from ..panel_layout import begin_panel
from ..properties.fields import Fields
from ..shown_thumbnails import ShownThumbnails
from ..style import scaled
from ..translated_imgui import imgui
from ..workspace import Workspace
from . import material_actions as actions

#: Side of a thumbnail at scale 1.
PICTURE = 64
#: Seconds for thumbnails per frame; the rest follow in later frames.
PATIENCE = 0.02


class MaterialsPanel:
    """Lists the materials.

    Parameters
    ----------
    workspace : Workspace
    painter : ImguiPainter
        Shows their pictures.
    draw_values : callable
        Lays out the fields of a material.

    Attributes
    ----------
    is_waiting : bool
        Whether pictures are missing: the next frame is another one.
    """

    def __init__(
        self,
        workspace: Workspace,
        painter: ImguiPainter,
        draw_values: Callable[[Material], object],
    ) -> None:
        self._workspace = workspace
        self._thumbnails = ShownThumbnails(painter, round(scaled(PICTURE)))
        self._draw_values = draw_values
        self._fields = Fields(workspace)
        self._chosen: Material | None = None
        self._deadline = 0.0
        self.is_waiting = False

    def draw(self) -> None:
        """Lay the panel out."""
        self.is_waiting = False
        self._deadline = time.perf_counter() + PATIENCE
        if begin_panel("Materials"):
            found = self._workspace.resources.entries()
            entries = [entry for entry in found if entry.kind == "material"]
            self._thumbnails.forget_unused(len(entries))
            things = [entry.thing for entry in entries]
            if self._chosen not in things:
                self._chosen = None
            self._draw_buttons()
            wide = imgui.get_content_region_avail().x
            width = 0.5 * wide if self._chosen is not None else 0.0
            if imgui.begin_child("list", (width, 0.0)):
                self._draw_list(entries)
            imgui.end_child()
            if self._chosen is not None:
                imgui.same_line()
                if imgui.begin_child("values", (0.0, 0.0), imgui.ChildFlags_.borders):
                    self._draw_chosen(self._chosen)
                imgui.end_child()
        imgui.end()

    def _draw_buttons(self) -> None:
        workspace, chosen = self._workspace, self._chosen
        if imgui.button("New"):
            self._chosen = actions.add(workspace)
        imgui.set_item_tooltip("Ctrl+M makes one and gives it to the selected nodes")
        imgui.begin_disabled(chosen is None)
        imgui.same_line()
        if imgui.button("Duplicate") and chosen is not None:
            self._chosen = actions.add(workspace, chosen)
        imgui.same_line()
        if imgui.button("Give to the selected") and chosen is not None:
            actions.give(workspace, chosen, workspace.document.selection.nodes)
        imgui.same_line()
        if imgui.button("Delete") and chosen is not None:
            actions.discard(workspace, chosen)
        imgui.set_item_tooltip("only a material that nobody uses")
        imgui.end_disabled()

    def _draw_list(self, entries: list[Entry]) -> None:
        """Lay out the pictures in rows, of which only visible ones are drawn."""
        style, side = imgui.get_style(), scaled(PICTURE)
        cell = side + 2.0 * style.frame_padding.x + style.item_spacing.x
        across = max(int(imgui.get_content_region_avail().x / cell), 1)
        height = side + imgui.get_text_line_height_with_spacing() + 2 * style.frame_padding.y
        clipper = imgui.ListClipper()
        clipper.begin(-(-len(entries) // across), height + style.item_spacing.y)
        while clipper.step():
            for row in range(clipper.display_start, clipper.display_end):
                for place, entry in enumerate(entries[row * across : (row + 1) * across]):
                    imgui.push_id(str(id(entry.thing)))
                    self._draw_cell(entry, place * cell, height)
                    imgui.pop_id()

    def _draw_cell(self, entry: Entry, offset: float, height: float) -> None:
        material, side = entry.thing, scaled(PICTURE)
        if offset:
            imgui.same_line(offset)
        imgui.begin_group()
        place = imgui.get_cursor_screen_pos()
        chosen = material is self._chosen
        if imgui.selectable("##chosen", chosen, 0, (side, height))[0]:
            self._chosen = material
        actions.drag(material)
        users = translated_count("{count:,} user", "{count:,} users", entry.users)
        imgui.set_item_tooltip(f"{entry.name}\n{users}")
        lines = imgui.get_window_draw_list()
        number, waits = self._thumbnails.number(material, self._deadline)
        self.is_waiting |= waits
        if number:
            high = place.x + side, place.y + side
            lines.add_image(imgui.ImTextureRef(number), (place.x, place.y), high)
        lines.push_clip_rect((place.x, place.y), (place.x + side, place.y + height), True)
        text = imgui.get_color_u32(imgui.Col_.text if material.name else imgui.Col_.text_disabled)
        lines.add_text((place.x, place.y + side), text, entry.name)
        lines.pop_clip_rect()
        imgui.end_group()

    def _draw_chosen(self, material: Material) -> None:
        workspace = self._workspace
        imgui.push_id(str(id(material)))
        fields = self._fields
        fields.label("Name")
        name = fields.text(material.name)
        if name is not None:
            actions.rename(workspace, material, name)
        for kind in actions.KINDS:
            is_physical = kind == "physical"
            if imgui.radio_button(kind.capitalize(), material.is_physical == is_physical):
                actions.set_physical(workspace, [material], is_physical)
            imgui.same_line()
        users = workspace.resources.users(material)
        imgui.begin_disabled(not users)
        select = translated_count("Select {count:,} user", "Select {count:,} users", len(users))
        if imgui.small_button(f"{select}###users"):
            workspace.document.selection.set(users)
        imgui.end_disabled()
        self._draw_values(material)
        imgui.pop_id()

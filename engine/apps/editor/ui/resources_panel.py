"""The panel of the scene's resources: meshes, materials and textures, with thumbnails and users.

In: the workspace's resources. Out: rows, of which only visible ones are laid out; a click selects
the users.
"""

from __future__ import annotations

import time

from ....base.language import translated, translated_choice, translated_number
from ....model.materials.material import Material
from ...imgui_painter.imgui_painter import ImguiPainter
from ..resource_list import Entry
from .materials import material_actions
from .panel_layout import begin_panel
from .shown_thumbnails import ShownThumbnails
from .style import scaled
from .translated_imgui import imgui
from .workspace import Workspace

#: Side of a thumbnail at scale 1.
PICTURE = 48
#: Seconds for thumbnails per frame; the rest follow in later frames.
PATIENCE = 0.02


class ResourcesPanel:
    """Lists the resources.

    Parameters
    ----------
    workspace : Workspace
    painter : ImguiPainter
        Shows their pictures.
    """

    def __init__(self, workspace: Workspace, painter: ImguiPainter) -> None:
        self._workspace = workspace
        self._thumbnails = ShownThumbnails(painter, round(scaled(PICTURE)))
        self._deadline = 0.0
        self.is_waiting = False

    def draw(self) -> None:
        """Lay the panel out."""
        self.is_waiting = False
        self._deadline = time.perf_counter() + PATIENCE
        shown = begin_panel("Resources")
        if shown:
            entries = self._workspace.resources.entries()
            self._thumbnails.forget_unused(len(entries))
            self._draw_table(entries)
        imgui.end()

    def _draw_table(self, entries: tuple[Entry, ...]) -> None:
        flags = imgui.TableFlags_
        chosen = flags.row_bg | flags.resizable | flags.scroll_y | flags.borders_inner_v
        if not imgui.begin_table("resources", 5, chosen):
            return
        for title in ("Name", "Kind", "Size", "File", "Users"):
            imgui.table_setup_column(title)
        imgui.table_setup_scroll_freeze(0, 1)
        imgui.table_headers_row()
        clipper = imgui.ListClipper()
        clipper.begin(len(entries), scaled(PICTURE) + 2 * imgui.get_style().cell_padding.y)
        while clipper.step():
            for number in range(clipper.display_start, clipper.display_end):
                self._draw_row(number, entries[number])
        imgui.end_table()

    def _draw_row(self, number: int, entry: Entry) -> None:
        side = scaled(PICTURE)
        imgui.table_next_row(0, side)
        imgui.table_next_column()
        picture, waits = self._thumbnails.number(entry.thing, self._deadline)
        self.is_waiting |= waits
        if picture:
            imgui.image(imgui.ImTextureRef(picture), (side, side))
            imgui.same_line()
        flags = imgui.SelectableFlags_.span_all_columns
        if imgui.selectable(f"{entry.name}##{number}", False, flags, (0.0, side))[0]:
            users = self._workspace.resources.users(entry.thing)
            self._workspace.document.selection.set(users)
        if isinstance(entry.thing, Material):
            material_actions.drag(entry.thing)
        size = translated("{size:,} bytes", size=entry.size) if entry.size else ""
        for text in (
            translated_choice("resource", entry.kind),
            size,
            entry.path or "",
            translated_number(entry.users, ","),
        ):
            imgui.table_next_column()
            imgui.text_unformatted(text)

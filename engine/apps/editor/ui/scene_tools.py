"""The toolbar above the scene: tools, snapping steps, display modes, time.

In: the workspace. Out: the changed workspace. Items that do not fit wrap to another row.
"""

from __future__ import annotations

from typing import get_args

from ....base.language import translated, translated_choice, translated_keys
from ....choices import LookName, Mode
from .overlays import Overlays
from .properties.fields import label_before
from .style import scaled
from .translated_imgui import imgui
from .view.standard_views import STANDARD_VIEWS
from .workspace import Workspace

MODES = get_args(Mode)
LOOKS: tuple[LookName | None, ...] = (None, *get_args(LookName))
TOOLS = {"select": "Q", "move": "W", "rotate": "E", "scale": "R"}
#: The label of each tool's step with its unit, and its drag speed.
_STEPS = {
    "move": ("Move, units", 0.01),
    "rotate": ("Rotate, degrees", 0.5),
    "scale": ("Scale, per cent", 0.5),
}
_LEAST, _MOST = 1e-4, 1e6
_LABELS = 9.0  # letters that they take


def draw_tools(workspace: Workspace, overlays: Overlays) -> None:
    """Lay the row out."""
    _begin_row()
    for name, key in TOOLS.items():
        label = f"{translated(name.capitalize())} ({key})###{name}"
        _beside(label, boxes=1)
        if imgui.radio_button(label, workspace.tools.chosen == name):
            workspace.tools.chosen = name
    _beside("Local", boxes=1)
    _, workspace.tools.is_local = imgui.checkbox("Local", workspace.tools.is_local)
    _beside("Snap", boxes=1)
    _, workspace.tools.snaps = imgui.checkbox("Snap", workspace.tools.snaps)
    _beside("Steps")
    _draw_steps(workspace)
    _draw_time(workspace)
    _draw_looks(workspace)
    imgui.begin_disabled(workspace.display.as_rendered)
    _draw_modes(workspace)
    imgui.end_disabled()
    _beside("View")
    _draw_views(workspace)
    _beside("Show")
    overlays.draw_menu()


def _draw_views(workspace: Workspace) -> None:
    """Lay out the views along the axes, and those through cameras."""
    if imgui.button("View"):
        imgui.open_popup("view")
    if not imgui.begin_popup("view"):
        return
    for name, (_, _, key) in STANDARD_VIEWS.items():
        if imgui.menu_item_simple(name, key):
            workspace.look_from(name)
    imgui.separator()
    if imgui.menu_item_simple("Orthographic", "5", workspace.view.orthographic):
        workspace.toggle_orthographic()
    cameras = list(workspace.scene.data.cameras.values())
    if cameras:
        imgui.separator_text("Through a camera")
    for node in cameras:
        name = f"{node.name or translated('camera')}##{node.id}"
        if imgui.menu_item_simple(name, None, workspace.through.node is node):
            workspace.through.look(node, workspace.bounds)
    imgui.end_popup()


def _draw_looks(workspace: Workspace) -> None:
    """Lay out the choice of the look, and of pictures as they are rendered."""
    _beside("As rendered", boxes=1)
    _, workspace.display.as_rendered = imgui.checkbox("As rendered", workspace.display.as_rendered)
    imgui.set_item_tooltip("what engine3d.render draws, without marks")
    width = imgui.get_font_size() * 7
    _beside("", width)
    imgui.set_next_item_width(width)
    names = [translated_choice("look", look or "auto") for look in LOOKS]
    _, chosen = imgui.combo("##look", LOOKS.index(workspace.display.look), names)
    workspace.display.look = LOOKS[chosen]
    imgui.set_item_tooltip("look of scenes without light; auto: plain, and studio as rendered")


def _draw_modes(workspace: Workspace) -> None:
    """Lay out what the view shows of surfaces."""
    width = imgui.get_font_size() * 7
    _beside("", width)
    imgui.set_next_item_width(width)
    modes = [translated_choice("mode", mode) for mode in MODES]
    _, chosen = imgui.combo("##mode", MODES.index(workspace.display.mode), modes)
    workspace.display.mode = MODES[chosen]
    _beside("Wireframe", boxes=1)
    _, workspace.display.wireframe = imgui.checkbox("Wireframe", workspace.display.wireframe)


def _beside(label: str, width: float = 0.0, *, boxes: int = 0) -> None:
    """Place the next item on the same row if there is room."""
    style = imgui.get_style()
    width += (
        imgui.calc_text_size(translated(label.partition("##")[0])).x + 2.0 * style.frame_padding.x
    )
    width += boxes * (imgui.get_frame_height() + style.item_inner_spacing.x)
    imgui.same_line()
    if imgui.get_content_region_avail().x < width:
        imgui.new_line()
        _begin_row()
        imgui.same_line()


def _begin_row() -> None:
    """Keep a row of tools off the panel's edge, where a box without a frame would not be seen."""
    imgui.dummy((scaled(2.0), 0.0))


def _draw_steps(workspace: Workspace) -> None:
    """Lay out the snapping steps of the tools."""
    if imgui.button("Steps"):
        imgui.open_popup("steps")
    if not imgui.begin_popup("steps"):
        return
    for tool, (label, speed) in _STEPS.items():
        label_before(label, _LABELS)
        imgui.set_next_item_width(imgui.get_font_size() * 6)
        clamp = imgui.SliderFlags_.always_clamp
        changed, step = imgui.drag_float(
            f"##{label}", workspace.tools.steps[tool], speed, _LEAST, _MOST, "%.4g", clamp
        )
        if changed:
            workspace.tools.steps[tool] = float(f"{step:.4g}")  # as displayed
    imgui.end_popup()


def _draw_time(workspace: Workspace) -> None:
    """Lay out the time controls."""
    _beside("Pause")
    imgui.begin_disabled(not workspace.document.moves)
    if imgui.button("Pause" if workspace.plays else "Play"):
        workspace.play_or_pause()
    imgui.set_item_tooltip(translated_keys("Space"))
    _beside("|<")
    if imgui.button("|<"):
        workspace.rewind()
    imgui.set_item_tooltip("to time 0")
    imgui.end_disabled()

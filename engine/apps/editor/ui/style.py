"""The editor's appearance: colours, sizes, the font.

ImGui's style holds the scale of the screen, which all sizes follow.
"""

from __future__ import annotations

from importlib.resources import files

from imgui_bundle import imgui, imguizmo

FONT_PIXELS = 16.0
#: The lengths of the gizmo's style, which ImGui's does not hold.
_GIZMO_LENGTHS = (
    *("translation_line_thickness", "translation_line_arrow_size", "rotation_line_thickness"),
    *("rotation_outer_line_thickness", "scale_line_thickness", "scale_line_circle_size"),
    *("hatched_axis_line_thickness", "center_circle_size"),
)


def choose_style() -> None:
    """Set up the style of the current context, at scale 1."""
    imgui.style_colors_dark()
    style = imgui.get_style()
    # Pixel-aligned corners and edges need no antialiasing, which would cost time.
    style.window_border_size = 0.0
    popup = style.color_(imgui.Col_.popup_bg)
    style.set_color_(imgui.Col_.popup_bg, imgui.ImVec4(popup.x, popup.y, popup.z, 1.0))
    style.docking_separator_size = 2.0
    style.scrollbar_rounding = style.tab_rounding = style.grab_rounding = 0.0
    config = imgui.ImFontConfig()
    # Glyphs whose texels are pixels are copied.
    config.oversample_h = config.oversample_v = 1
    config.pixel_snap_h = True
    font = files("engine3d.data") / "fonts" / "sans.ttf"
    imgui.get_io().fonts.add_font_from_file_ttf(str(font), FONT_PIXELS, config)


def set_scale(scale: float) -> None:
    """Change the scale of texts, and of all lengths with it; texts are drawn anew, not enlarged."""
    style = imgui.get_style()
    if scale != style.font_scale_dpi:
        style.scale_all_sizes(scale / style.font_scale_dpi)
        style.font_scale_dpi = scale
    gizmo, usual = imguizmo.im_guizmo.get_style(), imguizmo.im_guizmo.Style()
    for name in _GIZMO_LENGTHS:
        setattr(gizmo, name, getattr(usual, name) * scale)


def scaled(length: float) -> float:
    """Return a length in pixels from that at scale 1."""
    return max(float(round(length * imgui.get_style().font_scale_dpi)), 1.0)

"""The editor's appearance: colours, sizes, the font."""

from __future__ import annotations

from importlib.resources import files

from imgui_bundle import imgui

FONT_PIXELS = 16.0


def choose_style(scale: int) -> None:
    """Set up the style of the current context, for a given screen scale."""
    imgui.style_colors_dark()
    style = imgui.get_style()
    # Pixel-aligned corners and edges need no antialiasing, which would cost time.
    style.window_border_size = 0.0
    popup = style.color_(imgui.Col_.popup_bg)
    style.set_color_(imgui.Col_.popup_bg, imgui.ImVec4(popup.x, popup.y, popup.z, 1.0))
    style.docking_separator_size = 2.0
    style.scrollbar_rounding = style.tab_rounding = style.grab_rounding = 0.0
    style.scale_all_sizes(float(scale))
    style.font_scale_dpi = float(scale)
    config = imgui.ImFontConfig()
    # Glyphs whose texels are pixels are copied.
    config.oversample_h = config.oversample_v = 1
    config.pixel_snap_h = True
    font = files("engine3d.data") / "fonts" / "sans.ttf"
    imgui.get_io().fonts.add_font_from_file_ttf(str(font), FONT_PIXELS, config)

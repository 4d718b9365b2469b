"""The layout: panel places, closed panels, and snapping steps; saved periodically.

In: the workspace, Dear ImGui's windows. Out: one file in ImGui's own format, with the editor's
settings in a section that ImGui ignores.
"""

from __future__ import annotations

import configparser
import contextlib
import math
import os
import re
from collections.abc import Mapping
from pathlib import Path

from ....base.files.atomic_write import atomic_write
from ....base.files.json_records import read_small
from ....errors import FileAccessError, FileFormatError, warn
from ....stage.overlays.ui_scale import LEAST_SCALE, MOST_SCALE
from ...desktop.user_folders import user_path
from .translated_imgui import imgui, label
from .workspace import PANELS, Workspace

_HEAD = "[engine3d][Editor]"
_SCALE = "ui_scale"
#: Layouts of other forms are from before panels had IDs that no language changes. ImGui writes IDs
#: in several ways.
_FORM, _PRESENT_FORM = "form", "2"
_LARGEST = 1 << 20  # bytes
#: A layout of another screen is used if its window was at most so many times as wide as this one.
_ROOM = 1.2
#: Of the window's width, and the least in heights of the font: the panels at the left and right.
_LEFT, _LEAST_LEFT, _MOST_LEFT = 0.2, 12.0, 0.25
_RIGHT, _LEAST_RIGHT, _MOST_RIGHT = 0.21, 21.0, 0.42


def layout_path() -> Path:
    """Return the path of the layout file."""
    return user_path("state", "editor.ini")


def load_layout(workspace: Workspace, size: tuple[int, int]) -> bool:
    """Load the saved layout; return whether there was one that suits a window of some size."""
    try:
        text = read_small(layout_path(), _LARGEST).decode("utf-8")
    except UnicodeError:
        warn(f"{layout_path()}: not in UTF-8: panels have their usual places")
        return False
    except (FileAccessError, FileFormatError) as error:
        if os.path.lexists(layout_path()):
            warn(f"{error}: panels have their usual places")
        return False
    settings = text.partition(_HEAD)[2].partition("\n[")[0]
    _read_settings(workspace, settings)
    if "[Docking]" in text and _section(settings).get(_FORM) != _PRESENT_FORM:
        return False
    ratio = _scale_ratio(settings)
    if ratio != 1.0:
        text = _enlarged(text, ratio)
    if _width_of(text) > _ROOM * size[0]:  # panels at the sides would keep their width
        return False
    imgui.load_ini_settings_from_memory(text)
    return True


def save_layout(workspace: Workspace) -> None:
    """Save the layout; on failure, the default is used next time."""
    path = layout_path()
    lines = [
        _HEAD,
        f"{_FORM}={_PRESENT_FORM}",
        f"closed={','.join(sorted(workspace.panels.closed))}",
    ]
    lines += [f"{tool}={step!r}" for tool, step in workspace.tools.steps.items()]
    lines.append(f"{_SCALE}={imgui.get_style().font_scale_dpi!r}")
    text = "\n".join(lines) + "\n\n" + imgui.save_ini_settings_to_memory()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(path) as file:
            file.write(text.encode())
    except (OSError, FileAccessError):
        return


def _scale_ratio(settings: str) -> float:
    """Return the present scale over that of a layout, which may be of another screen."""
    ratio = imgui.get_style().font_scale_dpi
    with contextlib.suppress(ValueError, ZeroDivisionError):
        ratio /= float(_section(settings).get(_SCALE, "1.0"))
    return ratio if LEAST_SCALE / MOST_SCALE <= ratio <= MOST_SCALE / LEAST_SCALE else 1.0


def _enlarged(text: str, ratio: float) -> str:
    """Return a layout with all its lengths multiplied."""

    def times(found: re.Match[str]) -> str:
        name, x, y = found.groups()
        return f"{name}={round(int(x) * ratio)},{round(int(y) * ratio)}"

    return re.sub(r"\b(Pos|Size|SizeRef)=(-?\d{1,9}),(-?\d{1,9})", times, text)


def _width_of(text: str) -> int:
    """Return how wide the window of a layout was; 0 if it does not say so."""
    found = re.search(r"^DockSpace .*\bSize=(\d{1,9})", text, re.MULTILINE)
    return int(found[1]) if found else 0


def _section(text: str) -> Mapping[str, str]:
    """Return the settings of the editor's section."""
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    with contextlib.suppress(configparser.Error):
        parser.read_string(f"[settings]\n{text}")
    return parser["settings"] if parser.has_section("settings") else {}


def _read_settings(workspace: Workspace, text: str) -> None:
    """Read the known settings of the editor's section."""
    settings = _section(text)
    workspace.panels.closed = set(settings.get("closed", "").split(",")) & set(PANELS)
    for tool in workspace.tools.steps:
        with contextlib.suppress(ValueError):
            step = float(settings.get(tool, "0.0"))
            if 0.0 < step < math.inf:
                workspace.tools.steps[tool] = step


def place_panels(space: int, size: tuple[int, int]) -> None:
    """Put the panels at their default places."""
    builder = imgui.internal
    builder.dock_builder_remove_node(space)
    # Plain numbers: Python before 3.11.4 cannot name the sum of members of two enumerations.
    is_space = int(builder.DockNodeFlagsPrivate_.dock_space)
    is_seen_through = int(imgui.DockNodeFlags_.passthru_central_node)
    builder.dock_builder_add_node(space, is_space | is_seen_through)
    builder.dock_builder_set_node_size(space, size)
    split = builder.dock_builder_split_node_py
    wide = _share(size[0], _LEFT, _LEAST_LEFT, _MOST_LEFT)
    *_, left, rest = split(space, imgui.Dir.left, wide)
    wide = _share(size[0], _RIGHT, _LEAST_RIGHT, _MOST_RIGHT) / (1.0 - wide)
    *_, right, rest = split(rest, imgui.Dir.right, wide)
    *_, below, middle = split(rest, imgui.Dir.down, 0.28)
    places = {
        "Hierarchy": left,
        "Scene": middle,
        "Properties": right,
        "Resources": below,
        "Materials": below,
        "Timeline": below,
        "Console": below,
    }
    for name, place in places.items():
        builder.dock_builder_dock_window(label(name), place)
    builder.dock_builder_finish(space)


def fill_gap(space: int) -> None:
    """Paint the middle if no panel is there: menus that were open over it would stay to be seen."""
    middle = imgui.internal.dock_builder_get_central_node(space)
    if middle is not None and middle.is_empty():
        color = imgui.get_color_u32(imgui.Col_.docking_empty_bg)
        imgui.get_background_draw_list().add_rect_filled(
            middle.pos, middle.pos + middle.size, color
        )


def _share(width: int, usual: float, least: float, most: float) -> float:
    """Return the share of a window's width that a panel at its side gets."""
    return min(max(usual, least * imgui.get_font_size() / width), most)


def begin_panel(name: str) -> bool:
    """Begin a panel; return whether to lay out its content.

    It has no cross, which one would hit beside its name: the menu "Window" closes it.
    """
    return imgui.begin(name)[0]

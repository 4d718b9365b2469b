"""The layout: panel places, closed panels, and snapping steps; saved periodically.

In: the workspace, Dear ImGui's windows. Out: one file in ImGui's own format, with the editor's
settings in a section that ImGui ignores.
"""

from __future__ import annotations

import configparser
import contextlib
import math
import os
from pathlib import Path

from ....base.files.atomic_write import atomic_write
from ....base.files.json_records import read_small
from ....errors import FileAccessError, FileFormatError, warn
from ...desktop.user_folders import user_path
from .translated_imgui import imgui, label
from .workspace import PANELS, Workspace

_HEAD = "[engine3d][Editor]"
_LARGEST = 1 << 20  # bytes


def layout_path() -> Path:
    """Return the path of the layout file."""
    return user_path("state", "editor.ini")


def load_layout(workspace: Workspace) -> bool:
    """Load the saved layout; return whether there was one."""
    try:
        text = read_small(layout_path(), _LARGEST).decode("utf-8")
    except UnicodeError:
        warn(f"{layout_path()}: not in UTF-8: panels have their usual places")
        return False
    except (FileAccessError, FileFormatError) as error:
        if os.path.lexists(layout_path()):
            warn(f"{error}: panels have their usual places")
        return False
    imgui.load_ini_settings_from_memory(text)
    _read_settings(workspace, text.partition(_HEAD)[2].partition("\n[")[0])
    return True


def save_layout(workspace: Workspace) -> None:
    """Save the layout; on failure, the default is used next time."""
    path = layout_path()
    lines = [_HEAD, f"closed={','.join(sorted(workspace.panels.closed))}"]
    lines += [f"{tool}={step!r}" for tool, step in workspace.tools.steps.items()]
    text = "\n".join(lines) + "\n\n" + imgui.save_ini_settings_to_memory()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(path) as file:
            file.write(text.encode())
    except (OSError, FileAccessError):
        return


def _read_settings(workspace: Workspace, text: str) -> None:
    """Read the known settings of the editor's section."""
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    with contextlib.suppress(configparser.Error):
        parser.read_string(f"[settings]\n{text}")
    if not parser.has_section("settings"):
        return
    settings = parser["settings"]
    workspace.panels.closed = set(settings.get("closed", "").split(",")) & set(PANELS)
    for tool in workspace.tools.steps:
        with contextlib.suppress(ValueError):
            step = settings.getfloat(tool, 0.0)
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
    *_, left, rest = split(space, imgui.Dir.left, 0.2)
    *_, right, rest = split(rest, imgui.Dir.right, 0.26)
    *_, below, middle = split(rest, imgui.Dir.down, 0.28)
    places = {
        "Hierarchy": left,
        "Scene": middle,
        "Properties": right,
        "Console": below,
        "Resources": below,
    }
    for name, place in places.items():
        builder.dock_builder_dock_window(label(name), place)
    builder.dock_builder_finish(space)


def begin_panel(workspace: Workspace, name: str) -> bool:
    """Begin a closable panel; return whether to lay out its content."""
    shown, is_open = imgui.begin(name, True)
    if not is_open:
        workspace.panels.closed.add(name)
    return shown

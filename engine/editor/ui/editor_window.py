"""The editor's window: its loop, its panels, their places.

In: a file, and what the user does. Out: pictures. A picture is drawn after something happened, and
a few more until everything has settled; then the loop sleeps.
"""

from __future__ import annotations

import time
import traceback
from pathlib import Path

import numpy as np
from imgui_bundle import imgui, imguizmo

from ... import events
from ...errors import FileAccessError
from ...files.atomic_write import atomic_write
from ...ui.imgui_painter import ImguiPainter
from ...viewer.window import Window
from ..user_folders import state_folder
from .console_panel import ConsolePanel
from .files import Files
from .hierarchy_panel import HierarchyPanel
from .imgui_input import ImguiInput
from .menus import draw_menus, entries, press_keys
from .properties_panel import PropertiesPanel
from .resources_panel import ResourcesPanel
from .scene_panel import ScenePanel
from .style import choose_style
from .workspace import Workspace

WINDOW_SIZE = (1600, 900)
#: How long the loop sleeps while nothing happens, and while a text cursor blinks.
IDLE_SECONDS, BLINK_SECONDS = 10.0, 0.4
#: How many pictures an event is worth: panels place what depends on each other one after another.
SETTLING = 3


def layout_path() -> Path:
    """Return where the places of the panels are kept from one time to the next."""
    return state_folder() / "editor.ini"


class EditorWindow:
    """The editor.

    Parameters
    ----------
    path : str, optional
        A file to edit.
    size : (int, int)
        Of the window, in pixels.
    Raises
    ------
    DisplayError
        There is no screen.
    """

    def __init__(self, path: str = "", *, size: tuple[int, int] = WINDOW_SIZE) -> None:
        self.workspace = Workspace()
        if path:
            self.workspace.open(path)
        self.window = Window(*size, self._title(), wait=True)
        self._context = imgui.create_context()
        io = imgui.get_io()
        io.config_flags |= imgui.ConfigFlags_.docking_enable
        io.config_flags |= imgui.ConfigFlags_.nav_enable_keyboard
        # What a panel that failed has left open is closed: see `_draw_panel`.
        io.config_error_recovery_enable_assert = False
        io.config_error_recovery_enable_debug_log = False
        io.set_ini_filename("")
        choose_style(self.window.scale)
        self._painter = ImguiPainter()
        self._input = ImguiInput(self.window)
        self._scene = ScenePanel(self.workspace, self._painter)
        self._files = Files(self.workspace)
        self._resources = ResourcesPanel(self.workspace, self._painter)
        hierarchy = HierarchyPanel(self.workspace)
        self._panels = [
            hierarchy,
            self._scene,
            PropertiesPanel(self.workspace, self._files),
            self._resources,
            ConsolePanel(self.workspace),
        ]
        self._files.offer_recovery()
        self._entries = entries(self.workspace, self._files, hierarchy)
        self._pixels = np.zeros((1, 1, 4), np.uint8)
        self._told: set[str] = set()
        self._last = time.monotonic()
        self._has_layout = self._load_layout()
        self._pictures_due = SETTLING

    def run(self) -> None:
        """Show the editor until the user closes it."""
        while not self.workspace.wants_exit:
            self.turn(0.0 if self._pictures_due else self._patience())
        self.workspace.close()
        self._save_layout()

    def turn(self, patience: float) -> None:
        """Wait for events, and draw a picture if one is due."""
        for event in self.window.events(patience):
            self._take(event)
        self.workspace.tick()
        if self.window.minimised or not (self._pictures_due or imgui.get_io().want_text_input):
            return
        self._pictures_due = max(self._pictures_due - 1, 0)
        self._draw()

    def _patience(self) -> float:
        return BLINK_SECONDS if imgui.get_io().want_text_input else IDLE_SECONDS

    def _take(self, event) -> None:
        self._pictures_due = SETTLING
        if isinstance(event, events.CloseRequested):
            self._files.exit()
        elif isinstance(event, events.FilesDropped):
            for path in event.paths:
                self.workspace.add_file(path, self._scene.node_under_mouse())
        else:
            self._input.feed(event)

    def _draw(self) -> None:
        size = self.window.size
        if self._pixels.shape[1::-1] != size:
            self._pixels = np.zeros((size[1], size[0], 4), np.uint8)
        io = imgui.get_io()
        now = time.monotonic()
        io.display_size = imgui.ImVec2(*size)
        io.delta_time, self._last = max(now - self._last, 1e-4), now
        imgui.new_frame()
        imguizmo.im_guizmo.begin_frame()
        self._lay_out()
        imgui.render()
        self._painter.draw(imgui.get_draw_data(), self._pixels)
        self._input.follow_pointer()
        self.window.present(self._pixels)
        if self._resources.is_waiting or self._scene.is_flying:
            self._pictures_due = max(self._pictures_due, 1)
        # ImGui takes no key or button both down and up in one picture: the rest waits for the next.
        if not self._context.input_events_queue.empty():
            self._pictures_due = SETTLING
        if self.window.title != self._title():
            self.window.title = self._title()

    def _title(self) -> str:
        return f"{self.workspace.document.title} - engine3d"

    def _lay_out(self) -> None:
        draw_menus(self.workspace, self._entries)
        flags = imgui.DockNodeFlags_.passthru_central_node
        space = imgui.dock_space_over_viewport(flags=flags)
        if not self._has_layout:
            place_panels(space, self.window.size)
            self._has_layout = True
        for panel in (*self._panels, self._files):
            self._draw_panel(panel)
        press_keys(self._entries)

    def _draw_panel(self, panel) -> None:
        """Lay a panel out; an error of it is told, since what isn't saved must not be lost."""
        state = imgui.internal.ErrorRecoveryState()
        imgui.internal.error_recovery_store_state(state)
        alpha = imgui.get_style().alpha
        try:
            panel.draw()
        except Exception as error:
            imgui.internal.error_recovery_try_to_recover_state(state)
            # ImGui takes an open `begin_disabled(False)` for another thing, and hides everything.
            imgui.get_style().alpha = alpha
            text = "".join(traceback.format_exception(error))
            if text not in self._told:
                self._told.add(text)
                self.workspace.console.write("error", text)

    def _load_layout(self) -> bool:
        try:
            imgui.load_ini_settings_from_memory(layout_path().read_text("utf-8"))
        except (OSError, UnicodeError):
            return False
        return True

    def _save_layout(self) -> None:
        """Keep the places of the panels; if that fails, they are the usual ones next time."""
        path = layout_path()
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with atomic_write(path) as file:
                file.write(imgui.save_ini_settings_to_memory().encode())
        except (OSError, FileAccessError):
            return

    def close(self) -> None:
        """Close the window; may be called twice."""
        self._scene.close()
        if self._context is not None:
            imgui.destroy_context(self._context)
            self._context = None
        self.window.close()

    def __enter__(self) -> EditorWindow:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def place_panels(space: int, size: tuple[int, int]) -> None:
    """Give the panels their usual places."""
    builder = imgui.internal
    builder.dock_builder_remove_node(space)
    flags = builder.DockNodeFlagsPrivate_.dock_space | imgui.DockNodeFlags_.passthru_central_node
    builder.dock_builder_add_node(space, flags)
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
        builder.dock_builder_dock_window(name, place)
    builder.dock_builder_finish(space)

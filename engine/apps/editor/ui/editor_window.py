"""The editor's window: its loop, its panels, and their layout.

In: a file, and user input. Out: pictures. After an event a few pictures are drawn, until everything
has settled; then the loop sleeps.
"""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable

import numpy as np
from imgui_bundle import imguizmo

from ....base.language import translated
from ....rendering.canvas import Canvas
from ....stage.overlays.lettering import heading_font
from ... import events
from ...imgui_painter.imgui_painter import ImguiPainter
from ...viewer.program_window import ProgramWindow
from .array_dialog import ArrayDialog
from .console_panel import ConsolePanel
from .files import Files
from .hierarchy_panel import HierarchyPanel
from .imgui_input import ImguiInput, of_one_picture
from .interrupts import Interrupts
from .keyboard.command_search import CommandSearch
from .keyboard.panel_focus import focus_panel, restore_cursor
from .keyboard.parent_choice import ParentChoice
from .keys_window import KeysWindow
from .materials.materials_panel import MaterialsPanel
from .menus import draw_menus, entries, press_keys
from .motion.timeline_panel import TimelinePanel
from .panel_layout import fill_gap, load_layout, place_panels, save_layout
from .properties_panel import PropertiesPanel
from .render_dialog import RenderDialog
from .resources_panel import ResourcesPanel
from .scene_panel import ScenePanel
from .start_chooser import StartChooser
from .style import choose_style, scaled, set_scale
from .translated_imgui import imgui
from .workspace import Workspace

WINDOW_SIZE = (1600, 900)
#: Sleep time of the idle loop: the longest delay of a signal that ends the editor, and the drawing
#: interval while a text cursor blinks.
IDLE_SECONDS = 0.4
#: Seconds after which the window reports that Python is running.
PATIENCE = 1.0
RUNNING = "Python runs: Esc stops it"
#: Sleep time of the loop while a file's thumbnail is being made.
WAITING_SECONDS = 0.02
#: Pictures drawn per event: panels adapt to one another over several pictures.
SETTLING = 3


class EditorWindow:
    """The editor window.

    Parameters
    ----------
    path : str, optional
        A file to edit; a scene (``.e3d.json``) need not be there yet.
    size : (int, int), optional
        Of the window, in pixels; not more than the screen has room for. By default the usual size,
        larger on a fine screen.
    ui_scale : float, optional
        The scale of texts and panels, 0.5 to 4; by default that of the screen.

    Raises
    ------
    DisplayError
        There is no screen.
    FileFormatError, FileAccessError
        The file cannot be read.
    """

    def __init__(
        self, path: str = "", *, size: tuple[int, int] | None = None, ui_scale: float | None = None
    ) -> None:
        self.workspace = Workspace()
        self._interrupts = Interrupts(self.workspace.keep_copy)
        self.workspace.guard = lambda: self._interrupts.stoppable(self._stops)
        if path:
            self.workspace.begin(path)
        self.window = ProgramWindow(size, WINDOW_SIZE, self._title(), ui_scale=ui_scale, wait=True)
        self.window.fit_to_screen()
        self._context = imgui.create_context()
        io = imgui.get_io()
        io.config_flags |= imgui.ConfigFlags_.docking_enable
        io.config_flags |= imgui.ConfigFlags_.nav_enable_keyboard
        # ImGui closes the windows that a failed panel left open: see `_draw_panel`.
        io.config_error_recovery_enable_assert = False
        io.config_error_recovery_enable_debug_log = False
        io.config_windows_move_from_title_bar_only = True
        # Typing into a number that only a double click opened would press shortcuts instead.
        io.config_drag_click_to_input_text = True
        io.set_ini_filename("")
        choose_style()
        set_scale(self.window.scale)
        self._painter = ImguiPainter()
        self._input = ImguiInput(self.window)
        self._scene = ScenePanel(self.workspace, self._painter)
        self._files = Files(self.workspace, self._painter)
        resources = ResourcesPanel(self.workspace, self._painter)
        parents, commands = ParentChoice(self.workspace), CommandSearch(self.workspace)
        hierarchy = HierarchyPanel(self.workspace, parents)
        properties = PropertiesPanel(self.workspace, self._files)
        materials = MaterialsPanel(self.workspace, self._painter, properties.draw_material_values)
        self._panels = {
            "Hierarchy": hierarchy,
            "Scene": self._scene,
            "Properties": properties,
            "Resources": resources,
            "Materials": materials,
            "Timeline": TimelinePanel(self.workspace),
            "Console": ConsolePanel(self.workspace),  # the last one is in front of its dock
        }
        self._waiting = resources, materials  # for pictures of what they list
        self._files.offer_recovery()
        self._rendering = RenderDialog(self.workspace, self._files)
        arrays = ArrayDialog(self.workspace)
        self._entries = entries(
            self.workspace, self._files, hierarchy, self._rendering, arrays, parents, commands
        )
        commands.entries = self._entries
        self._dialogs = (
            StartChooser(self.workspace, self._files),
            KeysWindow(self.workspace, self._entries),
            self._files,
            self._rendering,
            arrays,
            parents,
            commands,
        )
        self.workspace.panels.offers_start = not path
        self._pixels = np.zeros((1, 1, 4), np.uint8)
        self._told: set[str] = set()
        self._late: list = []  # events that wait for the next picture, or came while Python ran
        self._last = time.monotonic()
        self.workspace.panels.wants_usual_places = not load_layout(self.workspace, self.window.size)
        self._pictures_due = SETTLING

    def run(self) -> int:
        """Run the editor until the user closes it, or a signal ends it.

        Returns
        -------
        status : int
            The exit status: 0, or 128 and the number of the signal. What is not saved then is kept
            for the next editor to offer.
        """
        with self._interrupts:
            try:
                while not (self.workspace.wants_exit or self._interrupts.number):
                    self.turn(0.0 if self._pictures_due else IDLE_SECONDS)
            except BaseException:
                self.workspace.keep_copy()
                raise
            if self.workspace.wants_exit:
                self.workspace.close()
            else:
                self.workspace.keep_copy()
            save_layout(self.workspace)
            return self._interrupts.status

    def turn(self, patience: float) -> None:
        """Wait for events, and draw a picture if one is due."""
        waiting, self._late = self._late, []
        waiting += self.window.events(0.0 if waiting else patience)
        queue = self._context.input_events_queue
        holds = self.workspace.panels.pictures_to_focus > 0 or not queue.empty()
        happened, self._late = of_one_picture(waiting, holds)
        for event in happened:
            self._take_safely(event)
        if patience and not happened and self._scene.is_outdated:
            self._pictures_due = 1
        if self.workspace.lines_to_run:
            self._run_lines()
        self.workspace.tick()
        blinks = imgui.get_io().want_text_input
        if self.window.minimised or not (self._pictures_due or blinks):
            return
        self._pictures_due = max(self._pictures_due - 1, 0)
        self._draw()

    def _run_lines(self) -> None:
        """Run entered console lines, outside ImGui's layout."""
        self._pictures_due = SETTLING
        self._started = time.monotonic()
        self._has_told = False
        self.workspace.run_lines()
        self._last = time.monotonic()  # pressed keys were not held during the run

    def _stops(self) -> bool:
        """Return whether the user wants to stop running code; other events are queued."""
        happened = self.window.events()
        self._late += [event for event in happened if not _is_stop_key(event)]
        if not self._has_told and time.monotonic() - self._started > PATIENCE:
            self._has_told = True
            canvas = Canvas(self.window.size)
            canvas.pixels[:] = self._pixels if self._pixels.shape == canvas.pixels.shape else 0
            font, place, said = heading_font(self.window.scale), scaled(16.0), translated(RUNNING)
            canvas.text(place, place, said, "white", font=font, background=(150, 40, 40))
            self.window.present(canvas)
        closes = any(isinstance(event, events.CloseRequested) for event in happened)
        return closes or any(map(_is_stop_key, happened))

    def _take_safely(self, event) -> None:
        try:
            self._take(event)
        except Exception as error:
            self._tell(error)

    def _take(self, event) -> None:
        self._pictures_due = SETTLING
        if isinstance(event, events.Exposed | events.Resized | events.Restored):
            set_scale(self.window.scale)  # the window may have moved to another screen
        if isinstance(event, events.CloseRequested):
            self._rendering.close()
            self._files.exit()
        elif isinstance(event, events.FilesDropped):
            if self._rendering.is_waiting:
                return  # the scene must not change while it is drawn
            for path in event.paths:
                self.workspace.add_file(path, self._scene.node_under_mouse())
        else:
            if isinstance(event, events.KeyDown) and event.key == "Tab":
                self.workspace.hold_keys()  # ImGui opens the next number some pictures later
            self._input.feed(event)

    def _draw(self) -> None:
        size = self.window.size
        if self._pixels.shape[1::-1] != size:
            self._pixels = np.zeros((size[1], size[0], 4), np.uint8)
        io = imgui.get_io()
        now = time.monotonic()
        io.display_size = imgui.ImVec2(*size)
        io.delta_time, self._last = max(now - self._last, 1e-4), now
        self.workspace.animate(io.delta_time)
        self.workspace.panels.pictures_to_focus = max(
            self.workspace.panels.pictures_to_focus - 1, 0
        )
        imgui.new_frame()
        begun = _recovery_state()
        try:
            imguizmo.im_guizmo.begin_frame()
            self._lay_out()
            imgui.render()
        except BaseException:  # such as Ctrl-C: no ImGui frame may stay open when Python ends
            imgui.internal.error_recovery_try_to_recover_state(begun)
            imgui.end_frame()
            raise
        self._painter.draw(imgui.get_draw_data(), self._pixels)
        self._input.follow_pointer()
        self.window.present(self._pixels)
        if self._is_unfinished():
            self._pictures_due = max(self._pictures_due, 1)
        # ImGui cannot take a press and a release in one picture: the rest waits for the next.
        if not self._context.input_events_queue.empty():
            self._pictures_due = SETTLING
        if self.window.title != self._title():
            self.window.title = self._title()

    def _is_unfinished(self) -> bool:
        """Return whether the next picture will differ without any event."""
        if self._files.is_waiting or self._rendering.is_waiting:
            time.sleep(WAITING_SECONDS)
        panels = *self._waiting, self._files, self._rendering
        waits = any(panel.is_waiting for panel in panels)
        moves = self._scene.is_flying or self.workspace.is_moving
        return waits or moves or bool(self._late) or self.workspace.panels.pictures_to_focus > 0

    def _title(self) -> str:
        return f"{self.workspace.document.title} - engine3d"

    def _lay_out(self) -> None:
        workspace = self.workspace
        self._guarded(lambda: draw_menus(workspace, self._entries, self._files))
        flags = imgui.DockNodeFlags_.passthru_central_node
        space = imgui.dock_space_over_viewport(flags=flags)
        if workspace.panels.wants_usual_places:
            place_panels(space, self.window.size)
            workspace.panels.wants_usual_places = False
            workspace.panels.closed.clear()
        restore_cursor(workspace)
        focus_panel(workspace)
        fill_gap(space)
        for name, panel in self._panels.items():
            if name not in workspace.panels.closed:
                self._guarded(panel.draw)
        for dialog in self._dialogs:
            self._guarded(dialog.draw)
        self._guarded(lambda: press_keys(self._entries))

    def _guarded(self, lay_out: Callable[[], object]) -> None:
        """Run a layout function, and report its errors."""
        state = _recovery_state()
        alpha = imgui.get_style().alpha
        try:
            lay_out()
        except Exception as error:
            imgui.internal.error_recovery_try_to_recover_state(state)
            # ImGui treats an open `begin_disabled(False)` differently, and hides everything.
            imgui.get_style().alpha = alpha
            self._tell(error)

    def _tell(self, error: Exception) -> None:
        """Report an error once, and continue: unsaved work must not be lost."""
        text = "".join(traceback.format_exception(error))
        if text not in self._told:
            self._told.add(text)
            self.workspace.console.write("error", text)

    def close(self) -> None:
        """Close the window; may be called twice."""
        self._rendering.close()
        self._scene.close()
        if self._context is not None:
            imgui.destroy_context(self._context)
            self._context = None
        self.window.close()

    def __enter__(self) -> EditorWindow:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _recovery_state() -> imgui.internal.ErrorRecoveryState:
    """Return ImGui's stack, for cleanup after a failure."""
    state = imgui.internal.ErrorRecoveryState()
    imgui.internal.error_recovery_store_state(state)
    return state


def _is_stop_key(event) -> bool:
    """Return whether an event is Esc or Ctrl+C, which stop running code."""
    if not isinstance(event, events.KeyDown):
        return False
    return event.key == "Escape" or (event.control and event.key == "C")

"""The scene panel: the mouse turns the camera, selects, and drags the selection.

In: the workspace, the mouse state from ImGui. Out: a picture, redrawn only if it would change;
commands.
"""

from __future__ import annotations

import time

import numpy as np

from ....base.language import translated
from ....model.scene.nodes import Node, with_below
from ....rendering.frame import Frame
from ....stage.overlays.selection_outline import WIDTH, closed, outline_pixels
from ...imgui_painter.imgui_painter import ImguiPainter
from ..picking import enclosed, pick
from .gizmo_handles import GizmoHandles
from .keyboard.nudges import Nudges
from .materials import material_actions
from .motion.motion_lines import draw_ways
from .overlays import SHADOW, Overlays
from .panel_layout import begin_panel
from .scene_figures import SceneFigures
from .scene_pictures import ScenePictures
from .scene_tools import draw_tools
from .style import scaled
from .translated_imgui import imgui
from .view.camera_preview import CameraPreview
from .view.clickable_axes import ClickableAxes
from .workspace import Workspace

#: A press and release within this many pixels are a click.
CLICK_PIXELS = 4.0
MOST_SIDE = 8192
#: Keys that move the camera while the right button is held: axis and direction.
FLYING = {"w": (2, -1), "s": (2, 1), "a": (0, -1), "d": (0, 1), "q": (1, -1), "e": (1, 1)}
#: Scene radii per second, and the maximum time step of one picture.
FLYING_SPEED, LONGEST_STEP = 0.5, 0.1
RECTANGLE = (1.0, 0.7, 0.2, 0.9)


class ScenePanel:
    """Shows the scene.

    Parameters
    ----------
    workspace : Workspace
    painter : ImguiPainter
        Shows the picture.

    Attributes
    ----------
    is_flying : bool
        Whether keys move the camera: the next picture is another one.
    """

    def __init__(self, workspace: Workspace, painter: ImguiPainter) -> None:
        self._workspace, self._painter = workspace, painter
        self._pictures = ScenePictures(workspace)
        self._number = 0
        self._frame: Frame | None = None
        self._drawn: tuple = ()
        self._overlays = Overlays(workspace)
        self._gizmo = GizmoHandles(workspace)
        self._nudges = Nudges(workspace)
        self._preview = CameraPreview(workspace, painter)
        self._axes = ClickableAxes(workspace, painter)
        self._figures = SceneFigures(workspace)
        self._corner = imgui.ImVec2(0.0, 0.0)
        self._is_hovered = False
        self._pressed: tuple[float, float] | None = None
        self.is_flying = False

    def close(self) -> None:
        """Free the renderers."""
        self._pictures.close()
        self._preview.close()

    @property
    def is_outdated(self) -> bool:
        """Whether the panel tells of pictures a second though nothing was drawn lately."""
        return self._figures.shows_rate

    def node_under_mouse(self) -> Node | None:
        """Return the node under the mouse, if the mouse is over the scene."""
        if self._frame is None or not self._is_hovered:
            return None
        mouse = imgui.get_io().mouse_pos
        place = int(mouse.x - self._corner.x), int(mouse.y - self._corner.y)
        if not (0 <= place[0] < self._frame.width and 0 <= place[1] < self._frame.height):
            return None
        found = pick(self._workspace.scene, self._frame, *place, reach=0.0)
        return None if found is None else found.node

    def draw(self) -> None:
        """Lay the panel out."""
        imgui.push_style_var(imgui.StyleVar_.window_padding, (0.0, 0.0))
        shown = begin_panel("Scene")
        imgui.pop_style_var()
        if shown:
            self._nudges.press_keys()
            draw_tools(self._workspace, self._overlays)
            room = imgui.get_content_region_avail()
            size = tuple(min(max(int(side), 16), MOST_SIDE) for side in (room.x, room.y))
            self._show(size)
        imgui.end()

    def _accept_material(self, corner) -> None:
        """Take a material that is dropped on the picture."""
        if imgui.begin_drag_drop_target():
            mouse = imgui.get_io().mouse_pos
            place = int(mouse.x - corner.x), int(mouse.y - corner.y)
            found = pick(self._workspace.scene, self._frame, *place, reach=0.0)
            material_actions.accept(self._workspace, found and found.node, found)
            imgui.end_drag_drop_target()

    # The picture

    def _show(self, size: tuple[int, int]) -> None:
        self._workspace.aspect = size[0] / size[1]
        self._render(size)
        corner = imgui.get_cursor_screen_pos()
        corner = imgui.ImVec2(int(corner.x), int(corner.y))
        imgui.set_cursor_screen_pos(corner)
        imgui.image(imgui.ImTextureRef(self._number), size)
        hovered = self._is_hovered = imgui.is_item_hovered()
        self._accept_material(corner)
        self._corner = corner
        captured = False
        if not self._workspace.display.as_rendered:
            self._overlays.draw(self._frame, corner)
            draw_ways(self._workspace, self._frame, corner)
            self._draw_times(corner)
            if self._overlays.shown["ball"]:
                captured = self._axes.draw(self._frame, corner, hovered)
            captured = self._gizmo.draw(corner, size) or captured
            if self._overlays.shown["preview"]:
                self._preview.draw(corner, size)
            self._draw_camera_name(corner)
        self._turn_camera(hovered and not captured, corner, size)
        self._select(corner)

    def _render(self, size: tuple[int, int]) -> None:
        workspace = self._workspace
        key = (
            *(size, workspace.display.mode, workspace.display.wireframe, workspace.changes),
            *(workspace.display.look, workspace.display.as_rendered, workspace.display.culling),
            *(workspace.view.pose().tobytes(), workspace.view.orthographic),
            *(workspace.view.distance, workspace.document.selection.version),
            *(workspace.scene, workspace.scene.data.arrays.changes),
            *(workspace.through.node, self._overlays.shown["grid"]),
        )
        if key == self._drawn:
            return
        start = time.perf_counter()
        self._frame = frame = self._pictures.draw(size, self._overlays.shown["grid"])
        self._figures.note(time.perf_counter() - start)
        ids = [] if workspace.display.as_rendered else self._selected_ids()
        if ids:
            inside = closed(np.isin(frame.object_id, ids), self._pictures.grid_pixels(frame))
            outline_pixels(frame, inside, round(scaled(WIDTH)))
        if not self._number:
            self._number = self._painter.add(frame.color, opaque=True)
        self._painter.replace(self._number, frame.color, opaque=True)
        self._drawn = key

    def _draw_times(self, corner) -> None:
        """Show the figures of the scene's last picture."""
        text = self._figures.text(self._frame)
        place = corner.x + scaled(8.0), corner.y + self._frame.height - 1.5 * imgui.get_font_size()
        size, gap = imgui.calc_text_size(text), scaled(4.0)
        box = (place[0] - gap, place[1]), (place[0] + size.x + gap, place[1] + size.y)
        lines = imgui.get_window_draw_list()
        lines.add_rect_filled(*box, imgui.get_color_u32(SHADOW), gap)
        lines.add_text(place, imgui.get_color_u32(imgui.Col_.text), text)

    def _draw_camera_name(self, corner) -> None:
        """Tell which camera the view looks through."""
        node = self._workspace.through.node
        if node is None:
            return
        name = node.name or translated("a camera")
        text = translated("Through {name}: turn the view to leave it", name=name)
        middle = corner.x + (self._frame.width - imgui.calc_text_size(text).x) / 2
        color = imgui.get_color_u32(RECTANGLE)
        imgui.get_window_draw_list().add_text(
            (middle, corner.y + imgui.get_font_size() / 2), color, text
        )

    def _selected_ids(self) -> list[int]:
        """Return the IDs of the selected nodes and their subtrees."""
        ids = []
        for node in self._workspace.document.selection.topmost():
            ids += [below.id for below in with_below(node)]
        return ids

    # The mouse

    def _turn_camera(self, hovered: bool, corner, size: tuple[int, int]) -> None:
        """Handle the wheel and mouse buttons on the picture."""
        io, orbit = imgui.get_io(), self._workspace.orbit
        if hovered and io.mouse_wheel:
            self._workspace.through.leave()
            at = io.mouse_pos.x - corner.x, io.mouse_pos.y - corner.y
            orbit.dolly(io.mouse_wheel, at, size)
        held = [imgui.is_mouse_down(button) for button in range(3)]
        self.is_flying = False
        # A press counts from the next picture on: earlier motion turns nothing.
        if self._pressed is not None and held[1]:
            self._fly(io, size[1])
        elif self._pressed is not None and (held[2] or (io.key_alt and held[0])):
            self._drag_camera(io, size[1])
        if hovered and any(imgui.is_mouse_clicked(button) for button in range(3)):
            self._pressed = io.mouse_pos.x, io.mouse_pos.y
            imgui.set_window_focus()

    def _drag_camera(self, io, height: int) -> None:
        """Orbit the camera, pan with Shift, dolly with Ctrl."""
        orbit = self._workspace.orbit
        dx, dy = io.mouse_delta.x, io.mouse_delta.y
        if dx or dy:
            self._workspace.through.leave()
        if io.key_shift:
            orbit.pan(dx, dy, height)
        elif io.key_ctrl:
            orbit.dolly_drag(dy)
        else:
            orbit.rotate(dx, dy, height)

    def _fly(self, io, height: int) -> None:
        """Look around from the camera's position, and move it by keys."""
        workspace = self._workspace
        workspace.through.leave()
        view, position = workspace.view, workspace.view.position()
        workspace.orbit.rotate(io.mouse_delta.x / 2, io.mouse_delta.y / 2, height)
        axes = view.rotation()
        step = np.zeros(3)
        for key, (axis, sign) in FLYING.items():
            if imgui.is_key_down(getattr(imgui.Key, key)):
                step += sign * axes[:, axis]
                self.is_flying = True
        speed = FLYING_SPEED * workspace.bounds.radius * (4.0 if io.key_shift else 1.0)
        seconds = min(io.delta_time, LONGEST_STEP)
        view.target = position - axes[:, 2] * view.distance + step * speed * seconds

    def _select(self, corner) -> None:
        """Select the clicked node, or the nodes in a rectangle."""
        io = imgui.get_io()
        if not any(imgui.is_mouse_down(button) for button in range(3)):
            pressed, self._pressed = self._pressed, None
            if pressed is None or not imgui.is_mouse_released(0) or io.key_alt:
                return
            first = tuple(int(p - c) for p, c in zip(pressed, corner, strict=True))
            last = int(io.mouse_pos.x - corner.x), int(io.mouse_pos.y - corner.y)
            self._select_within(first, last, io.key_shift or io.key_ctrl)
        elif self._pressed is not None and not io.key_alt:
            if imgui.is_mouse_dragging(0, scaled(CLICK_PIXELS)):
                lines, color = imgui.get_window_draw_list(), imgui.get_color_u32(RECTANGLE)
                lines.add_rect(self._pressed, io.mouse_pos, color, thickness=scaled(1.0))

    def _select_within(self, first, last, adds: bool) -> None:
        workspace = self._workspace
        selection = workspace.document.selection
        if max(abs(a - b) for a, b in zip(first, last, strict=True)) > scaled(CLICK_PIXELS):
            nodes = enclosed(workspace.scene, self._frame, first, last)
            (selection.add if adds else selection.set)(nodes)
            return
        found = None
        if 0 <= last[0] < self._frame.width and 0 <= last[1] < self._frame.height:
            found = pick(workspace.scene, self._frame, *last)
        if found is None:
            if not adds:
                selection.set()
        elif adds:
            selection.toggle(found.node)
        else:
            selection.set([found.node])
        if found is not None:
            workspace.hierarchy.reveal(found.node)

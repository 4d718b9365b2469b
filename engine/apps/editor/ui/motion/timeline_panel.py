"""The panel of the time line: play and pause, the present time, and the keys of all moving nodes.

In: the workspace, the mouse. Out: the time; commands on keys, a drag of one is one step. Only
visible rows are laid out.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from typing import NamedTuple

from .....base.language import translated, translated_choice, translated_keys, translated_number
from .....model.motion.node_motion import NodeMotion
from .....model.scene.animation import Motions, Track
from .....model.scene.nodes import Node
from ...motion_commands import NAMES, with_key_at
from ...motion_copies import motions_in
from ..panel_layout import begin_panel
from ..style import scaled
from ..translated_imgui import imgui
from ..workspace import Workspace
from . import motion_actions as actions

_NAMES = 11.0  # width of the names, in heights of the font
_KEY = 5.0  # half the diagonal of a key, in pixels at scale 1
_STEPS = (1.0, 2.0, 5.0)
#: Pixels between two numbers of the ruler.
_APART = 60.0
_LINE, _MARK, _HEAD = (0.45, 0.5, 0.6, 1.0), (0.9, 0.55, 1.0, 1.0), (1.0, 0.45, 0.35, 1.0)
_PRECISION = 2  # decimals of the time of dragged keys


class _Grabbed(NamedTuple):
    """A key that the mouse holds."""

    node: Node
    number: int
    drag: Hashable
    length: float  # of the time line, which stays as it is meanwhile


class _Span(NamedTuple):
    """Where the time line is: from ``left``, ``width`` pixels for ``length`` seconds."""

    left: float
    width: float
    length: float

    def place(self, time: float) -> float:
        return self.left + self.width * time / self.length

    def time(self, x: float) -> float:
        return min(max((x - self.left) / self.width, 0.0), 1.0) * self.length


class TimelinePanel:
    """Shows when what moves, and moves the time.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._motions, self._made_of = Motions(), ()
        self._rows: list[tuple[Node, list[NodeMotion]]] = []
        self._grabbed: _Grabbed | None = None
        self._least = 0.0  # the length that the user asked for

    def draw(self) -> None:
        """Lay the panel out."""
        if begin_panel("Timeline"):
            self._draw_head()
            if imgui.begin_child("lanes"):
                self._draw_lanes()
            imgui.end_child()
        imgui.end()

    def _draw_head(self) -> None:
        workspace = self._workspace
        moves = workspace.document.moves
        imgui.begin_disabled(not moves)
        if imgui.button("|<"):
            workspace.rewind()
        imgui.set_item_tooltip("to time 0")
        imgui.same_line()
        if imgui.button("Pause###play" if workspace.plays else "Play###play"):
            workspace.play_or_pause()
        imgui.set_item_tooltip(translated_keys("Space"))
        imgui.end_disabled()
        imgui.same_line()
        imgui.set_next_item_width(5.5 * imgui.get_font_size())
        time = actions.time_of(workspace)
        changed, new = imgui.drag_float("##time", time, 0.02, 0.0, 1e6, "%.2f s")
        if changed:
            self._least = max(self._least, new)
            actions.seek(workspace, new)
        imgui.set_item_tooltip("the present time: drag, or Ctrl+click to type")
        self._draw_key_buttons()

    def _draw_key_buttons(self) -> None:
        workspace = self._workspace
        imgui.begin_disabled(not workspace.document.selection.nodes)
        for label, tip, act in (
            ("Set key", "K: where the selected nodes are now", actions.set_key),
            ("Delete key", "Shift+K: the key at this time", actions.delete_key),
        ):
            imgui.same_line()
            if imgui.button(label):
                act(workspace)
            imgui.set_item_tooltip(tip)
        imgui.end_disabled()
        for label, tip, step in (("< key", "J", -1), ("key >", "L", 1)):
            imgui.same_line()
            if imgui.button(label):
                actions.go_to_key(workspace, step)
            imgui.set_item_tooltip(tip)

    # The lanes

    def _draw_lanes(self) -> None:
        rows = self._found_rows()
        font, corner = imgui.get_font_size(), imgui.get_cursor_screen_pos()
        left = corner.x + _NAMES * font
        width = max(imgui.get_content_region_avail().x - (_NAMES + 1.0) * font, 40.0)
        span = _Span(left, width, self._length())
        self._draw_ruler(span)
        bottom = imgui.get_window_pos().y + imgui.get_window_height()
        if not rows:
            imgui.text_disabled("nothing moves: Motion in Properties lets the selected node do so")
        if imgui.begin_child("rows"):
            clipper = imgui.ListClipper()
            clipper.begin(len(rows), imgui.get_frame_height_with_spacing())
            while clipper.step():
                for number in range(clipper.display_start, clipper.display_end):
                    self._draw_row(span, *rows[number])
        imgui.end_child()
        if not imgui.is_mouse_down(0):
            self._grabbed = None
        x = span.place(self._shown_time(span.length))
        lines = imgui.get_window_draw_list()
        lines.add_line((x, corner.y), (x, bottom), imgui.get_color_u32(_HEAD))

    def _found_rows(self) -> list[tuple[Node, list[NodeMotion]]]:
        """Return the moving nodes of the scene with their motions, in scene order."""
        scene = self._workspace.scene
        motions = motions_in(scene)
        key = scene, scene.data.removals
        if self._made_of and self._made_of[0] is not scene:
            self._least = 0.0
        if motions is not self._motions or key != self._made_of:
            self._motions, self._made_of = motions, key
            self._rows = _rows_of(scene, motions)
        return self._rows

    def _length(self) -> float:
        if self._grabbed is not None:
            return self._grabbed.length
        return max(self._workspace.document.length, self._least) or actions.USUAL_LENGTH

    def _shown_time(self, length: float) -> float:
        time = actions.time_of(self._workspace)
        return time if time <= length else time % length

    def _draw_ruler(self, span: _Span) -> None:
        """Lay out the seconds, along which the mouse moves the time."""
        height = imgui.get_frame_height()
        top = imgui.get_cursor_screen_pos().y
        imgui.set_cursor_screen_pos((span.left - scaled(_KEY), top))
        imgui.invisible_button("ruler", (span.width + 2.0 * scaled(_KEY), height))
        if imgui.is_item_active():
            actions.seek(self._workspace, span.time(imgui.get_io().mouse_pos.x))
        lines, color = imgui.get_window_draw_list(), imgui.get_color_u32(_LINE)
        text = imgui.get_color_u32(imgui.Col_.text)
        step = ruler_step(span.length * _APART * imgui.get_font_size() / 16.0 / span.width)
        for count in range(int(span.length / step + 1e-6) + 1):
            x = span.place(count * step)
            lines.add_line((x, top + 0.6 * height), (x, top + height), color)
            lines.add_text((x + 2.0, top), text, translated_number(count * step, "g"))
        imgui.set_cursor_screen_pos((span.left - _NAMES * imgui.get_font_size(), top + height))

    def _draw_row(self, span: _Span, node: Node, motions: list[NodeMotion]) -> None:
        selection = self._workspace.document.selection
        imgui.push_id(node.id)
        place, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
        name = f"{node.name or translated('node {number}', number=node.id)}##name"
        size = ((_NAMES - 1.0) * imgui.get_font_size(), height)
        imgui.push_style_var(imgui.StyleVar_.selectable_text_align, (0.0, 0.5))
        chosen = imgui.selectable(name, node in selection, 0, size)[0]
        imgui.pop_style_var()
        if chosen:
            (selection.toggle if imgui.get_io().key_ctrl else selection.set)(
                node if imgui.get_io().key_ctrl else [node]
            )
        imgui.set_cursor_screen_pos((span.left - scaled(_KEY), place.y))
        imgui.invisible_button("lane", (span.width + 2.0 * scaled(_KEY), height), _BUTTONS)
        middle = place.y + 0.5 * height
        tracks = [motion for motion in motions if isinstance(motion, Track)]
        others = [motion for motion in motions if not isinstance(motion, Track)]
        for track in tracks:
            self._handle_keys(span, node, track)
        if not tracks and imgui.is_item_active():
            actions.seek(self._workspace, span.time(imgui.get_io().mouse_pos.x))
        if others:
            titles = ", ".join(translated_choice("motion", NAMES[type(each)]) for each in others)
            _draw_bar(span, place.y, height, "" if tracks else titles)
        for track in tracks:
            _draw_track(span, middle, track, self._shown_time(span.length))
        imgui.pop_id()

    def _handle_keys(self, span: _Span, node: Node, track: Track) -> None:
        """Let the mouse take, drag and delete keys of the lane that was laid out last."""
        x = imgui.get_io().mouse_pos.x
        if imgui.is_item_clicked(1):
            number = _key_at(span, track, x)
            if number is not None:
                actions.remove_key(self._workspace, track, number)
            return
        if imgui.is_item_activated() and imgui.is_mouse_down(0):
            number = _key_at(span, track, x)
            self._workspace.document.selection.set([node])
            if number is not None:
                drag = self._workspace.next_drag()
                self._grabbed = _Grabbed(node, number, drag, span.length)
                actions.seek(self._workspace, float(track.times[number]))
                return
        if not imgui.is_item_active() or not imgui.is_mouse_down(0):
            return
        held = self._grabbed
        if held is None or held.node is not node:
            actions.seek(self._workspace, span.time(x))
        elif imgui.is_mouse_dragging(0) and held.number < len(track.times):
            self._drag_key(held, track, round(span.time(x), _PRECISION))

    def _drag_key(self, held: _Grabbed, track: Track, time: float) -> None:
        if time == track.times[held.number]:
            return
        moved = with_key_at(track, held.number, time)
        actions.put(self._workspace, moved, "Move a key of", held.drag)
        actions.seek(self._workspace, float(moved.times[held.number]))


_BUTTONS = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right


def ruler_step(least: float) -> float:
    """Return the least of 1, 2, 5, 10, … seconds, or tenths of them, not below a number."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in (*_STEPS, 10.0) if step * power >= least * (1 - 1e-9))


def _rows_of(scene, motions: Motions) -> list[tuple[Node, list[NodeMotion]]]:
    found: dict[Node, list[NodeMotion]] = {}
    for kind in motions:
        for motion in kind:
            if motion.node is not None and motion.node.scene is scene:
                found.setdefault(motion.node, []).append(motion)
    return sorted(found.items(), key=lambda row: row[0].id)


def _key_at(span: _Span, track: Track, x: float) -> int | None:
    """Return the number of the key at a place, or None."""
    distances = [abs(span.place(time) - x) for time in track.times.tolist()]
    nearest = min(range(len(distances)), key=distances.__getitem__)
    return nearest if distances[nearest] <= scaled(_KEY + 2.0) else None


def _draw_track(span: _Span, middle: float, track: Track, time: float) -> None:
    lines, color = imgui.get_window_draw_list(), imgui.get_color_u32(_MARK)
    head = imgui.get_color_u32(_HEAD)
    places = [(span.place(each), each) for each in track.times.tolist()]
    lines.add_line((places[0][0], middle), (places[-1][0], middle), imgui.get_color_u32(_LINE))
    half = scaled(_KEY)
    for x, each in places:
        corners = [(x - half, middle), (x, middle - half), (x + half, middle), (x, middle + half)]
        lines.add_quad_filled(*corners, head if abs(each - time) < 5e-3 else color)


def _draw_bar(span: _Span, top: float, height: float, title: str) -> None:
    """Draw what goes on all the time."""
    lines = imgui.get_window_draw_list()
    low, high = (span.left, top + 0.2 * height), (span.left + span.width, top + 0.8 * height)
    lines.add_rect_filled(low, high, imgui.get_color_u32(imgui.Col_.frame_bg))
    if title:
        color = imgui.get_color_u32(imgui.Col_.text_disabled)
        at = span.left + 4.0, top + 0.5 * (height - imgui.get_font_size())
        lines.add_text(at, color, title)

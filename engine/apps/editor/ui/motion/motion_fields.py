"""The property fields of a node's motion: spin, orbit, path, keyframes.

In: the active node. Out: commands; a mouse drag is one step from press to release.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any

import numpy as np

from .....base.language import translated, translated_choice, translated_count
from .....choices import PathEnd
from .....errors import InvalidArgumentError
from .....model.motion.node_motion import NodeMotion
from .....model.motion.orbits import Orbit
from .....model.motion.paths import ENDS, FORWARDS, Path
from .....model.scene.animation import Spin, Track
from .....model.scene.nodes import Node
from ...motion_commands import NAMES, with_repeat
from ...motion_copies import motions_in
from ..properties.fields import LABEL_LETTERS, Fields
from ..translated_imgui import imgui
from ..workspace import Workspace
from . import motion_actions as actions

_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
_ENDS: dict[PathEnd, str] = dict(
    zip(
        ENDS,
        ("goes on to the first", "goes back", "jumps to the first", "stays"),
        strict=True,
    )
)
_LEAST_PERIOD = 1e-3
_MOST = 1e9
#: More nodes are found by the search only.
MOST_LISTED = 200


class MotionFields:
    """Shows what moves a node, and adds, changes and removes it.

    Parameters
    ----------
    workspace : Workspace
    fields : Fields
    """

    def __init__(self, workspace: Workspace, fields: Fields) -> None:
        self._workspace, self._fields = workspace, fields
        self._drag: Hashable = None
        self._search = ""

    def draw(self, node: Node, *, is_one_of_several: bool = False) -> None:
        """Lay the section of a node out; it says whose it is if several are selected."""
        if not imgui.is_any_item_active():
            self._drag = None  # the mouse let go
        title = translated("Motion")
        if is_one_of_several:
            title = translated("Motion of {name}", name=_name(node))
        if not imgui.collapsing_header(f"{title}###Motion", imgui.TreeNodeFlags_.default_open):
            return
        held = motions_in(self._workspace.scene).of(node)
        for motion in held:
            imgui.push_id(type(motion).__name__)
            self._draw_motion(motion)
            imgui.pop_id()
        imgui.text_disabled("Add")
        for name, add in actions.ADDED.items():
            imgui.same_line()
            if imgui.small_button(name):
                add(self._workspace)

    def _draw_motion(self, motion: NodeMotion) -> None:
        imgui.separator_text(actions.TITLES[type(motion)])
        if isinstance(motion, Spin):
            self._draw_spin(motion)
        elif isinstance(motion, Orbit):
            self._draw_orbit(motion)
        elif isinstance(motion, Path):
            self._draw_path(motion)
        elif isinstance(motion, Track):
            self._draw_keys(motion)
        kind = translated_choice("motion", NAMES[type(motion)])
        if imgui.small_button(translated("Remove the {motion}", motion=kind)):
            actions.remove(self._workspace, motion)

    # The kinds

    def _draw_spin(self, spin: Spin) -> None:
        node, given = spin.node, (spin.axis, spin.period, spin.phase)
        axis = self._axis(spin.axis)
        if axis is not None:
            self._put(lambda: Spin(node, spin.rotation, axis, *given[1:]))
        period = self._period("Seconds a turn", spin.period, both_ways=True)
        if period is not None:
            self._put(lambda: Spin(node, spin.rotation, given[0], period, given[2]))
        phase = self._phase(spin.phase)
        if phase is not None:
            self._put(lambda: Spin(node, spin.rotation, *given[:2], phase))

    def _draw_orbit(self, orbit: Orbit) -> None:
        def change(**values: Any) -> None:
            self._put(lambda: orbit.changed(**values))

        self._draw_about(orbit, change)
        speed = max(0.01 * orbit.radius, 1e-4)
        radius = self._number("Radius", orbit.radius, speed, 0.0)
        if radius is not None:
            change(radius=radius)
        period = self._period("Seconds a turn", orbit.period, both_ways=True)
        if period is not None:
            change(period=period)
        axis = self._axis(orbit.axis)
        if axis is not None:
            change(axis=axis)
        phase = self._phase(orbit.phase)
        if phase is not None:
            change(phase=phase)

    def _draw_about(self, orbit: Orbit, change) -> None:
        """Lay out the choice of what is circled; a node of the tree can be dropped on it."""
        about, node = orbit.about, orbit.node
        origin = name = translated("the origin of the parent")
        if orbit.is_about_node:
            name = translated("what is gone") if about is None else _name(about)
        self._fields.label("About")
        if imgui.begin_combo("##About", name):
            imgui.set_next_item_width(-1.0)
            _, self._search = imgui.input_text_with_hint("##search", "Search", self._search)
            if imgui.selectable(origin, not orbit.is_about_node)[0]:
                change(about=None)
            for each in self._found(node):
                label = f"{_name(each)}##{each.id}"
                if imgui.selectable(label, each is about)[0] and each is not about:
                    change(about=each)
            imgui.end_combo()
        if imgui.begin_drag_drop_target():
            payload = imgui.accept_drag_drop_payload_py_id("node")
            dropped = None if payload is None else node.scene.data.node_of(payload.data_id)
            if dropped is not None and dropped is not node:
                change(about=dropped)
            imgui.end_drag_drop_target()

    def _found(self, node: Node) -> list[Node]:
        """Return the first nodes whose names the search lets through, but one."""
        text, found = self._search.strip().casefold(), []
        for each in self._workspace.scene.nodes:
            if each is not node and text in each.name.casefold():
                found.append(each)
                if len(found) == MOST_LISTED:
                    break
        return found

    def _draw_path(self, path: Path) -> None:
        def change(**values: Any) -> None:
            self._put(lambda: path.changed(**values))

        self._draw_points(path, change)
        period = self._period("Seconds a way", path.period)
        if period is not None:
            change(period=period)
        phase = self._phase(path.phase)
        if phase is not None:
            change(phase=phase)
        self._fields.label("At the end it")
        if imgui.begin_combo("##At the end it", translated(_ENDS[path.end])):
            for end, says in _ENDS.items():
                if imgui.selectable(translated(says), end == path.end)[0] and end != path.end:
                    change(end=end)
            imgui.end_combo()
        nothing = translated("nothing")
        self._fields.label("Faces ahead")
        if imgui.begin_combo("##Faces ahead", path.forward or nothing):
            for forward in (None, *FORWARDS):
                is_now = forward == path.forward
                if imgui.selectable(forward or nothing, is_now)[0] and not is_now:
                    change(forward=forward)
            imgui.end_combo()
        changed, smooth = imgui.checkbox("Round", path.smooth)
        if changed:
            change(smooth=smooth)

    def _draw_points(self, path: Path, change) -> None:
        """Lay out the points of a path, with what adds and removes one."""
        step = max(self._workspace.bounds.radius / 200.0, 1e-4)
        for number, point in enumerate(path.points):
            imgui.push_id(number)
            changed, new = imgui.drag_float3("##point", point.tolist(), step)
            self._follow_drag()
            if changed:
                rows = path.points.copy()
                rows[number] = new
                change(points=rows)
            imgui.same_line()
            imgui.begin_disabled(len(path.points) <= 2)
            if imgui.small_button("x"):
                change(points=np.delete(path.points, number, axis=0))
            imgui.end_disabled()
            imgui.set_item_tooltip("remove this point")
            imgui.pop_id()
        if imgui.small_button("Add a point"):
            first, last = path.points[-2:]
            change(points=np.append(path.points, [last + (last - first)], axis=0))
        imgui.same_line()
        if imgui.small_button("Add where it is now"):
            change(points=np.append(path.points, [path.node.translation], axis=0))

    def _draw_keys(self, track: Track) -> None:
        count, last = len(track.times), float(track.times[-1])
        imgui.text_disabled(
            translated_count(
                "{count:,} key, the last at {time:.2f} s",
                "{count:,} keys, the last at {time:.2f} s",
                count,
                time=last,
            )
        )
        changed, repeat = imgui.checkbox("Repeat", track.repeat)
        if changed:
            self._put(lambda: with_repeat(track, repeat))
        imgui.same_line()
        if imgui.small_button("Set a key (K)"):
            actions.set_key(self._workspace)

    # Kinds of values

    def _put(self, make) -> None:
        """Give the node a changed motion; what does not go together is told."""
        try:
            motion = make()
        except InvalidArgumentError as error:
            self._workspace.console.write("error", translated("Motion: {reason}", reason=error))
            return
        actions.put(self._workspace, motion, drag=self._drag)

    def _follow_drag(self) -> None:
        """Note that the mouse grabbed the last item."""
        if imgui.is_item_activated():
            self._drag = self._workspace.next_drag()

    def _number(self, label: str, value: float, speed: float, low: float) -> float | None:
        """Lay out a number; return it if it changed."""
        self._fields.label(label)
        changed, new = imgui.drag_float(f"##{label}", value, speed, low, _MOST, "%.4g")
        self._follow_drag()
        return max(new, low) if changed else None

    def _period(self, label: str, value: float, *, both_ways: bool = False) -> float | None:
        """Lay out seconds; return them if they changed. The other direction has a box."""
        speed = max(0.01 * abs(value), _LEAST_PERIOD)
        period = self._number(label, abs(value), speed, _LEAST_PERIOD)
        sign = -1.0 if value < 0.0 else 1.0
        if both_ways:
            changed, _ = imgui.checkbox("The other way round", value < 0.0)
            if changed:
                return -value
        return None if period is None else sign * period

    def _phase(self, value: float) -> float | None:
        self._fields.label("Phase, turns")
        changed, new = imgui.drag_float("##Phase, turns", value, 0.005, -1e3, 1e3, "%.3f")
        self._follow_drag()
        return new if changed else None

    def _axis(self, axis: Sequence[float]) -> list[float] | None:
        """Lay out an axis: buttons of the usual ones, and three numbers."""
        chosen, letter = None, imgui.get_font_size()
        for name, usual in _AXES.items():
            if imgui.radio_button(name, tuple(axis) == usual):
                self._drag = None
                chosen = list(usual)
            imgui.same_line()
        imgui.new_line()
        self._fields.label("Axis", imgui.get_content_region_avail().x - LABEL_LETTERS * letter)
        changed, new = imgui.drag_float3("##Axis", list(map(float, axis)), 0.01)
        self._follow_drag()
        return chosen or (new if changed and any(new) else None)


def _name(node: Node) -> str:
    """Return how a node is called."""
    return node.name or translated("node {number}", number=node.id)

"""The dialog that asks how often, and how far apart, to repeat the selected nodes.

In: the user's choices. Out: an `ArrayNodes` command.
"""

from __future__ import annotations

import math

from ....base.language import translated
from ..array_command import MOST_PLACES, ArrayNodes, usual_steps
from .middle import begin_dialog
from .translated_imgui import imgui
from .workspace import Workspace

_TITLE = "Duplicate as an array"
_AXES = "XYZ"


class ArrayDialog:
    """Asks for the rows of an array.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    counts : list of int
        Along X, Y and Z.
    steps : list of float
        Along X, Y and Z, in units.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self.counts, self.steps = [10, 1, 1], [1.0, 1.0, 1.0]
        self._opens = False

    def open(self) -> None:
        """Open the dialog for the selected nodes."""
        self.steps = list(usual_steps(self._workspace.document.selection.nodes))
        self._opens = True

    def draw(self) -> None:
        """Lay out the dialog, if it is open."""
        if self._opens:
            imgui.open_popup(_TITLE)
            self._opens = False
        if begin_dialog(_TITLE):
            self._draw_choices()
            imgui.end_popup()

    def _draw_choices(self) -> None:
        is_entered = False
        for axis, name in enumerate(_AXES):
            imgui.align_text_to_frame_padding()
            imgui.text_unformatted(name)
            if axis == 0 and imgui.is_window_appearing():
                imgui.set_keyboard_focus_here()
            _label("Count")
            count = imgui.input_int(f"##count {name}", self.counts[axis], 0)[1]
            is_entered |= imgui.is_item_deactivated()
            self.counts[axis] = min(max(count, 1), MOST_PLACES)
            _label("Distance")
            _, step = imgui.input_float(f"##distance {name}", self.steps[axis], 0.0, 0.0, "%.6g")
            self.steps[axis] = float(f"{step:.6g}")  # as displayed: ImGui has single precision
            is_entered |= imgui.is_item_deactivated()
        self._draw_answer(is_entered and imgui.is_key_pressed(imgui.Key.enter, False))

    def _draw_answer(self, is_entered: bool) -> None:
        places = math.prod(self.counts)
        fits = 1 < places <= MOST_PLACES
        told = translated("{count:,} in all, of at most {most:,}", count=places, most=MOST_PLACES)
        imgui.text_disabled(told)
        imgui.begin_disabled(not fits)
        if imgui.button("Duplicate") or (is_entered and fits):
            self._finish()
        imgui.end_disabled()
        imgui.same_line()
        if imgui.button("Cancel") or imgui.is_key_pressed(imgui.Key.escape, False):
            imgui.close_current_popup()

    def _finish(self) -> None:
        workspace = self._workspace
        nodes = workspace.document.selection.nodes
        workspace.do(ArrayNodes(workspace.scene, nodes, self.counts, self.steps))
        workspace.frame((*nodes, *workspace.document.selection.nodes))  # rows may reach the eye
        imgui.close_current_popup()


def _label(text: str) -> None:
    """Lay out a label before the next item, beside the last one."""
    imgui.same_line()
    imgui.text_unformatted(translated(text))
    imgui.same_line()
    imgui.set_next_item_width(6.0 * imgui.get_font_size())

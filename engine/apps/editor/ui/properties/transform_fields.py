"""The fields of where nodes are: position, rotation in degrees, scale."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .....model.scene.nodes import Node
from ..translated_imgui import imgui
from ..workspace import Workspace
from .fields import Fields, rows_of

_IDENTITY = {"translation": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": 1.0}
#: A pixel of a drag moves by this part of the scene's radius.
STEP = 1 / 200


class TransformFields:
    """Lays out the transform of nodes.

    Parameters
    ----------
    workspace : Workspace
    fields : Fields
    """

    def __init__(self, workspace: Workspace, fields: Fields) -> None:
        self._workspace, self._fields = workspace, fields
        self._start: list[list[float]] = []  # the scales when the mouse grabbed a number

    def draw(self, nodes: Sequence[Node]) -> None:
        """Lay the section out."""
        fields = self._fields
        if not fields.folder("Transform"):
            return
        step = max(self._workspace.bounds.radius * STEP, 1e-4)
        fields.vector(nodes, "translation", "Position", step)
        fields.vector(nodes, "euler", "Rotation", 0.5, math.degrees(1.0))
        tools = self._workspace.tools
        if tools.is_uniform:
            self._draw_scale(nodes)
        else:
            fields.vector(nodes, "scale", "Scale", 0.01)
        tools.is_uniform = imgui.checkbox("Uniform scale", tools.is_uniform)[1]
        imgui.set_item_tooltip("one number changes the others in proportion")
        if fields.button("Reset the transform"):
            fields.set(nodes, _IDENTITY, "Reset the transform")

    def _draw_scale(self, nodes: Sequence[Node]) -> None:
        """Lay out the scale; a change of one number changes the others in proportion."""
        fields, before = self._fields, self._fields.drag_key
        rows = rows_of(nodes, lambda node: [float(value) for value in node.scale])
        changed = fields.numbers("Scale", rows, 0.01)
        if fields.drag_key != before:
            self._start = [[float(value) for value in node.scale] for node in nodes]
        if changed and len(self._start) == len(nodes):
            (place, new), *_ = changed.items()
            each = zip(nodes, self._start, strict=True)
            fields.drag((node, {"scale": _in_proportion(old, place, new)}) for node, old in each)


def _in_proportion(old: Sequence[float], place: int, new: float) -> list[float]:
    """Return numbers multiplied alike, so that one of them is a new one."""
    if old[place] == 0.0:
        return [new] * len(old)
    factor = new / old[place]
    return [new if k == place else value * factor for k, value in enumerate(old)]

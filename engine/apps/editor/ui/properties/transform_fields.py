"""The fields of where nodes are: position, rotation in degrees, scale."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .....model.scene.nodes import Node
from ..workspace import Workspace
from .fields import Fields

_IDENTITY = {"translation": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": 1.0}
#: A pixel of a drag moves by this part of the scene's radius.
STEP = 1 / 200


def draw_transform(workspace: Workspace, fields: Fields, nodes: Sequence[Node]) -> None:
    """Lay out the transform of nodes."""
    if not fields.folder("Transform"):
        return
    fields.vector(nodes, "translation", "Position", max(workspace.bounds.radius * STEP, 1e-4))
    fields.vector(nodes, "euler", "Rotation", 0.5, math.degrees(1.0))
    fields.vector(nodes, "scale", "Scale", 0.01)
    if fields.button("Reset the transform"):
        fields.set(nodes, _IDENTITY, "Reset the transform")

"""The views along the axes: front, right, top, and those from across."""

from __future__ import annotations

import math

from .....stage.views.viewpoint import QUARTER_TURN, Viewpoint

#: Azimuth and elevation of each view, and its key.
STANDARD_VIEWS = {
    "Front": (0.0, 0.0, "1"),
    "Back": (math.pi, 0.0, "Ctrl+1"),
    "Right": (QUARTER_TURN, 0.0, "3"),
    "Left": (-QUARTER_TURN, 0.0, "Ctrl+3"),
    "Top": (0.0, QUARTER_TURN, "7"),
    "Bottom": (0.0, -QUARTER_TURN, "Ctrl+7"),
}


def look_from(view: Viewpoint, name: str) -> None:
    """Look at the same target from one of the standard views."""
    view.azimuth, view.elevation, _ = STANDARD_VIEWS[name]

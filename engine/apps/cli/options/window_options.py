"""The options of all commands that open a window."""

from __future__ import annotations

from .. import values


def add_ui_scale(group) -> None:
    """Add the option for the scale of texts and panels."""
    group.add_argument(
        "--ui-scale",
        type=values.ui_scale,
        metavar="N",
        help="how many times larger texts and panels are, 0.5 to 4, such as 1.5; by default as the "
        "screen and the picture want it",
    )

"""The options of ``learn``."""

from __future__ import annotations

from .. import config
from . import language_options, window_options


def add(command) -> None:
    """Add the options for lesson, language and output."""
    command.add_argument(
        "lesson",
        metavar="LESSON",
        nargs="?",
        default="1",
        help="its number or name, such as 3 or lines (default: 1)",
    )
    command.add_argument("--list", action="store_true", help="list the lessons")
    command.add_argument("--path", action="store_true", help="print where the program is")
    command.add_argument("--code", action="store_true", help="print the lines to type")
    command.add_argument(
        "--check",
        metavar="FILE",
        help="run a program of yours, and tell whether the last number that it prints answers the "
        "exercise",
    )
    command.add_argument(
        "--terminal",
        action="store_true",
        help="show it in the terminal, also over SSH: as kitty graphics, sixels or coloured text",
    )
    language_options.add(command)
    command.add_argument(
        "-o",
        "--output",
        metavar="FOLDER|FILE.html",
        help="write the lesson's pictures to a folder, or the lesson as one page of HTML, "
        "instead of opening a window",
    )
    window_options.add_ui_scale(command)
    config.add_config(command)

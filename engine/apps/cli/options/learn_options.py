"""The options of ``learn``."""

from __future__ import annotations

from . import language_options


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
    language_options.add(command)
    command.add_argument(
        "-o",
        "--output",
        metavar="FOLDER",
        help="write the lesson's pictures to a folder instead of opening a window",
    )

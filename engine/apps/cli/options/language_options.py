"""The option for the language of windows, and what chooses one without it."""

from __future__ import annotations

import argparse

from ....base.language import languages, usual_language
from ....errors import FileFormatError
from ..config import said_for_all

NAME = "language"


def add(parser) -> None:
    """Add the option."""
    *others, last = languages()
    parser.add_argument(
        f"--{NAME}",
        choices=languages(),
        help=f"of the texts in the window: {', '.join(others)} or {last} (default: that of the "
        "locale or the system, if it is one of these, or else en)",
    )


def language_of(args: argparse.Namespace) -> str:
    """Return the language of a command's window: as asked, by the config file, or the locale's.

    Raises
    ------
    FileFormatError
        The user's own config file names a language that is not there.
    """
    if args.language is not None:
        return args.language
    # Commands with --config have read the files already.
    said = None if "config" in args else said_for_all(NAME)
    if said is None:
        return usual_language()
    if said.value not in languages():
        known = ", ".join(languages())
        raise FileFormatError(
            f"[{said.number}].options.{NAME}: one of {known} is needed, not {said.value!r}",
            said.path,
        )
    return str(said.value)

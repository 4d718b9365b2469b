"""A parser whose errors are one line, with what was probably meant.

In: arguments. Out: what argparse makes of them, or a line on standard error and exit status 2.
"""

from __future__ import annotations

import argparse
import difflib
import os
from collections.abc import Iterable

from ..errors import printable

#: How alike two words must be, 0 to 1, for one to be a slip for the other.
LIKENESS = 0.6


class Parser(argparse.ArgumentParser):
    """A parser whose errors are a line, not lost below all the options that there are.

    Attributes
    ----------
    commands : dict
        The parsers of its commands, by name.
    """

    commands: dict[str, argparse.ArgumentParser]

    def error(self, message):
        self.exit(2, f"{self.prog}: error: {printable(message)} (see {self.prog} --help)\n")

    def _check_value(self, action, value):
        if action.choices is None or value in action.choices:
            return
        choices = list(map(str, action.choices))
        if isinstance(action, argparse._SubParsersAction):
            message = f"there is no command {value!r}{meant(value, choices)}"
            if os.path.exists(value):
                message = f"{value!r} is no command; to see that file: engine3d run {value}"
            raise argparse.ArgumentError(None, message)
        known = ", ".join(choices)
        message = f"{str(value)!r} is not one of {known}{meant(str(value), choices)}"
        raise argparse.ArgumentError(action, message)


def meant(word: str, known: Iterable[str]) -> str:
    """Return the end of a message that asks whether one of the known words was meant, or ``""``."""
    similar = difflib.get_close_matches(word, list(known), 1, LIKENESS)
    return f": did you mean {similar[0]}?" if similar else ""


def option_strings(parser: argparse.ArgumentParser) -> list[str]:
    """Return the long options of a parser."""
    options = (option for action in parser._actions for option in action.option_strings)
    return [option for option in options if option.startswith("--")]

"""The short help of a command with many options: `--help` shows the common ones, `--help-all` all.

In: a parser with its options. Out: the same parser, whose help leaves the others out.
"""

from __future__ import annotations

import argparse
import functools
from collections.abc import Collection

#: The option that shows the whole help.
WHOLE = "--help-all"


def shorten(command: argparse.ArgumentParser, common: Collection[str]) -> None:
    """Let the help of a command show only common options, and tell of `WHOLE`.

    Parameters
    ----------
    command : argparse.ArgumentParser
        With all its options.
    common : collection of str
        The long options that the short help shows, such as ``"--output"``.
    """
    count = sum(bool(action.option_strings) for action in command._actions)
    command.add_argument(
        WHOLE, action=_WholeHelp, nargs=0, help=f"show all {count} options and exit"
    )
    shown = {"--help", WHOLE, *common}
    command.usage = f"{command.prog} [OPTION ...] [MODEL ...]"
    command.formatter_class = functools.partial(_ShortHelp, shown)


class _ShortHelp(argparse.HelpFormatter):
    """Leaves out the options that are not among those shown."""

    def __init__(self, shown: Collection[str], prog: str) -> None:
        super().__init__(prog)
        self._shown = shown

    def add_argument(self, action: argparse.Action) -> None:
        if not action.option_strings or not self._shown.isdisjoint(action.option_strings):
            super().add_argument(action)


class _WholeHelp(argparse.Action):
    """Prints the whole help and exits, like ``--help``."""

    def __call__(self, parser, namespace, values, option_string=None):
        parser.formatter_class = argparse.HelpFormatter
        parser.print_help()
        parser.exit()

"""The command line parser, and the parsing of arguments."""

from __future__ import annotations

import argparse
import functools
import importlib
from collections.abc import Iterable, Sequence

from ...version import __version__
from . import config
from .arguments import Parser, join_values, option_meant
from .commands import COMMANDS
from .plugin_commands import plugin_commands
from .plugin_switch import NO_PLUGINS
from .short_help import shorten
from .usage import UsageError


def parse(arguments: list[str]) -> argparse.Namespace:
    """Return the parsed arguments.

    Raises `UsageError`, or `SystemExit` after argparse has printed its line.
    """
    command = next((word for word in arguments if not _is_option(word)), "")
    args = _parsed(arguments, make_parser(command))
    if "define" not in args:
        return args

    def configured(models: Sequence[str]) -> argparse.Namespace:
        found, said = args, config.options_in_files(args, models)
        if said or args.define:
            parser = make_parser(command)
            config.set_defaults(parser.commands[command], said, args, models, _all_commands)
            found = _parsed(arguments, parser)
        found.configured = configured
        return found

    return configured(getattr(args, "models", ()))


def _parsed(arguments: list[str], parser: Parser) -> argparse.Namespace:
    args, unknown = parser.parse_known_args(join_values(arguments))
    # With options between positional arguments, argparse takes only the first of these.
    files = getattr(args, "models", None) or getattr(args, "pictures", None)
    if files and not any(_is_option(argument) for argument in unknown):
        files += unknown
        unknown = []
    if unknown:
        program = " ".join(filter(None, ("engine3d", args.command)))
        command = parser.commands.get(args.command, parser)
        wrong = next(filter(_is_option, unknown), "").partition("=")[0]
        hint = option_meant(wrong, command)
        message = f"unknown arguments: {' '.join(unknown)}{hint}"
        raise UsageError(f"{message} (see {program} --help)")
    return args


def _is_option(argument: str) -> bool:
    return argument.startswith("-") and argument != "-"


def make_parser(asked: str | None = None) -> Parser:
    """Return the parser; ``load_command()`` of its result returns the command's function.

    Parameters
    ----------
    asked : str, optional
        The only command that gets its options; all do if left out.
    """
    parser = Parser(
        prog="engine3d",
        description="Draw 3D models on the CPU: in a window, or to a file.",
        epilog="engine3d COMMAND --help lists the options of a command. To begin: engine3d run",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"engine3d {__version__}")
    parser.set_defaults(load_command=_missing_command)
    parser.add_argument(
        "--list-readers",
        action=_ListReaders,
        nargs=0,
        help="print the file formats that can be read",
    )
    add_no_plugins(parser)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", dest="command")
    for name, row in (COMMANDS | plugin_commands(asked)).items():
        command = commands.add_parser(
            name, allow_abbrev=False, help=row.help, description=row.description
        )
        command.set_defaults(load_command=functools.partial(_load, name))
        if asked in (None, name):
            row.add(command)
            if row.is_quiet:
                add_quiet(command)
            add_no_plugins(command)
            if row.common:
                shorten(command, row.common)
    parser.commands = commands.choices
    return parser


def _all_commands() -> Iterable[argparse.ArgumentParser]:
    return make_parser().commands.values()


def add_quiet(command: argparse.ArgumentParser) -> None:
    """Add the option for less output."""
    command.add_argument("--quiet", action="store_true", help="print errors only, no warnings")


def add_no_plugins(command: argparse.ArgumentParser) -> None:
    """Add the option that leaves plug-ins out, which `main` obeys before anything is parsed."""
    command.add_argument(
        NO_PLUGINS, action="store_true", help="leave out what other packages add (docs/plugins.md)"
    )


def _missing_command():
    *names, last = COMMANDS
    raise UsageError(f"say which command: {', '.join(names)} or {last} (see engine3d --help)")


def _load(command: str):
    return getattr(importlib.import_module(f".commands.{command}", __package__), command)


class _ListReaders(argparse.Action):
    """Prints the formats and exits, like ``--version``."""

    def __call__(self, parser, namespace, values, option_string=None):
        from .readers import list_readers

        list_readers()
        parser.exit()

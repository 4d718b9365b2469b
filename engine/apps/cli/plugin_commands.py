"""Commands that packages add: rows beside those that ship.

In: plug-ins of the group ``engine3d.commands``; their values are ``add(parser) -> run``, where
``run(args)`` returns an exit status, or exits with one. Nothing is imported before a plug-in's
command is asked for.
"""

from __future__ import annotations

import argparse
import functools
import sys
from collections.abc import Callable

from ...base.plugins.plugin import Plugin, fault
from ...base.plugins.registry import find_plugin, origins_of, plugin_names
from ...errors import PluginError, warn
from .commands import COMMANDS, Command
from .plugin_switch import NO_PLUGINS

_MOST = 255  # the system keeps no more of an exit status
# Options that `make_parser` adds after a plug-in's own.
_SHARED = ("--quiet", NO_PLUGINS)


def plugin_commands(asked: str | None) -> dict[str, Command]:
    """Return the rows of plug-ins' commands; none where a command that ships is asked for."""
    if asked in COMMANDS:
        return {}
    return {name: _row(name, asked) for name in plugin_names("commands")}


def _row(name: str, asked: str | None) -> Command:
    # argparse formats the texts with %
    about = f"by {origins_of('commands', name)}".replace("%", "%%")
    return Command(about, about, functools.partial(_add, name, asked))


def _add(name: str, asked: str | None, parser: argparse.ArgumentParser) -> None:
    """Let a plug-in add its options; if all commands are asked for, a broken one is left out."""
    try:
        plugin = find_plugin("commands", name)
        assert plugin is not None
        run = _added(plugin, parser)
    except PluginError as error:
        if asked is not None:
            raise
        warn(f"{error}: its options are left out")
        return
    parser.set_defaults(load_command=lambda: functools.partial(_run, plugin, run))


def _added(plugin: Plugin, parser: argparse.ArgumentParser) -> Callable:
    add = plugin.use()
    with plugin.named_in_errors():
        run = add(parser)
    for option in _SHARED:
        if option in parser._option_string_actions:
            raise fault(plugin, f"adds {option}, which every command has")
    if not callable(run):
        raise fault(plugin, f"returned {type(run).__name__}, not the function that runs it")
    parser.description = (add.__doc__ or parser.description or "").strip()
    return run


def _run(plugin: Plugin, run: Callable, args: argparse.Namespace) -> int:
    """Run the command of a plug-in; return the exit status."""
    with plugin.named_in_errors(BrokenPipeError):  # `main` ends quietly if nobody reads on
        status = _status(run, args)
    if status is not None and type(status) is not int:
        raise fault(plugin, f"returned {type(status).__name__}, not an exit status")
    if status is not None and not 0 <= status <= _MOST:
        raise fault(plugin, f"returned {status}, but exit statuses are 0..{_MOST}")
    return status or 0


def _status(run: Callable, args: argparse.Namespace) -> object:
    """Return what a command returns, or the status with which it exits, as the system has it."""
    try:
        return run(args)
    except SystemExit as stop:
        if stop.code is None or isinstance(stop.code, int):
            return int(stop.code or 0) & _MOST
        print(stop.code, file=sys.stderr)
        return 1

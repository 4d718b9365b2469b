"""The manual page, from the parser of the command line: every command, every option.

In: the parser. Out: a text for `man`. An option that an earlier command has, too, with the same
help, is named there and not explained again.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from engine3d.apps.cli.parser import make_parser
from engine3d.apps.cli.short_help import WHOLE

LONGEST_CHOICES = 44  # letters
EXIT_STATUS = {
    "0": "The command did what it should; engine3d diff found no difference.",
    "1": "An error, which a line on standard error names; pictures differ.",
    "2": "The command line is wrong.",
    "128 + N": "The command was ended by the signal N.",
}


def manual_page(version: str, date: str) -> str:
    """Return the page of a version, released on a date such as 2026-12-01."""
    return "\n".join(_lines(make_parser(), version, date)) + "\n"


def _lines(parser: argparse.ArgumentParser, version: str, date: str) -> Iterator[str]:
    yield f'.TH ENGINE3D 1 "{date}" "engine3d {version}" "User Commands"'
    yield ".nh"  # words such as names of options stay whole
    yield ".ad l"
    yield ".SH NAME"
    yield _plain("engine3d - draw 3D models on the CPU, in a window or to a file")
    yield ".SH SYNOPSIS"
    yield rf"{_bold('engine3d')} \fICOMMAND\fR [\fIOPTION\fR ...] [\fIFILE\fR ...]"
    yield ".SH DESCRIPTION"
    yield _plain(parser.description)
    yield _plain("The first command to try is")
    yield _bold("engine3d run") + ","
    yield _plain("which shows a model that comes with the program.")
    yield ".SH OPTIONS"
    yield from _options(_own(parser))
    yield ".SH COMMANDS"
    told: dict[tuple[str, ...], tuple[str, str]] = {}
    for name, command in parser.commands.items():
        yield from _command(name, command, told)
    yield ".SH EXIT STATUS"
    for status, text in EXIT_STATUS.items():
        yield ".TP"
        yield _bold(status)
        yield _plain(text)


def _own(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    """Return the arguments and options, without the list of commands and what asks for help."""
    return [
        action
        for action in parser._actions
        if not isinstance(action, argparse._SubParsersAction)
        and action.help != argparse.SUPPRESS
        and not {"--help", WHOLE} & {*action.option_strings}
    ]


def _command(name, command, told) -> Iterator[str]:
    """Yield the section of a command.

    told: of each option's names, the help and the first command that has it; grows.
    """
    actions = _own(command)
    words = [name, "[OPTION ...]", *(_positional(a) for a in actions if not a.option_strings)]
    yield f'.SS "engine3d {_escaped(" ".join(words))}"'
    yield _plain(command.description)
    new, again = [], {}
    for action in actions:
        names, text = tuple(action.option_strings), _help(action, command)
        if names and told.setdefault(names, (text, name)) != (text, name):
            if told[names][0] == text:
                again.setdefault(told[names][1], []).append(names[-1])
                continue
        new.append(action)
    yield from _options(new, command)
    for other, names in again.items():
        yield ".P"
        yield _plain(f"As for engine3d {other}:")
        yield ",\n".join(map(_bold, names)) + "."


def _options(actions, command=None) -> Iterator[str]:
    for action in actions:
        yield ".TP"
        names = ", ".join(map(_bold, action.option_strings))
        value = _argument(action) if action.nargs != 0 else ""
        if action.option_strings and action.nargs == "?":
            value = f"[{value}]"
        yield f"{names} {_italic(value)}".strip() if value else names
        yield _plain(_help(action, command)) or r"\&"


def _positional(action: argparse.Action) -> str:
    """Return an argument as a synopsis has it: whether it may be left out, or be several."""
    name = _argument(action)
    return {"*": f"[{name} ...]", "+": f"{name} ...", "?": f"[{name}]"}.get(action.nargs, name)


def _argument(action: argparse.Action) -> str:
    """Return the name of a value, such as FILE, or a choice of words."""
    if action.metavar is None:
        return _choices(action) if _are_few(action) else action.dest.upper()
    return action.metavar if isinstance(action.metavar, str) else " ".join(action.metavar)


def _choices(action: argparse.Action) -> str:
    return "|".join(map(str, action.choices or ()))


def _are_few(action: argparse.Action) -> bool:
    """Whether the choices of an option have room beside its name."""
    return 0 < len(_choices(action)) <= LONGEST_CHOICES


def _help(action: argparse.Action, command: argparse.ArgumentParser | None) -> str:
    formatter = argparse.HelpFormatter(command.prog if command else "engine3d")
    text = " ".join(formatter._expand_help(action).split()) if action.help else ""
    if action.metavar is None and action.choices and not _are_few(action):
        return f"{text}. One of {', '.join(map(str, action.choices))}"
    return text


def _bold(text: str) -> str:
    return rf"\fB{_escaped(text)}\fR"


def _italic(text: str) -> str:
    return rf"\fI{_escaped(text)}\fR"


def _plain(text: str) -> str:
    """Return a line of text, which must not begin as a request."""
    escaped = _escaped(" ".join(text.split()))
    return rf"\&{escaped}" if escaped.startswith((".", "'")) else escaped


def _escaped(text: str) -> str:
    """Return a text whose signs show as they are: a minus that can be copied, no escapes."""
    signs = {"\\": r"\[rs]", "-": r"\-", "'": r"\[aq]", "`": r"\[ga]", "^": r"\[ha]", "~": r"\[ti]"}
    return "".join(signs.get(sign, sign) for sign in text).replace('"', r"\[dq]")

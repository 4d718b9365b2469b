"""``engine3d completion``: prints a shell script that completes commands, options and values.

In: the parser, which defines them all. Out: a script for bash, zsh, fish or PowerShell.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from . import SHELLS

FILE_METAVARS = ("FILE", "FILE|NAME", "MODEL", "IN", "OUT")


@dataclass
class Option:
    """An option, as needed for completion.

    ``value`` is None for a flag, ``"file"``, ``"free"``, or the words to choose from.
    """

    names: tuple[str, ...]
    help: str
    value: str | tuple[str, ...] | None
    optional: bool = False  # the value may be left out


@dataclass
class Command:
    """A command, its options, and the choices of its argument: none means files."""

    name: str
    help: str
    options: list[Option]
    words: tuple[str, ...] = ()


def completion(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    from ..parser import make_parser

    print("\n".join(SCRIPTS[args.shell](command_list(make_parser()))))
    return 0


def command_list(parser) -> list[Command]:
    """Return the commands; the first, without a name, holds the global options."""
    subparsers = next(a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    helps = {action.dest: action.help or "" for action in subparsers._choices_actions}
    commands = [Command("", "", _options(parser))]
    for name, command in parser.commands.items():
        words = [a.choices for a in command._actions if not a.option_strings and a.choices]
        commands.append(Command(name, helps[name], _options(command), *map(tuple, words)))
    return commands


def _options(parser: argparse.ArgumentParser) -> list[Option]:
    return [
        Option(tuple(a.option_strings), _plain(a.help), _value(a), a.nargs == "?")
        for a in parser._actions
        if a.option_strings
    ]


def _plain(text: str | None) -> str:
    return " ".join((text or "").replace("%%", "%").split())


def _value(action: argparse.Action) -> str | tuple[str, ...] | None:
    if action.nargs == 0:
        return None
    if action.choices:
        return tuple(map(str, action.choices))
    return "file" if action.metavar in FILE_METAVARS else "free"


# bash


def bash_script(listed: list[Command]) -> Iterator[str]:
    """Yield the lines of a script for bash."""
    first, *commands = listed
    names = " ".join(command.name for command in commands)
    yield "# engine3d completion for bash"
    yield "_engine3d() {"
    yield "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}"
    yield "    local words= files= command= index"
    yield "    for ((index = 1; index < COMP_CWORD; index++)); do"
    yield "        [[ ${COMP_WORDS[index]} == -* ]] || { command=${COMP_WORDS[index]}; break; }"
    yield "    done"
    yield '    case "$command $before" in'
    for command in commands:
        yield from _bash_values(command)
    yield '        *) case "$command" in'
    yield f'            "") words="{names} {_names(first)}" ;;'
    for command in commands:
        words = " ".join(filter(None, (_names(command), *command.words)))
        files = "" if command.words else "; files=1"
        yield f'            {command.name}) words="{words}"{files} ;;'
    yield "            *) files=1 ;;"
    yield "        esac ;;"
    yield "    esac"
    yield "    COMPREPLY=()"
    # Where there is no reply, bash itself completes files, which quotes their names.
    yield '    if [ -n "$files" ] && [[ $current != -* ]]; then return; fi'
    yield '    COMPREPLY=($(compgen -W "$words" -- "$current"))'
    yield "    compopt +o default 2>/dev/null"  # bash 3, of macOS, has none and offers files
    yield "}"
    yield "complete -o default -F _engine3d engine3d"


def _names(command: Command) -> str:
    return " ".join(name for option in command.options for name in option.names)


def _bash_values(command: Command) -> Iterator[str]:
    """Yield the completion of option values of a command."""
    for option in command.options:
        if option.value is None or option.optional:
            continue
        places = "|".join(f'"{command.name} {name}"' for name in option.names)
        words = " ".join(option.value) if isinstance(option.value, tuple) else ""
        reply = "files=1" if option.value == "file" else f'words="{words}"'
        yield f"        {places}) {reply} ;;"


# zsh


def zsh_script(listed: list[Command]) -> Iterator[str]:
    """Yield the lines of a script for zsh."""
    first, *commands = listed
    yield "#compdef engine3d"
    yield "_engine3d() {"
    yield "    local -a commands"
    yield "    while (( CURRENT > 2 )) && [[ $words[2] == -* ]]; do"  # options before the command
    yield "        shift words"
    yield "        (( CURRENT-- ))"
    yield "    done"
    yield "    commands=("
    for command in commands:
        yield f"        {_quoted(command.name + ':' + command.help)}"
    yield "    )"
    yield "    if (( CURRENT == 2 )); then"
    yield "        _describe command commands"
    yield from _zsh_arguments(first, "        ")
    yield "        return"
    yield "    fi"
    yield "    local command=$words[2]"
    yield "    shift words"
    yield "    (( CURRENT-- ))"
    yield "    case $command in"
    for command in commands:
        yield f"        {command.name})"
        yield from _zsh_arguments(command, "            ")
        yield "            ;;"
    yield "    esac"
    yield "}"
    # A file in $fpath runs as the function's first call; a sourced one only defines it.
    yield 'if [ "$funcstack[1]" = _engine3d ]; then'
    yield '    _engine3d "$@"'
    yield "else"
    yield "    compdef _engine3d engine3d"
    yield "fi"


def _zsh_arguments(command: Command, indent: str) -> Iterator[str]:
    yield f"{indent}_arguments \\"
    for option in command.options:
        for name in option.names:
            yield f"{indent}    {_quoted(name + _zsh_value(option))} \\"
    if command.name:
        words = f":({' '.join(command.words)})" if command.words else ":_files"
        yield f"{indent}    {_quoted('*:argument' + words)}"
    else:
        yield ""


def _zsh_value(option: Option) -> str:
    text = option.help.replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]")
    text = f"[{text.replace(':', chr(92) + ':')}]"
    if option.value is None:
        return text
    colon = "::" if option.optional else ":"
    if isinstance(option.value, tuple):
        return f"{text}{colon}value:({' '.join(option.value)})"
    return f"{text}{colon}value:" + ("_files" if option.value == "file" else " ")


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"


# fish


def fish_script(listed: list[Command]) -> Iterator[str]:
    """Yield the lines of a script for fish."""
    first, *commands = listed
    yield "# engine3d completion for fish"
    yield "complete -c engine3d -e"
    for option in first.options:
        yield f"complete -c engine3d -n __fish_use_subcommand {_fish_option(option)}"
    for command in commands:
        text = _quoted(command.help)
        yield f"complete -c engine3d -n __fish_use_subcommand -f -a {command.name} -d {text}"
    for command in commands:
        place = f"complete -c engine3d -n '__fish_seen_subcommand_from {command.name}'"
        for option in command.options:
            yield f"{place} {_fish_option(option)}"
        if command.words:
            yield f"{place} -f -a '{' '.join(command.words)}'"


def _fish_option(option: Option) -> str:
    names = [
        f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names
    ]
    parts = [*names, "-d", _quoted(option.help)]
    if isinstance(option.value, tuple):
        parts += ["-f" if option.optional else "-x", "-a", _quoted(" ".join(option.value))]
    elif option.value is not None:
        parts += ["-r" if option.value == "file" else "-x"]
    return " ".join(parts)


# PowerShell


def powershell_script(listed: list[Command]) -> Iterator[str]:
    """Yield the lines of a script for PowerShell, which itself adds files where there are none."""
    first, *commands = listed
    names = (command.name for command in commands)
    yield "# engine3d completion for PowerShell"
    yield "Register-ArgumentCompleter -Native -CommandName engine3d -ScriptBlock {"
    yield "    param($word, $line)"
    yield "    $before = @($line.CommandElements | ForEach-Object { $_.ToString() })"
    yield "    if ($word) { $before = @($before | Select-Object -SkipLast 1) }"
    yield "    $rest = @($before | Select-Object -Skip 1)"
    yield "    $command = $rest | Where-Object { -not $_.StartsWith('-') } | Select-Object -First 1"
    yield "    $words = if (-not $command) {"
    yield f"        {_powershell_list([*names, *_names(first).split()])}"
    yield "    } else {"
    yield '        switch -CaseSensitive ($command + " " + $before[-1]) {'
    for command in commands:
        yield from _powershell_values(command)
    yield "            default {"
    yield "                switch -CaseSensitive ($command) {"
    for command in commands:
        options = _powershell_list(_names(command).split())
        words = _powershell_list(command.words)
        choice = f"if ($word.StartsWith('-')) {{ {options} }} else {{ {words} }}"
        yield f"                    {_powershell_quoted(command.name)} {{ {choice} }}"
    yield "                }"
    yield "            }"
    yield "        }"
    yield "    }"
    yield "    $words | Where-Object { $_ -and $_.StartsWith($word) }"
    yield "}"


def _powershell_values(command: Command) -> Iterator[str]:
    """Yield the completion of option values of a command."""
    for option in command.options:
        if option.value is None or option.optional:
            continue
        words = option.value if isinstance(option.value, tuple) else ()
        for name in option.names:
            place = _powershell_quoted(f"{command.name} {name}")
            yield f"            {place} {{ {_powershell_list(words)} }}"


def _powershell_list(words: Iterable[str]) -> str:
    return ", ".join(map(_powershell_quoted, words))


def _powershell_quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


_SCRIPTS = (bash_script, zsh_script, fish_script, powershell_script)
SCRIPTS = dict(zip(SHELLS, _SCRIPTS, strict=True))

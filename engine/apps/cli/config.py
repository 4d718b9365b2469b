"""Options in files: the user's own config, and files of ``--config``.

In: JSON, a list of entries: ``{"files": "*.stl", "options": {"up": "+Z"}}``. Out: new defaults for
a command's options. An entry without ``files`` applies to all; later entries override earlier ones,
``-D`` overrides entries, and the command line overrides all.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from ...base.near_words import meant
from ...errors import FileFormatError
from ..desktop.user_folders import user_path
from .options.scene_options import OF_MODELS
from .plugin_switch import NO_PLUGINS
from .short_help import WHOLE
from .usage import UsageError

# Options about config files, or that end the program, are allowed only on the command line.
_NOT_HERE = frozenset(
    {"config", "no-config", "define", "help", *(one[2:] for one in (WHOLE, NO_PLUGINS))}
)
_LARGEST = 1 << 20  # bytes
_ENTRY = frozenset({"files", "options"})
# Options that contradict each other: the later one of a pair wins.
_RIVALS = (
    *(("background_gradient", other) for other in ("background_color", "no_background")),
    *(("background", other) for other in ("background_color", "no_background")),
    ("background", "background_gradient"),
    ("fog", "fog_density"),
    ("light_position", "light_direction"),
    ("unlit", "mode"),
    ("edges", "wireframe"),
)
_DEFINED, _TYPED = 1 << 20, 1 << 21  # positions of -D and the command line, after all entries


def add_config(parser) -> None:
    """Add the options that name config files."""
    group = parser.add_argument_group("options in files")
    group.add_argument(
        "--config",
        metavar="FILE",
        help="read options from this JSON file, instead of that of the user's own",
    )
    group.add_argument("--no-config", action="store_true", help="read options from no file")
    group.add_argument(
        "-D",
        "--define",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="set an option as a file would: -D grid=true, -D grid=false",
    )


def set_defaults(
    command: argparse.ArgumentParser,
    said: Sequence[Said],
    args: argparse.Namespace,
    models: Sequence[str],
    all_commands: Callable[[], Iterable[argparse.ArgumentParser]],
) -> None:
    """Set options from files and ``-D`` as defaults of a command.

    Parameters
    ----------
    command : ArgumentParser
    said : sequence of Said
        As of `options_in_files`; options that only other commands have are passed over.
    args : Namespace
        What was parsed before.
    models : sequence of str
        The files to be shown.
    all_commands : callable
        Returns all commands: one of them must have each option that a file names.

    Raises
    ------
    FileFormatError
        A file says what it may not.
    UsageError
        ``-D`` does.
    """
    options = _options(command)
    usual = {action.dest: command.get_default(action.dest) for action in options.values()}
    said_at: dict[str, int] = {}  # position of the last entry with an option
    for path, number, name, value in said:
        place = f"[{number}].options.{name}"
        if name not in options:
            _check_is_known(name, all_commands(), place, path)
        elif models or options[name].dest not in OF_MODELS:
            said_at[options[name].dest] = number
            try:
                _set(command, options[name], value)
            except ValueError as error:
                raise FileFormatError(f"{place}: {error}", path) from None
    for text in args.define:
        name, equals, value = text.partition("=")
        name = name.removeprefix("--")
        if not equals or name not in options:
            listed = f" (engine3d {args.command} {WHOLE} lists them)"
            hint = meant(name, options) or listed
            if not equals:
                raise UsageError(f"-D {text}: NAME=VALUE is needed, such as grid=true")
            raise UsageError(f"-D {text}: there is no option {name!r}{hint}")
        said_at[options[name].dest] = _DEFINED
        try:
            given = {"true": True, "false": False}.get(value, value)
            _set(command, options[name], given)
        except ValueError as error:
            raise UsageError(f"-D {text}: {error}") from None
    typed = {name: _TYPED for name, value in usual.items() if getattr(args, name) != value}
    _give_way(command, usual, said_at | typed)


def _check_is_known(
    name: str, commands: Iterable[argparse.ArgumentParser], place: str, path: str
) -> None:
    """Raise unless some command has an option with this name."""
    known = {one for command in commands for one in _options(command)}
    if name not in known:
        hint = meant(name, known) or f"; engine3d render {WHOLE} lists them"
        raise FileFormatError(f"{place}: there is no such option{hint}", path)


def _give_way(
    command: argparse.ArgumentParser, usual: dict[str, object], said_at: dict[str, int]
) -> None:
    """Remove earlier options that a later one contradicts."""
    for pair in _RIVALS:
        places = [said_at.get(name, -1) for name in pair]
        if -1 not in places and places[0] != places[1]:
            earlier = pair[places[0] > places[1]]
            command.set_defaults(**{earlier: usual[earlier]})


def _options(command: argparse.ArgumentParser) -> dict[str, argparse.Action]:
    """Return the options of a command by their long names."""
    found = {}
    for action in command._actions:
        names = [option[2:] for option in action.option_strings if option.startswith("--")]
        if isinstance(action, argparse.BooleanOptionalAction):
            names = [name for name in names if not name.startswith("no-")]
        found |= {name: action for name in names if name not in _NOT_HERE}
    return found


def _set(command: argparse.ArgumentParser, action: argparse.Action, value) -> None:
    """Set a value as the default of an option.

    Raises
    ------
    ValueError
        The option takes no such value.
    """
    if isinstance(value, bool) and (action.nargs in (0, "?")):
        on = action.const if action.const is not None else True
        off = False if action.const is True else None
        if isinstance(action, argparse.BooleanOptionalAction):
            on, off = True, False
        command.set_defaults(**{action.dest: on if value else off})
        return
    if isinstance(value, bool) or action.nargs == 0:
        raise ValueError(f"{str(value).lower()} is no value of it")
    words = value if isinstance(value, list) else [value]
    if any(isinstance(word, bool) or not isinstance(word, str | int | float) for word in words):
        raise ValueError("a text, a number or a list of them is needed")
    words = [word if isinstance(word, str) else repr(word) for word in words]
    if isinstance(action.nargs, int):
        if len(words) != action.nargs:
            raise ValueError(f"{action.nargs} values are needed")
        parsed = [_parsed(command, action, word) for word in words]
    else:
        parsed = _parsed(command, action, ",".join(words))
    command.set_defaults(**{action.dest: parsed})


def _parsed(command: argparse.ArgumentParser, action: argparse.Action, text: str):
    """Return the value that a word on the command line would give."""
    try:
        value = command._get_value(action, text)
        command._check_value(action, value)
    except argparse.ArgumentError as error:
        raise ValueError(error.message) from None
    return value


class Said(NamedTuple):
    """An option in a file: its position, name and value."""

    path: str
    number: int
    name: str
    value: object


def options_in_files(args: argparse.Namespace, models: Sequence[str]) -> list[Said]:
    """Return all options that apply to the models.

    Raises
    ------
    FileFormatError, FileAccessError
        The file cannot be read, or holds something else.
    """
    path = args.config or str(user_path("config", "config.json"))
    if args.no_config or (args.config is None and not os.path.isfile(path)):
        return []
    found = []
    for number, entry in enumerate(_read(path)):
        place = f"[{number}]"
        if not isinstance(entry, dict) or not isinstance(entry.get("options"), dict):
            raise FileFormatError(f'{place}: an object with "options" is needed', path)
        if wrong := entry.keys() - _ENTRY:
            raise FileFormatError(f"{place}.{min(wrong)}: there is no such key", path)
        if _counts(entry.get("files"), models, place, path):
            found += [Said(path, number, *option) for option in entry["options"].items()]
    return found


def said_for_all(name: str) -> Said | None:
    """Return what the user's own file says last of an option, for whatever is shown; or None.

    Raises
    ------
    FileFormatError, FileAccessError
        The file cannot be read, or holds something else.
    """
    asked = argparse.Namespace(config=None, no_config=False)
    said = [one for one in options_in_files(asked, ()) if one.name == name]
    return said[-1] if said else None


def _counts(patterns, models: Sequence[str], place: str, path: str) -> bool:
    """Return whether an entry applies to a model, by its name or the end of its path."""
    if patterns is None:
        return True
    patterns = [patterns] if isinstance(patterns, str) else patterns
    if not isinstance(patterns, list) or not all(isinstance(one, str) for one in patterns):
        raise FileFormatError(f"{place}.files: a pattern or a list of patterns is needed", path)
    import fnmatch

    names = [model.replace(os.sep, "/").lower() for model in models]
    return any(
        fnmatch.fnmatchcase(name if "/" in pattern else name.rpartition("/")[2], pattern.lower())
        for pattern in patterns
        for name in names
    )


def _read(path: str) -> list:
    from ...base.files.json_records import parsed, read_small

    tree = parsed(read_small(path, _LARGEST, regular=False), path)
    if not isinstance(tree, list):
        raise FileFormatError("a list of entries is needed", path)
    return tree

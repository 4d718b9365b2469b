"""The parser of the command line: its commands, each with the options of its file.

A command's module is imported only when it runs, so that ``--help`` is quick.
"""

from __future__ import annotations

import argparse
import functools
import importlib
from collections.abc import Sequence

from ..demos import SCENES, WORKLOAD_NAMES
from ..version import __version__
from . import (
    batch_options,
    bench_options,
    city_options,
    config,
    convert_options,
    diff_options,
    input_options,
    learn_options,
    options,
    render_options,
    run_options,
    scene_options,
    sheet_options,
    suggestions,
    values,
)
from .joined_values import join_values
from .suggestions import Parser
from .usage import UsageError


def parse(arguments: list[str]) -> argparse.Namespace:
    """Return what the arguments say.

    Raises `UsageError`, or `SystemExit` after argparse has printed its line.
    """
    args = _parsed(arguments, make_parser())
    if "define" not in args:
        return args

    def configured(models: Sequence[str]) -> argparse.Namespace:
        parser = make_parser()
        is_changed = config.set_defaults(parser.commands, args, models)
        found = _parsed(arguments, parser) if is_changed else args
        found.configured = configured
        return found

    return configured(args.models)


def _parsed(arguments: list[str], parser: Parser) -> argparse.Namespace:
    args, unknown = parser.parse_known_args(join_values(arguments))
    # Of positional arguments with options between them argparse takes only the first ones.
    files = getattr(args, "models", None) or getattr(args, "pictures", None)
    if files and not any(_is_option(argument) for argument in unknown):
        files += unknown
        unknown = []
    if unknown:
        program = " ".join(filter(None, ("engine3d", args.command)))
        command = parser.commands.get(args.command, parser)
        wrong = next(filter(_is_option, unknown), "").partition("=")[0]
        hint = suggestions.option_meant(wrong, command)
        message = f"unknown arguments: {' '.join(unknown)}{hint}"
        raise UsageError(f"{message} (see {program} --help)")
    return args


def _is_option(argument: str) -> bool:
    return argument.startswith("-") and argument != "-"


def make_parser() -> Parser:
    """Return the parser; ``load_command()`` of what it parsed returns the command's function."""
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
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", dest="command")
    _add_run(commands)
    _add_edit(commands)
    _add_render(commands)
    _add_info(commands)
    _add_diff(commands)
    _add_sheet(commands)
    _add_convert(commands)
    _add_batch(commands)
    _add_city(commands)
    _add_learn(commands)
    _add_bench(commands)
    _add_completion(commands, parser)
    parser.commands = commands.choices
    for name in ("run", "edit", "render", "info", "sheet", "diff", "convert", "batch", "city"):
        options.add_quiet(commands.choices[name])
    return parser


def _add_run(commands) -> None:
    command = _add(
        commands,
        "run",
        help="show a model or a scene in a window",
        description="Show a model or a scene in a window. H in the window lists the keys.",
    )
    scene_options.add_viewed_scene(command)
    run_options.add_run(command)
    options.add_shared(command)


def _add_edit(commands) -> None:
    command = _add(
        commands,
        "edit",
        help="put a scene together in a window with panels",
        description="Open the editor: a window with panels for the tree of nodes, the scene, what "
        "nodes are made of, and a console. It needs pip install 'engine3d[editor]'.",
    )
    command.add_argument("model", metavar="FILE", nargs="?", help="the file to edit, of any format")
    command.add_argument(
        "--resolution",
        type=values.resolution,
        metavar="WxH",
        help="size of the window in pixels; 1600x900 by default",
    )


def _add_render(commands) -> None:
    command = _add(
        commands,
        "render",
        help="draw a model or a scene to a file",
        description="Draw a model or a scene to a picture (PNG, JPEG, TGA, WebP) or, with "
        "--turntable, to an animation (GIF, WebP, APNG).",
    )
    scene_options.add_viewed_scene(command)
    render_options.add_render(command)
    options.add_shared(command)


def _add_info(commands) -> None:
    command = _add(
        commands,
        "info",
        help="print what model files hold, or what a report of a bug should say",
        description="Print the lists that model files hold, their bounds and their warnings; or, "
        "with --system, what a report of a bug should say of the machine and the installation.",
    )
    command.add_argument(
        "models", metavar="MODEL", nargs="*", help="the files; - for standard input"
    )
    command.add_argument(
        "--system",
        action="store_true",
        help="print the processor, backends, versions of packages, SDL and the locale instead; "
        "names of users and machines, and paths, are not in it",
    )
    command.add_argument(
        "--json", action="store_true", help="print JSON: a list where there are several files"
    )
    input_options.add_root(command)


def _add_diff(commands) -> None:
    command = _add(
        commands,
        "diff",
        help="compare pictures, or folders of them",
        description="Compare two pictures, or the pictures of two folders: what was drawn with "
        "what it should be. Exit status 1 if one changed. Options are those of reg-cli.",
    )
    diff_options.add_diff(command)


def _add_sheet(commands) -> None:
    command = _add(
        commands,
        "sheet",
        help="draw a model from several sides, with dimensions and a report",
        description="Draw models from several sides on one sheet (PNG), with dimensions, axes and "
        "a scale, and report as JSON what shows where and how pixels and the world are related.",
    )
    sheet_options.add(command)


def _add_convert(commands) -> None:
    command = _add(
        commands,
        "convert",
        help="write a model in another format",
        description="Write a model as OBJ (with MTL), PLY or STL; the extension of OUT decides. A "
        "warning names what that format cannot hold. Coordinates do not change, whichever axis is "
        "up.",
    )
    convert_options.add(command)


def _add_batch(commands) -> None:
    command = _add(
        commands,
        "batch",
        help="draw many pictures, or a data set, with many processes",
        description="Draw the pictures that a manifest lists (docs/batches.md tells its format), "
        "with many processes. A picture is there whole or not at all. Ends with status 1 if some "
        "could not be drawn; they are listed at the end.",
    )
    batch_options.add(command)


def _add_city(commands) -> None:
    command = _add(
        commands,
        "city",
        help="generate a city and write it as a model",
        description="Generate a city and write it as OBJ (with MTL), PLY or STL; the extension of "
        "OUT decides. The same options give the same bytes on every machine.",
    )
    city_options.add(command)


def _add_learn(commands) -> None:
    command = _add(
        commands,
        "learn",
        help="show how a 3D engine works, lesson by lesson",
        description="Show the lessons of the course in a window, step by step. Each is a short "
        "program that draws as a student would. Right and left arrow go from step to step, N and P "
        "from lesson to lesson, Q leaves.",
    )
    learn_options.add(command)


def _add_bench(commands) -> None:
    command = _add(
        commands,
        "bench",
        help="measure how fast this machine draws",
        description="Measure how fast this machine draws, stage by stage. The scenes are\n"
        "generated; nothing is downloaded. Scripts of the source distribution, in\n"
        "benchmarks/, draw charts of the results and compare with Mesa's llvmpipe.",
        epilog="\n  ".join(
            ["workloads:", *(f"{one:<15} {SCENES[one].about}" for one in WORKLOAD_NAMES)]
        ),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    bench_options.add(command)


def _add_completion(commands, parser: Parser) -> None:
    command = _add(
        commands,
        "completion",
        help="print what lets a shell complete commands and options",
        description="Print a script for a shell. To try it: source <(engine3d completion bash), "
        "the same with zsh, or engine3d completion fish | source.",
    )
    command.set_defaults(parser=parser)
    command.add_argument("shell", choices=("bash", "zsh", "fish"), help="which shell")


def _missing_command():
    raise UsageError(
        "say which command: run, edit, render, info, sheet, diff, convert, batch, city, learn, "
        "bench or completion (see engine3d --help)"
    )


def _add(commands, name: str, **texts) -> argparse.ArgumentParser:
    """Add a command; the function that runs it has its name, in the module of that name."""
    command = commands.add_parser(name, allow_abbrev=False, **texts)
    command.set_defaults(load_command=functools.partial(_load, name))
    return command


def _load(command: str):
    return getattr(importlib.import_module(f".{command}", __package__), command)


class _ListReaders(argparse.Action):
    """Print the formats and stop, as ``--version`` does."""

    def __call__(self, parser, namespace, values, option_string=None):
        from .readers import list_readers

        list_readers()
        parser.exit()

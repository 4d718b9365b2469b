"""The parser of the command line: commands, and where the functions are that run them.

A command's module is imported only when it runs, so that ``--help`` is quick.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ..benchmarking.names import WORKLOADS
from ..version import __version__
from . import (
    ambient_options,
    backdrop_options,
    config,
    diff_options,
    environment_options,
    light_options,
    options,
    scalar_options,
    sheet_options,
    suggestions,
    tone_options,
    values,
)
from .suggestions import Parser
from .usage import UsageError

MODEL_FORMATS = ("glb", "gltf", "obj", "ply", "stl")
LANGUAGES = ("en", "fr")


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
    args, unknown = parser.parse_known_args(options.join_values(arguments))
    # Of positional arguments with options between them argparse takes only the first ones.
    files = getattr(args, "models", None) or getattr(args, "pictures", None)
    if files and not any(_is_option(argument) for argument in unknown):
        files += unknown
        unknown = []
    if unknown:
        program = " ".join(filter(None, ("engine3d", args.command)))
        command = parser.commands.get(args.command, parser)
        wrong = next(filter(_is_option, unknown), "").partition("=")[0]
        hint = suggestions.meant(wrong, suggestions.option_strings(command))
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
    command = commands.add_parser(
        "run",
        help="show a model or a scene in a window",
        description="Show a model or a scene in a window. H in the window lists the keys.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_run)
    options.add_viewed_scene(command)
    options.add_run(command)
    _add_shared(command)


def _add_edit(commands) -> None:
    command = commands.add_parser(
        "edit",
        help="put a scene together in a window with panels",
        description="Open the editor: a window with panels for the tree of nodes, the scene, what "
        "nodes are made of, and a console. It needs pip install 'engine3d[editor]'.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_edit)
    command.add_argument("model", metavar="FILE", nargs="?", help="the file to edit, of any format")
    command.add_argument(
        "--resolution",
        type=values.resolution,
        metavar="WxH",
        help="size of the window in pixels; 1600x900 by default",
    )


def _add_render(commands) -> None:
    command = commands.add_parser(
        "render",
        help="draw a model or a scene to a file",
        description="Draw a model or a scene to a picture (PNG, JPEG, TGA, WebP) or, with "
        "--turntable, to an animation (GIF, WebP, APNG).",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_render)
    options.add_viewed_scene(command)
    options.add_render(command)
    _add_shared(command)


def _add_shared(command) -> None:
    config.add_config(command)
    options.add_picture(command)
    options.add_appearance(command)
    light_options.add_light(command)
    ambient_options.add_ambient(command)
    environment_options.add_environment(command)
    backdrop_options.add_backdrop(command)
    tone_options.add_tone(command)
    scalar_options.add_scalars(command)
    options.add_camera(command)


def _add_info(commands) -> None:
    command = commands.add_parser(
        "info",
        help="print what model files hold",
        description="Print the lists that model files hold, their bounds and their warnings.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_info)
    command.add_argument(
        "models", metavar="MODEL", nargs="+", help="the files; - for standard input"
    )
    command.add_argument(
        "--json", action="store_true", help="print JSON: a list where there are several files"
    )


def _add_diff(commands) -> None:
    command = commands.add_parser(
        "diff",
        help="compare pictures, or folders of them",
        description="Compare two pictures, or the pictures of two folders: what was drawn with "
        "what it should be. Exit status 1 if one changed. Options are those of reg-cli.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_diff)
    diff_options.add_diff(command)


def _add_sheet(commands) -> None:
    command = commands.add_parser(
        "sheet",
        help="draw a model from several sides, with dimensions and a report",
        description="Draw models from several sides on one sheet (PNG), with dimensions, axes and "
        "a scale, and report as JSON what shows where and how pixels and the world are related.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_sheet)
    sheet_options.add(command)


def _add_convert(commands) -> None:
    command = commands.add_parser(
        "convert",
        help="write a model in another format",
        description="Write a model as OBJ (with MTL), PLY or STL; the extension of OUT decides. A "
        "warning names what that format cannot hold. Coordinates do not change, whichever axis is "
        "up.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_convert)
    command.add_argument(
        "model", metavar="IN", help="the file to read, of any format; - for standard input"
    )
    command.add_argument(
        "output", metavar="OUT", nargs="?", help="the file to write; - for standard output"
    )
    command.add_argument(
        "-o", "--output", dest="output_option", metavar="OUT", help="another way to say OUT"
    )
    command.add_argument(
        "--format",
        choices=MODEL_FORMATS,
        help="what to write whatever the extension; OBJ with materials is several files, and does "
        "not go to standard output",
    )
    command.add_argument("--ascii", action="store_true", help="write PLY and STL as text")


def _add_batch(commands) -> None:
    command = commands.add_parser(
        "batch",
        help="draw many pictures, or a data set, with many processes",
        description="Draw the pictures that a manifest lists (docs/batches.md tells its format), "
        "with many processes. A picture is there whole or not at all. Ends with status 1 if some "
        "could not be drawn; they are listed at the end.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_batch)
    command.add_argument("manifest", metavar="FILE", help="the manifest, a file of JSON")
    command.add_argument(
        "-o", "--output", metavar="FOLDER", required=True, help="the folder to write to; is made"
    )
    command.add_argument(
        "--resume",
        action="store_true",
        help="leave out pictures that are there, made of what models, scripts and the manifest "
        "hold now",
    )
    who = command.add_mutually_exclusive_group()
    who.add_argument(
        "--jobs",
        type=values.count,
        metavar="N",
        help="number of processes; by default one per available CPU",
    )
    who.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="let the workers of a Dask scheduler draw, tcp://HOST:PORT; needs "
        "pip install 'engine3d[dask]'",
    )
    command.add_argument(
        "--timeout",
        type=values.positive,
        metavar="SECONDS",
        help="how long a picture may take; its process is ended then, and the picture has failed",
    )
    command.add_argument(
        "--backend",
        choices=options.BACKENDS,
        default="auto",
        help="instruction set to draw with; auto is the fastest. All give the same pictures",
    )
    command.add_argument(
        "--threads",
        type=values.thread_count,
        default=0,
        metavar="N",
        help="number of threads of each process; 0, the default, shares the CPUs out",
    )


def _add_city(commands) -> None:
    command = commands.add_parser(
        "city",
        help="generate a city and write it as a model",
        description="Generate a city and write it as OBJ (with MTL), PLY or STL; the extension of "
        "OUT decides. The same options give the same bytes on every machine.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_city)
    command.add_argument("output", metavar="OUT", help="the file to write")
    command.add_argument(
        "--triangles",
        type=values.city_triangles,
        default=1_000_000,
        metavar="N",
        help="about how many triangles, 20,000 to 50,000,000; a million by default",
    )
    command.add_argument(
        "--seed",
        type=values.integer,
        default=0,
        metavar="N",
        help="each number gives another city; 0 by default",
    )


def _add_learn(commands) -> None:
    command = commands.add_parser(
        "learn",
        help="show how a 3D engine works, lesson by lesson",
        description="Show the lessons of the course in a window, step by step. Each is a short "
        "program that draws as a student would. Right and left arrow go from step to step, N and P "
        "from lesson to lesson, Q leaves.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_learn)
    command.add_argument(
        "lesson",
        metavar="LESSON",
        nargs="?",
        default="1",
        help="its number or name, such as 3 or lines (default: 1)",
    )
    command.add_argument("--list", action="store_true", help="list the lessons")
    command.add_argument("--path", action="store_true", help="print where the program is")
    command.add_argument(
        "--language",
        choices=LANGUAGES,
        help="of titles and captions (default: French where the locale is, else English)",
    )
    command.add_argument(
        "-o",
        "--output",
        metavar="FOLDER",
        help="write the lesson's pictures to a folder instead of opening a window",
    )


def _add_bench(commands) -> None:
    names = tuple(WORKLOADS)
    command = commands.add_parser(
        "bench",
        help="measure how fast this machine draws",
        description="Measure how fast this machine draws, stage by stage. The scenes are\n"
        "generated; nothing is downloaded. Scripts of the source distribution, in\n"
        "benchmarks/, draw charts of the results and compare with Mesa's llvmpipe.",
        epilog="\n  ".join(["workloads:", *(f"{one:<15} {WORKLOADS[one]}" for one in names)]),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_bench)
    command.add_argument(
        "--workloads",
        type=values.some_of(names),
        default=list(names),
        metavar="NAME,…",
        help="workloads to measure (default: all of those below)",
    )
    command.add_argument(
        "--backends",
        type=values.some_of((*options.BACKENDS, "all")),
        default=["auto"],
        metavar="NAME,…",
        help="all, or some of " + ", ".join(options.BACKENDS) + " (default: auto, the fastest)",
    )
    command.add_argument(
        "--threads",
        type=values.thread_counts,
        metavar="N,…",
        help="numbers of threads to measure with; 0 is one per available CPU (default: 1,0)",
    )
    command.add_argument(
        "--resolution",
        type=values.resolution,
        default=(1920, 1080),
        metavar="WxH",
        help="size in pixels (default: 1920x1080)",
    )
    command.add_argument(
        "--seconds",
        type=values.positive,
        default=45.0,
        metavar="N",
        help="about how long to measure in all; slow frames may take longer (default: 45)",
    )
    command.add_argument(
        "--json", metavar="FILE", help="write the results as JSON; - for standard output"
    )


def _add_completion(commands, parser: Parser) -> None:
    command = commands.add_parser(
        "completion",
        help="print what lets a shell complete commands and options",
        description="Print a script for a shell. To try it: source <(engine3d completion bash), "
        "the same with zsh, or engine3d completion fish | source.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_completion, parser=parser)
    command.add_argument("shell", choices=("bash", "zsh", "fish"), help="which shell")


def _missing_command():
    raise UsageError(
        "say which command: run, edit, render, info, sheet, diff, convert, batch, city, learn, "
        "bench or completion (see engine3d --help)"
    )


def _load_run():
    from .run import run

    return run


def _load_edit():
    from .edit import edit

    return edit


def _load_render():
    from .render import render

    return render


def _load_info():
    from .info import info

    return info


def _load_diff():
    from .diff import diff

    return diff


def _load_sheet():
    from .sheet import sheet

    return sheet


def _load_convert():
    from .convert import convert

    return convert


def _load_batch():
    from .batch import batch

    return batch


def _load_city():
    from .city import city

    return city


def _load_learn():
    from .learn import learn

    return learn


def _load_bench():
    from .bench import bench

    return bench


def _load_completion():
    from .completion import completion

    return completion


class _ListReaders(argparse.Action):
    """Print the formats and stop, as ``--version`` does."""

    def __call__(self, parser, namespace, values, option_string=None):
        from .readers import list_readers

        list_readers()
        parser.exit()

"""The parser of the command line: commands, and where the functions are that run them.

A command's module is imported only when it runs, so that ``--help`` is quick.
"""

from __future__ import annotations

import argparse

from ..benchmarking.names import WORKLOADS
from ..version import __version__
from . import options, values
from .usage import UsageError


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are a line, not lost below all the options that there are."""

    def error(self, message):
        self.exit(2, f"{self.prog}: error: {message} (see {self.prog} --help)\n")


def make_parser() -> argparse.ArgumentParser:
    """Return the parser; ``load_command()`` of what it parsed returns the command's function."""
    parser = _Parser(
        prog="engine3d",
        description="Draw 3D models on the CPU: in a window, or to a file where there is none.",
        epilog="engine3d COMMAND --help lists a command's options. To begin with: engine3d run.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"engine3d {__version__}")
    parser.set_defaults(load_command=_missing_command)
    parser.add_argument(
        "--list-readers", action=_ListReaders, nargs=0, help="print the formats that are read"
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", dest="command")
    _add_run(commands)
    _add_render(commands)
    _add_info(commands)
    _add_convert(commands)
    _add_city(commands)
    _add_bench(commands)
    return parser


def _add_run(commands) -> None:
    command = commands.add_parser(
        "run",
        help="show a model or a scene in a window",
        description="Show a model or a scene in a window. H in the window lists the keys.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_run)
    options.add_subject(command)
    options.add_run(command)
    _add_shared(command)


def _add_render(commands) -> None:
    command = commands.add_parser(
        "render",
        help="draw a model or a scene to a file",
        description="Draw a model or a scene to a picture (PNG, JPEG, TGA, WebP) or, with "
        "--turntable, to an animation (GIF, WebP, APNG).",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_render)
    options.add_subject(command)
    options.add_render(command)
    _add_shared(command)


def _add_shared(command) -> None:
    options.add_picture(command)
    options.add_look(command)
    options.add_light(command)
    options.add_camera(command)


def _add_info(commands) -> None:
    command = commands.add_parser(
        "info",
        help="print what a model file holds",
        description="Print the lists that a model file holds, its bounds and its warnings.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_info)
    command.add_argument("model", metavar="MODEL", help="the file; - for standard input")
    command.add_argument("--json", action="store_true", help="print JSON")


def _add_convert(commands) -> None:
    command = commands.add_parser(
        "convert",
        help="write a model in another format",
        description="Write a model as OBJ with MTL, PLY or STL, as the extension of OUT says. What "
        "that format does not hold is warned of. Coordinates stay as they are, whichever axis is "
        "up.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_convert)
    command.add_argument(
        "model", metavar="IN", help="the file to read, of any format; - for standard input"
    )
    command.add_argument("output", metavar="OUT", help="the file to write")
    command.add_argument("--ascii", action="store_true", help="write PLY and STL as text")


def _add_city(commands) -> None:
    command = commands.add_parser(
        "city",
        help="write a city of any size as a model",
        description="Write a city as OBJ with MTL, PLY or STL, as the extension of OUT says: the "
        "same bytes for the same numbers, on every machine.",
        allow_abbrev=False,
    )
    command.set_defaults(load_command=_load_city)
    command.add_argument("output", metavar="OUT", help="the file to write")
    command.add_argument(
        "--triangles",
        type=values.city_triangles,
        default=1_000_000,
        metavar="N",
        help="how many, about: 20,000 to 50,000,000; a million by default",
    )
    command.add_argument(
        "--seed", type=values.integer, default=0, metavar="N", help="another city for each"
    )


def _add_bench(commands) -> None:
    names = tuple(WORKLOADS)
    command = commands.add_parser(
        "bench",
        help="measure how fast this machine draws",
        description="Measure how fast this machine draws scenes made here, stage by stage.",
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
        help="what to draw (default: everything below)",
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
        help="numbers of threads, 0 for as many as there may be (default: 1,0)",
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
        help="about how long to take in all; few slow frames may take longer (default: 45)",
    )
    command.add_argument(
        "--against",
        choices=("llvmpipe",),
        help="draw the plain picture in turns with Mesa's llvmpipe; needs engine3d[bench] and Mesa",
    )
    command.add_argument("--json", metavar="FILE", help="write the figures; - for standard output")
    command.add_argument("--plot", metavar="FILE", help="draw a chart: SVG, PNG, JPEG or WebP")


def _missing_command():
    raise UsageError(
        "say which command: run, render, info, convert, city or bench (see engine3d --help)"
    )


def _load_run():
    from .run import run

    return run


def _load_render():
    from .render import render

    return render


def _load_info():
    from .info import info

    return info


def _load_convert():
    from .convert import convert

    return convert


def _load_city():
    from .city import city

    return city


def _load_bench():
    from .bench import bench

    return bench


class _ListReaders(argparse.Action):
    """Print the formats and stop, as ``--version`` does."""

    def __call__(self, parser, namespace, values, option_string=None):
        from .readers import list_readers

        list_readers()
        parser.exit()

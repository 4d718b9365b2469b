"""The commands, a row each: parser, help and completion follow.

A command is a function of its own name in the module of that name, which is imported only when it
runs, so that ``--help`` is quick.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import NamedTuple

from . import (
    batch_options,
    bench_options,
    city_options,
    convert_options,
    diff_options,
    input_options,
    learn_options,
    options,
    render_options,
    run_options,
    scene_options,
    sheet_options,
    values,
)


class Command(NamedTuple):
    """A row of the list.

    Attributes
    ----------
    help, description : str
        What the list of commands says, and what the command's own help begins with.
    options : tuple of callable
        Each adds options to the command's parser.
    quiet : bool
        Whether there are warnings that ``--quiet`` leaves out.
    """

    help: str
    description: str
    options: tuple[Callable[[argparse.ArgumentParser], None], ...]
    quiet: bool = True


def _add_edit(command: argparse.ArgumentParser) -> None:
    command.add_argument("model", metavar="FILE", nargs="?", help="the file to edit, of any format")
    command.add_argument(
        "--resolution",
        type=values.resolution,
        metavar="WxH",
        help="size of the window in pixels; 1600x900 by default",
    )


def _add_info(command: argparse.ArgumentParser) -> None:
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


def _add_completion(command: argparse.ArgumentParser) -> None:
    command.add_argument("shell", choices=("bash", "zsh", "fish"), help="which shell")


COMMANDS = {
    "run": Command(
        "show a model or a scene in a window",
        "Show a model or a scene in a window. H in the window lists the keys.",
        (scene_options.add_viewed_scene, run_options.add_run, options.add_shared),
    ),
    "edit": Command(
        "put a scene together in a window with panels",
        "Open the editor: a window with panels for the tree of nodes, the scene, what nodes are "
        "made of, and a console. It needs pip install 'engine3d[editor]'.",
        (_add_edit,),
    ),
    "render": Command(
        "draw a model or a scene to a file",
        "Draw a model or a scene to a picture (PNG, JPEG, TGA, WebP) or, with --turntable, to an "
        "animation (GIF, WebP, APNG).",
        (scene_options.add_viewed_scene, render_options.add_render, options.add_shared),
    ),
    "info": Command(
        "print what model files hold, or what a report of a bug should say",
        "Print the lists that model files hold, their bounds and their warnings; or, with "
        "--system, what a report of a bug should say of the machine and the installation.",
        (_add_info,),
    ),
    "diff": Command(
        "compare pictures, or folders of them",
        "Compare two pictures, or the pictures of two folders: what was drawn with what it should "
        "be. Exit status 1 if one changed. Options are those of reg-cli.",
        (diff_options.add_diff,),
    ),
    "sheet": Command(
        "draw a model from several sides, with dimensions and a report",
        "Draw models from several sides on one sheet (PNG), with dimensions, axes and a scale, and "
        "report as JSON what shows where and how pixels and the world are related.",
        (sheet_options.add,),
    ),
    "convert": Command(
        "write a model in another format",
        "Write a model as OBJ (with MTL), PLY or STL; the extension of OUT decides. A warning "
        "names what that format cannot hold. Coordinates do not change, whichever axis is up.",
        (convert_options.add,),
    ),
    "batch": Command(
        "draw many pictures, or a data set, with many processes",
        "Draw the pictures that a manifest lists (docs/batches.md tells its format), with many "
        "processes. A picture is there whole or not at all. Ends with status 1 if some could not "
        "be drawn; they are listed at the end.",
        (batch_options.add,),
    ),
    "city": Command(
        "generate a city and write it as a model",
        "Generate a city and write it as OBJ (with MTL), PLY or STL; the extension of OUT decides. "
        "The same options give the same bytes on every machine.",
        (city_options.add,),
    ),
    "learn": Command(
        "show how a 3D engine works, lesson by lesson",
        "Show the lessons of the course in a window, step by step. Each is a short program that "
        "draws as a student would. Right and left arrow go from step to step, N and P from lesson "
        "to lesson, Q leaves.",
        (learn_options.add,),
        quiet=False,
    ),
    "bench": Command(
        "measure how fast this machine draws",
        "Measure how fast this machine draws, stage by stage. The scenes are\n"
        "generated; nothing is downloaded. Scripts of the source distribution, in\n"
        "benchmarks/, draw charts of the results and compare with Mesa's llvmpipe.",
        (bench_options.add,),
        quiet=False,
    ),
    "completion": Command(
        "print what lets a shell complete commands and options",
        "Print a script for a shell. To try it: source <(engine3d completion bash), the same with "
        "zsh, or engine3d completion fish | source.",
        (_add_completion,),
        quiet=False,
    ),
}

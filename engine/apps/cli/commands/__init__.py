"""The table of commands, from which parser, help and completion are built.

A command is a function in the module of the same name, which is imported only to run it, so that
``--help`` is fast; its options' module is imported only on request. Commands that packages add are
rows beside these (`plugin_commands`).
"""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Callable
from typing import NamedTuple


class Command(NamedTuple):
    """A row of the table.

    Attributes
    ----------
    help, description : str
        What the list of commands says, and what the command's own help begins with.
    add : callable
        Adds the options to the command's parser.
    is_quiet : bool
        Whether there are warnings that may be left out.
    common : tuple of str
        The long options that ``--help`` shows, where it does not show all.
    """

    help: str
    description: str
    add: Callable[[argparse.ArgumentParser], None]
    is_quiet: bool = True
    common: tuple[str, ...] = ()


def _add_edit(command: argparse.ArgumentParser) -> None:
    from .. import config, values
    from ..options import language_options, window_options

    command.add_argument("model", metavar="FILE", nargs="?", help="the file to edit, of any format")
    command.add_argument(
        "--size",
        type=values.size,
        metavar="WxH",
        help="size of the window in pixels; 1600x900 by default, and more on a fine screen",
    )
    window_options.add_ui_scale(command)
    language_options.add(command)
    config.add_config(command)


def _add_info(command: argparse.ArgumentParser) -> None:
    from ..options import input_options

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
    input_options.add_robot(command)


#: Those that ``completion`` has a script for.
SHELLS = ("bash", "zsh", "fish", "powershell")


def _add_completion(command: argparse.ArgumentParser) -> None:
    command.add_argument("shell", choices=SHELLS, help="which shell")


def _add_plugins(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="print JSON: an object for each")


def _of_modules(*names: str) -> Callable[[argparse.ArgumentParser], None]:
    """Return a function that imports modules of options, and lets each add its own."""

    def add(command: argparse.ArgumentParser) -> None:
        for name in names:
            importlib.import_module(f"..options.{name}", __package__).add(command)

    return add


#: What people ask of a picture, in a window and in a file.
_OF_PICTURES = (
    *("--scene", "--texture", "--color", "--animation-time", "--output"),
    *("--size", "--look", "--samples", "--background-color", "--grid"),
    *("--mode", "--wireframe", "--edges", "--shadow", "--environment", "--exposure"),
    *("--scalar-coloring", "--bar", "--up"),
    *("--camera-azimuth-angle", "--camera-elevation-angle", "--camera-zoom-factor"),
)

COMMANDS = {
    "run": Command(
        "show a model or a scene in a window",
        "Show a model or a scene in a window. H in the window lists the keys.",
        _of_modules("scene_options", "run_options", "shared_options"),
        common=(*_OF_PICTURES, "--animate", "--camera", "--watch"),
    ),
    "edit": Command(
        "put a scene together in a window with panels",
        "Open the editor: a window with panels for the tree of nodes, the scene, what nodes are "
        "made of, and a console. It needs pip install 'engine3d[editor]'.",
        _add_edit,
    ),
    "render": Command(
        "draw a model or a scene to a file",
        "Draw a model or a scene to a picture (PNG, JPEG, TGA, WebP), as lines (SVG, PDF) or, with "
        "--turntable, to an animation (GIF, WebP, APNG).",
        _of_modules("scene_options", "render_options", "shared_options", "inspection_options"),
        common=(*_OF_PICTURES, "--turntable", "--animation", "--no-background"),
    ),
    "info": Command(
        "tell what model files hold, or what a report of a bug should say",
        "Count what the lists of model files hold, and print bounds and warnings; or, with "
        "--system, what a report of a bug should say of the machine and the installation.",
        _add_info,
    ),
    "diff": Command(
        "compare pictures, or folders of them",
        "Compare two pictures, or the pictures of two folders: what was drawn with what it should "
        "be. Exit status 1 if one changed. Options are those of reg-cli.",
        _of_modules("diff_options"),
    ),
    "sheet": Command(
        "draw a model from several sides, with dimensions and a report",
        "Draw models from several sides on one sheet (PNG), with dimensions, axes and a scale, and "
        "report as JSON what shows where and how pixels and the world are related. Or draw the "
        "lines of one model to scale (SVG, PDF).",
        _of_modules("sheet_options"),
    ),
    "convert": Command(
        "write a model in another format",
        "Write a model in the format that the extension of OUT names. A warning names what that "
        "format cannot hold. Coordinates do not change, whichever axis is up.",
        _of_modules("convert_options"),
    ),
    "batch": Command(
        "draw many pictures, or a data set, with many processes",
        "Draw the pictures that a manifest lists (docs/batches.md tells its format), with many "
        "processes. A picture is there whole or not at all. Ends with status 1 if some could not "
        "be drawn; they are listed at the end.",
        _of_modules("batch_options"),
    ),
    "city": Command(
        "generate a city and write it as a model",
        "Generate a city and write it in the format that the extension of OUT names. "
        "The same options give the same bytes on every machine.",
        _of_modules("city_options"),
    ),
    "learn": Command(
        "show how a 3D engine works, lesson by lesson",
        "Show the lessons of the course in a window, step by step: pictures, idea, code, something "
        "to play with, an exercise. H lists the keys. Where there is no screen, the lesson is "
        "written as a page of HTML.",
        _of_modules("learn_options"),
        is_quiet=False,
    ),
    "bench": Command(
        "measure how fast this machine draws",
        "Measure how fast this machine draws, stage by stage. The scenes are\n"
        "generated; nothing is downloaded. Scripts of the source distribution, in\n"
        "benchmarks/, draw charts of the results and compare with Mesa's llvmpipe.",
        _of_modules("bench_options"),
        is_quiet=False,
    ),
    "mcp": Command(
        "serve agents: pictures and measures by the Model Context Protocol",
        "Serve an agent by the Model Context Protocol on standard input and output: it loads "
        "models, draws them, asks what is where, measures, compares, edits. Clients start this "
        "command (docs/agents.md). It needs pip install 'engine3d[mcp]'.",
        _of_modules("mcp_options"),
        is_quiet=False,
    ),
    "plugins": Command(
        "list the packages that extend engine3d",
        "List what installed packages add to engine3d (docs/plugins.md): readers, writers, kinds "
        "of data sets, commands, scenes, looks; and whether each can be imported.",
        _add_plugins,
        is_quiet=False,
    ),
    "completion": Command(
        "print what lets a shell complete commands and options",
        "Print a script for a shell. To try it: source <(engine3d completion bash), the same with "
        "zsh, engine3d completion fish | source, or engine3d completion powershell | Out-String | "
        "Invoke-Expression.",
        _add_completion,
        is_quiet=False,
    ),
}


def shipped_names() -> set[str]:
    """Return the commands that engine3d itself has."""
    return set(COMMANDS)

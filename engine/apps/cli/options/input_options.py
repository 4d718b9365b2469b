"""The options of input: reader, size limit, several files together or one by one.

In: names of files and folders, as they were given, or - for standard input. Out: jobs, each of
which shows some of them; paths, or binary file objects, as `engine3d.loaders` take them.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Container, Sequence
from typing import BinaryIO, get_args

from ....base.files.portable_names import key_here
from ....choices import ShapesOf
from ....errors import FileAccessError, FileFormatError
from ....io.addresses.url_names import is_url
from .. import values
from ..output_templates import fill, names_the_model
from ..usage import UsageError

STANDARD_INPUT = "-"
_MEBIBYTE = 1 << 20
_SCENE = ".e3d.json"


def add_inputs(group) -> None:
    """Add the options of input."""
    group.add_argument(
        "--multi-file-mode",
        choices=("all", "single"),
        help="show several files all at once, or one by one: in a window with the arrow keys, in "
        "render a picture each. One by one where a folder is given, or -o names the model",
    )
    group.add_argument(
        "--recursive-dir-add",
        action="store_true",
        help="of a folder, take the models in folders below it, too",
    )
    group.add_argument(
        "--force-reader",
        metavar="NAME",
        help="read files as this format, whatever they are called; engine3d --list-readers has the "
        "names",
    )
    group.add_argument(
        "--max-size",
        type=values.positive,
        metavar="MIB",
        help="refuse files of more mebibytes than this",
    )
    add_root(group)
    add_robot(group)


def add_robot(group) -> None:
    """Add the options for robots."""
    group.add_argument(
        "--joint",
        type=values.joint,
        action="append",
        metavar="NAME=VALUE",
        help="where a joint of a robot (URDF) stands: radians, or degrees as in elbow=30deg; "
        "metres of one that slides; several numbers with commas. May be given several times",
    )
    group.add_argument(
        "--shapes",
        choices=get_args(ShapesOf),
        help="what shows the links of a robot: visual by default",
    )


def of_robot(args: argparse.Namespace) -> dict:
    """Return the given options of robots, as arguments for loading."""
    given = {} if args.joint is None else {"joints": dict(args.joint)}
    return given if args.shapes is None else {**given, "shapes": args.shapes}


def add_root(group) -> None:
    """Add the option for the folder of files that models name."""
    group.add_argument(
        "--root",
        metavar="FOLDER",
        help="read files that a model names, such as images in ../images, from this folder, too; "
        "by default they may be in the model's own folder alone",
    )


def jobs(args: argparse.Namespace) -> list[argparse.Namespace]:
    """Return the arguments of each picture or window: one for all files, or one for each.

    In a job, the models are files, and the output is a name without variables.
    """
    has_folder = any(os.path.isdir(name) for name in args.models)
    models = _expanded(args.models, args.recursive_dir_add) if has_folder else args.models
    output = getattr(args, "output", None)
    if not _is_one_by_one(args, has_folder):
        return [_job(args, models, output)]
    if len(models) > 1 and output is not None and not names_the_model(output):
        raise UsageError("-o for several models needs a variable, as in -o '{model}.png'")
    top = _common_folder(args.models)
    found: list[argparse.Namespace] = []
    taken: dict[str, str] = {}
    for name in models:
        job = _job(args, [name], output, taken, _folder_below(top, name))
        if job.output is not None:
            if (other := taken.get(key := key_here(job.output))) is not None:
                same = "" if other == job.output else f", as {other}"
                raise UsageError(
                    f"-o {output}: {job.output} would be written twice{same}; "
                    "add {folder} or {n}"
                )
            taken[key] = job.output
        found.append(job)
    return found


def _common_folder(names: Sequence[str]) -> str:
    """Return the innermost folder that contains all inputs; "" if there is none."""
    paths = [os.path.abspath(name) for name in names if name != STANDARD_INPUT]
    folders = [path if os.path.isdir(path) else os.path.dirname(path) for path in paths]
    try:
        return os.path.commonpath(folders)
    except ValueError:  # only standard input, or several drives
        return ""


def _folder_below(top: str, name: str) -> str:
    """Return a model's folder relative to `top`; "" for `top` itself."""
    if not top or name == STANDARD_INPUT:
        return ""
    folder = os.path.relpath(os.path.dirname(os.path.abspath(name)), top)
    return "" if folder == os.curdir else folder


def _is_one_by_one(args: argparse.Namespace, has_folder: bool) -> bool:
    if args.side_by_side:
        if args.multi_file_mode == "single":
            raise UsageError("--side-by-side does not go with --multi-file-mode single")
        return False
    if args.multi_file_mode is not None:
        return args.multi_file_mode == "single"
    return bool(args.models) and (has_folder or names_the_model(args.output))


def _job(
    args: argparse.Namespace,
    models: Sequence[str],
    output: str | None,
    taken: Container[str] = (),
    folder: str = "",
) -> argparse.Namespace:
    configured = getattr(args, "configured", None)
    job = args if configured is None else configured(models)
    job = argparse.Namespace(**vars(job))
    job.models = list(models)
    job.output = fill(output or job.output, _title(job), taken, folder)
    return job


def _title(args: argparse.Namespace) -> str:
    """Return the model's name for the variables of an output."""
    if not args.models:
        return args.scene or "default"
    return args.models[0] if len(args.models) == 1 else "multi_file"


def _expanded(names: Sequence[str], deep: bool) -> list[str]:
    """Return the names, with folders replaced by the models in them."""
    found: list[str] = []
    for name in names:
        if not os.path.isdir(name):
            found.append(name)
            continue
        inside = _models_in(name, deep)
        if not inside:
            raise FileAccessError("there is no model in this folder", name)
        found += inside
    return found


def _models_in(folder: str, deep: bool) -> list[str]:
    from ...viewer.model_files import MODEL_EXTENSIONS

    found = []
    for path, folders, names in os.walk(folder):
        folders[:] = sorted(folders, key=str.lower) if deep else []
        chosen = (name for name in names if _is_model(name.lower(), MODEL_EXTENSIONS))
        found += [os.path.join(path, name) for name in sorted(chosen, key=str.lower)]
    return found


def _is_model(name: str, extensions: tuple[str, ...]) -> bool:
    """Return whether a file name is that of a model; of JSON files, only scenes are."""
    return name.endswith(extensions) and (not name.endswith(".json") or name.endswith(_SCENE))


def check_inputs(args: argparse.Namespace) -> None:
    """Raise if a file is too large, or the requested format does not exist."""
    if args.force_reader is not None:
        from ....io.loaders import formats

        names = [entry.name for entry in formats("mesh")]
        if args.force_reader not in names:
            known = ", ".join(names)
            raise UsageError(f"--force-reader: {args.force_reader!r} is not one of {known}")
    if args.max_size is None:
        return
    for name in args.models:
        size = _size_of(name)
        if size > args.max_size * _MEBIBYTE:
            raise FileFormatError(
                f"{size / _MEBIBYTE:.1f} MiB are more than --max-size {args.max_size:g}", name
            )


def _size_of(name: str) -> int:
    """Return the size of a file in bytes; 0 for standard input and for what does not exist."""
    if not is_url(name):
        return os.path.getsize(name) if name != STANDARD_INPUT and os.path.exists(name) else 0
    from ....io.addresses.urls import size_of_url

    size = size_of_url(name)
    if size is None:
        raise FileFormatError("its server tells no size, as --max-size demands", name)
    return size


def model_file(name: str) -> str | BinaryIO:
    """Return the path, or the bytes of standard input for ``-``."""
    if name != STANDARD_INPUT:
        return name
    if sys.stdin is None:
        raise UsageError("- reads a model from standard input, which is closed")
    if sys.stdin.isatty():
        raise UsageError("- would read a model from the terminal; redirect standard input")
    return sys.stdin.buffer


def model_files(names: Sequence[str]) -> list[str | BinaryIO]:
    """Return what several names stand for; standard input can be read once."""
    if names.count(STANDARD_INPUT) > 1:
        raise UsageError("- stands for standard input, which can be read only once")
    return [model_file(name) for name in names]

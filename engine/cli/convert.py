"""``engine3d convert``: a model file written in another format."""

from __future__ import annotations

import argparse
import io

from ..errors import printable
from ..loaders import load_mesh
from ..writers import formats, save_mesh
from .inputs import model_file
from .loading_bar import LoadingBar
from .outputs import (
    STANDARD_OUTPUT,
    check_folder,
    check_output,
    check_standard_output,
    is_same_file,
    write_standard_output,
)
from .usage import UsageError

BINARY_FORMATS = (".ply", ".stl")


def convert(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    output = _output(args)
    extension = _checked_extension(output, args.format)
    options = {"ascii": True} if args.ascii else {}
    if options and extension not in BINARY_FORMATS:
        raise UsageError(f"--ascii is for {' and '.join(BINARY_FORMATS)} files")
    if is_same_file(args.model, output):
        raise UsageError(f"{printable(output)} is the model itself")
    with LoadingBar() as progress:
        mesh = load_mesh(model_file(args.model), progress=progress)
    if output == STANDARD_OUTPUT:
        stream = io.BytesIO()
        save_mesh(mesh, stream, format=args.format, **options)
        write_standard_output(stream.getbuffer())
    else:
        save_mesh(mesh, output, format=args.format, **options)
    return 0


def _output(args: argparse.Namespace) -> str:
    """Where to write: OUT and ``-o`` are two ways to say it."""
    named = [name for name in (args.output, args.output_option) if name is not None]
    if len(named) != 1:
        raise UsageError("say once where to write: OUT, or -o OUT")
    return named[0]


def _checked_extension(output: str, format: str | None) -> str:
    """The extension of the format, in lower case; refuses, before any work, what has none."""
    known = {extension: item.name for item in formats() for extension in item.extensions}
    if output == STANDARD_OUTPUT:
        if format is None:
            raise UsageError(f"- needs --format: one of {', '.join(known.values())}")
        check_standard_output()
    elif format is None:
        return check_output(output, known, "a model").lower()
    else:
        check_folder(output)
    return next(extension for extension, name in known.items() if name == format)

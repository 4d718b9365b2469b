"""``engine3d convert``: a model file written in another format."""

from __future__ import annotations

import argparse

from ..errors import printable
from ..loaders import load_mesh
from ..writers import formats, save_mesh
from .inputs import model_file
from .loading_bar import LoadingBar
from .outputs import check_output, is_same_file
from .usage import UsageError

BINARY_FORMATS = (".ply", ".stl")


def convert(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    extensions = [extension for item in formats() for extension in item.extensions]
    extension = check_output(args.output, extensions, "a model")
    options = {"ascii": True} if args.ascii else {}
    if options and extension.lower() not in BINARY_FORMATS:
        raise UsageError(f"--ascii is for {' and '.join(BINARY_FORMATS)} files")
    if is_same_file(args.model, args.output):
        raise UsageError(f"{printable(args.output)} is the model itself")
    with LoadingBar() as progress:
        mesh = load_mesh(model_file(args.model), progress=progress)
    save_mesh(mesh, args.output, **options)
    return 0

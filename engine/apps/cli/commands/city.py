"""``engine3d city``: writes a procedural city of any size as a model."""

from __future__ import annotations

import argparse

from ....base.files.making_folders import make_folder_of
from ....extras.worlds import city as make_city
from ....io.writers import formats, save_mesh
from ..outputs import check_output


def city(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    extensions = [extension for item in formats() for extension in item.extensions]
    check_output(args.output, extensions, "a model")
    mesh = make_city(args.triangles, args.seed).mesh()
    make_folder_of(args.output)
    save_mesh(mesh, args.output)
    return 0

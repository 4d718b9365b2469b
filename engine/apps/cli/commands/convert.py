"""``engine3d convert``: writes a model file in another format."""

from __future__ import annotations

import argparse
import io
import os
import shlex

from ....base.files.making_folders import make_folder_of
from ....errors import printable
from ....io.formats.gltf.gltf_writer import save_scene_as
from ....io.loaders import load_mesh
from ....io.scenes.scene_loading import load_scene
from ....io.writers import formats, save_mesh
from ....io.writing.saving import write
from ....io.writing.writer_registry import find_writer, plugin_writer, writers
from ..loading_bar import LoadingBar
from ..options.input_options import model_file, of_robot
from ..outputs import (
    STANDARD_OUTPUT,
    check_folder,
    check_output,
    check_standard_output,
    is_same_file,
    write_standard_output,
)
from ..usage import UsageError

BINARY_FORMATS = (".ply", ".stl")
SCENE_FORMATS = (".glb", ".gltf")


def convert(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    output = _output(args)
    extension = _checked_extension(output, args.format)
    options = {"ascii": True} if args.ascii else {}
    if options and extension not in BINARY_FORMATS:
        raise UsageError(f"--ascii is for {' and '.join(BINARY_FORMATS)} files")
    if is_same_file(args.model, output):
        raise UsageError(f"{printable(output)} is the model itself")
    if extension in SCENE_FORMATS:
        convert = _scene
    else:
        convert = _with_plugin if find_writer(extension, extension).of_scenes else _mesh
    with LoadingBar() as progress:
        how = {"progress": progress, "root": args.root, **of_robot(args)}
        save = convert(model_file(args.model), how, args.format, extension, options)
    if output == STANDARD_OUTPUT:
        stream = io.BytesIO()
        save(stream)
        write_standard_output(stream.getbuffer())
    else:
        make_folder_of(output)
        save(output)
    return 0


def _mesh(model, how: dict, format: str | None, extension: str, options: dict):
    """Return the function that saves a model as a single mesh."""
    mesh = load_mesh(model, **how)
    return lambda output: save_mesh(mesh, output, format=format, **options)


def _scene(model, how: dict, format: str | None, extension: str, options: dict):
    """Return the scene of a whole model: nodes, cameras, lights, skins and animations."""
    scene = load_scene(model, **how)
    return lambda output: save_scene_as(scene, output, extension)


def _with_plugin(model, how: dict, format: str | None, extension: str, options: dict):
    """Return the function that saves a whole model by the writer of another package."""
    scene = load_scene(model, **how)
    return lambda output: write(scene, output, find_writer(extension, extension))


def _output(args: argparse.Namespace) -> str:
    """Return the output, named by OUT or ``-o``."""
    named = [name for name in (args.output, args.output_option) if name is not None]
    if not named:
        example = shlex.join([args.model, os.path.splitext(args.model)[0] + ".ply"])
        raise UsageError(f"say where to write, such as: engine3d convert {printable(example)}")
    if len(named) != 1:
        raise UsageError("say once where to write: OUT, or -o OUT")
    return named[0]


def _checked_extension(output: str, format: str | None) -> str:
    """Return the format's extension in lower case; refuse names without one before any work."""
    shipped = [extension for writer in writers() for extension in writer.extensions]
    if format is None and os.path.splitext(output)[1].lower() in shipped:
        return check_output(output, shipped, "a model").lower()
    known = {extension: item.name for item in formats() for extension in item.extensions}
    if output == STANDARD_OUTPUT:
        if format is None:
            raise UsageError(f"- needs --format: one of {', '.join(known.values())}")
        check_standard_output()
    elif format is None:
        if (writer := plugin_writer(output)) is None:
            return check_output(output, known, "a model").lower()
        check_folder(output)
        return writer.extensions[0]
    else:
        check_folder(output)
    return next(extension for extension, name in known.items() if name == format)

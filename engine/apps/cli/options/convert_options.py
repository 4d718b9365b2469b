"""The options of ``convert``."""

from __future__ import annotations

from ....base.plugins.open_choices import OpenChoices
from .input_options import add_robot, add_root

MODEL_FORMATS = ("glb", "gltf", "obj", "ply", "stl")


def add(command) -> None:
    """Add the options for input and output."""
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
        choices=OpenChoices("writers", MODEL_FORMATS),
        metavar="NAME",
        help=f"what to write whatever the extension: {', '.join(MODEL_FORMATS)}, or what a plug-in "
        "writes; OBJ with materials is several files, and does not go to standard output",
    )
    add_root(command)
    add_robot(command)
    command.add_argument("--ascii", action="store_true", help="write PLY and STL as text")

"""The options of ``batch``."""

from __future__ import annotations

from .. import values
from .picture_options import BACKENDS


def add(command) -> None:
    """Add the options for the manifest, the output and the workers."""
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
        choices=BACKENDS,
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

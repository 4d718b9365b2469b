"""Batch rendering in many processes; finished pictures are not drawn again.

A `Task` describes a picture: a model or script, a camera, a seed, the outputs. `read_manifest`
reads tasks from a JSON file, and `run` draws them in its own processes, with Dask, or with any
executor like those of `concurrent.futures`. Scripts load meshes with `load_mesh` and textures with
`load_texture`, which cache them between pictures.
"""

from .loading import load_mesh, load_texture
from .manifest import read_manifest
from .running import run
from .summary import Failure, Summary
from .task import Task

__all__ = [
    "Failure",
    "Summary",
    "Task",
    "load_mesh",
    "load_texture",
    "read_manifest",
    "run",
]

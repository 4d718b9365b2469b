"""Many pictures, by many processes: those that are there are not drawn again.

A `Task` is a picture: a model or a script, a camera, a seed, what is written. `read_manifest` reads
tasks from a file of JSON, and `run` has them drawn by processes of its own, by Dask, or by any
executor like those of `concurrent.futures`. Scripts load meshes by `load_mesh` and textures by
`load_texture`, which keep them from picture to picture.
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

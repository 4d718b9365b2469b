"""Scenes of what other libraries hold: trimesh, PyVista and meshio.

In: any object. Out: a `Scene` if a library of this list made it. None of them is imported here: who
has such an object has imported its library.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...model.scene.scene import Scene
from .meshio_scenes import scene_from_meshio
from .pyvista_scenes import scene_from_pyvista
from .trimesh_scenes import scene_from_trimesh

_SCENES: dict[str, Callable[[Any], Scene | None]] = {
    "meshio": scene_from_meshio,
    "pyvista": scene_from_pyvista,
    "trimesh": scene_from_trimesh,
}


def scene_of_library(thing: Any) -> Scene | None:
    """Return a scene of an object of another library; None if it is of none, or shows nothing."""
    library = library_of(thing)
    return None if library is None else _SCENES[library](thing)


def library_of(thing: Any) -> str | None:
    """Return the library of this list whose class an object has, or derives from; None for none."""
    packages = (kind.__module__.partition(".")[0] for kind in type(thing).__mro__)
    return next((package for package in packages if package in _SCENES), None)

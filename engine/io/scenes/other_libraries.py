"""Scenes of what other libraries hold: trimesh, PyVista, meshio, Open3D and pandas.

In: any object, or a list of them. Out: a `Scene` if a library of this list made it. None of them is
imported here: who has such an object has imported its library.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ...model.scene.scene import Scene
from .meshio_scenes import scene_from_meshio
from .open3d_scenes import scene_from_open3d
from .pandas_scenes import scene_from_pandas
from .pyvista_scenes import scene_from_pyvista
from .trimesh_scenes import scene_from_trimesh

_SCENES: dict[str, Callable[[Any], Scene | None]] = {
    "meshio": scene_from_meshio,
    "open3d": scene_from_open3d,
    "pandas": scene_from_pandas,
    "pyvista": scene_from_pyvista,
    "trimesh": scene_from_trimesh,
}


def scene_of_library(thing: Any) -> Scene | None:
    """Return a scene of an object of another library, or of a list of such objects.

    None for what is of none of these libraries, or shows nothing.
    """
    return _scene_of_several(thing) if isinstance(thing, list | tuple) else _scene_of_one(thing)


def _scene_of_one(thing: Any) -> Scene | None:
    library = library_of(thing)
    return None if library is None else _SCENES[library](thing)


def _scene_of_several(things: Sequence[Any]) -> Scene | None:
    """Return one scene of several things; None unless each can be shown."""
    whole = Scene()
    for thing in things:
        scene = _scene_of_one(thing)
        if scene is None:
            return None
        for node in scene.nodes:
            whole.add(node.object, name=node.name, pose=node.pose)
    return whole if things else None


def library_of(thing: Any) -> str | None:
    """Return the library of this list whose class an object has, or derives from; None for none."""
    packages = (kind.__module__.partition(".")[0] for kind in type(thing).__mro__)
    return next((package for package in packages if package in _SCENES), None)

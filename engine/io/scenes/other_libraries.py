"""Scenes of what other libraries hold: trimesh, PyVista, vedo, meshio, Open3D, CAD, pandas.

In: any object, or a list of them. Out: a `Scene` if a library of this list made it. None of them is
imported here: who has such an object has imported its library.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Any

from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh
from ...model.scene.scene import Scene

#: Libraries of CAD, whose meshes have the edges of their models, and whose +Z is up.
CAD_LIBRARIES = ("OCP", "build123d", "cadquery")
#: By library: the X of the function ``scene_from_X`` in the module ``X_scenes``.
_KINDS = dict.fromkeys(CAD_LIBRARIES, "cad")
_KINDS |= {name: name for name in ("meshio", "open3d", "pandas", "pyvista", "trimesh", "vedo")}


def scene_of_library(thing: Any) -> Scene | None:
    """Return a scene of an object of another library, or of a list of such objects.

    None for what is of none of these libraries, or shows nothing.
    """
    library = library_of(thing)
    if library is not None:
        return _scene_from(library, thing)
    return _scene_of_several(thing) if isinstance(thing, list | tuple) else None


def _scene_from(library: str, thing: Any) -> Scene | None:
    kind = _KINDS[library]
    module = import_module(f".{kind}_scenes", __package__)
    scene: Scene | None = getattr(module, f"scene_from_{kind}")(thing)
    return scene


def _scene_of_several(things: Sequence[Any]) -> Scene | None:
    """Return one scene of several things; None unless each can be shown."""
    whole = Scene()
    for thing in things:
        library = library_of(thing)
        scene = None if library is None else _scene_from(library, thing)
        if scene is None:
            return None
        for node in scene.nodes:
            whole.add(node.object, name=node.name, pose=node.world_pose)
    return whole if things else None


def is_of_library(thing: Any) -> bool:
    """Return whether a thing is an object of a library of this list, or a list that holds one."""
    several = thing if isinstance(thing, list | tuple) else ()
    return library_of(thing) is not None or any(library_of(one) is not None for one in several)


def has_points(scene: Scene) -> bool:
    """Return whether a mesh of a scene has points, without which nothing shows."""
    objects = (node.object for node in scene.nodes)
    meshes = (one.mesh if isinstance(one, InstancedMesh) else one for one in objects)
    return any(len(one.positions) for one in meshes if isinstance(one, Mesh))


def library_of(thing: Any) -> str | None:
    """Return the library of this list whose class an object has, or derives from; None for none.

    A list or tuple of objects of libraries for CAD is of the first one's.
    """
    if isinstance(thing, (list, tuple)):
        found = [library_of(one) for one in thing if not isinstance(one, (list, tuple))]
        are_cad = len(found) == len(thing) > 0 and all(one in CAD_LIBRARIES for one in found)
        return found[0] if are_cad else None
    packages = (kind.__module__.partition(".")[0] for kind in type(thing).__mro__)
    return next((package for package in packages if package in _KINDS), None)

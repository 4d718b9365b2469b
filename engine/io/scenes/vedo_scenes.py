"""Converts objects of vedo for drawing: what holds a data set of VTK, and groups of such.

In: a mesh, points, an assembly or a plotter of vedo. Out: a `Scene` with a node for each object, in
its actor's colour. The data sets are read as those of PyVista, which has to be installed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...base.optional_packages import require
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.scene.scene import Scene
from .pyvista_scenes import scene_from_pyvista


def scene_from_vedo(thing: Any) -> Scene | None:
    """Return a scene of an object of vedo; None for what shows nothing in space.

    Raises
    ------
    ModuleNotFoundError
        PyVista is not installed.
    """
    require("pyvista", "a drawing of vedo", "pyvista")
    from pyvista import wrap

    whole = Scene()
    for one in _objects(thing):
        scene = scene_from_pyvista(wrap(one.dataset))
        for node in () if scene is None else scene.nodes:
            assert isinstance(node.object, Mesh)
            node.object.materials = [_material(one.actor)]
            whole.add(node.object, name=one.name or type(one).__name__.lower())
    return whole if whole.nodes else None


def _objects(thing: Any) -> Iterator[Any]:
    """Yield the objects with data sets of an object, of a group or of a plotter."""
    if hasattr(thing, "dataset"):
        if thing.actor.IsA("vtkActor"):  # not of volumes
            yield thing
        return
    for one in getattr(thing, "objects", ()):
        yield from _objects(one)


def _material(actor: Any) -> Material:
    look = actor.GetProperty()
    codes = [round(255.0 * share) for share in (*look.GetDiffuseColor(), look.GetOpacity())]
    return Material(color=tuple(codes), alpha_mode="blend" if codes[3] < 255 else "opaque")

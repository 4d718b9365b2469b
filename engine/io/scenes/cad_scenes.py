"""Scenes of what CadQuery and build123d hold: workplanes, assemblies, shapes, sketches, lists.

In: an object of one of these, or a shape of OCP. Out: a `Scene` with a node for each shape, with
its name, its colour, and its place in assemblies. A shape that occurs several times is one mesh.
Lengths are millimetres as a rule, and +Z is up.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.scene.scene import Scene
from ..cad.colors_of_shapes import Components, color_material, components_of
from ..cad.shape_meshes import diagonal_of, pose_matrix, shape_mesh

#: Of assemblies, parts are drawn as finely as this fraction of the diagonal of the largest part.
_TOLERANCE = 1e-3
#: A part is drawn at least so finely in its own diagonals.
_COARSEST = 1e-2


class _Placed(NamedTuple):
    """A shape in a scene: without its location, which is in the pose."""

    shape: Any
    name: str
    pose: NDArray[np.float64]
    color: Components | None


def scene_from_cad(thing: Any) -> Scene | None:
    """Return a scene of an object of CadQuery or build123d; None for those without a shape."""
    placed = list(_placed(thing, np.eye(4)))
    if not placed:
        return None
    scene = Scene()
    meshes: dict[Any, Mesh] = {}
    finest = _TOLERANCE * max(diagonal_of(one.shape) for one in placed)
    for one in placed:
        key = one.shape.TShape(), one.color, int(one.shape.Orientation())
        if key not in meshes:
            linear = min(finest, _COARSEST * diagonal_of(one.shape))
            meshes[key] = shape_mesh(one.shape, one.name, _painted(one.color), linear)
        scene.add(meshes[key], name=one.name, pose=one.pose)
    return scene


def _painted(color: Components | None) -> Callable[[Any], Material]:
    """Return a function that gives all faces one material."""
    material = color_material(color)
    return lambda face: material


def _placed(thing: Any, pose: NDArray[np.float64], name: str = "", color: Any = None) -> Any:
    """Yield the shapes of an object at a pose, with the name and colour of what holds it."""
    if isinstance(thing, (list, tuple)):
        for one in thing:
            yield from _placed(one, pose, name, color)
    elif hasattr(thing, "TShape"):  # OCP's own
        yield from _of_shape(thing, pose, name, color)
    elif hasattr(thing, "obj") and hasattr(thing, "loc"):
        yield from _of_assembly(thing, pose, color)
    elif hasattr(thing, "vals"):  # CadQuery's workplane, or sketch
        yield from _placed(_values(thing), pose, name, color)
    elif _is_wrapper(thing):
        yield from _of_wrapper(thing, pose, name, color)
    else:
        for holder in ("part", "sketch", "line"):  # builders of build123d
            if getattr(thing, holder, None) is not None:
                yield from _placed(getattr(thing, holder), pose, name, color)
                return


def _values(thing: Any) -> list[Any]:
    """Return the shapes on a workplane, or the faces of a sketch, or its edges without any."""
    if not hasattr(thing, "objects"):
        return list(thing) or list(thing.copy().edges().vals())
    return [one for one in thing.vals() if hasattr(one, "wrapped") or hasattr(one, "vals")]


def _is_wrapper(thing: Any) -> bool:
    """Return whether something has a shape of OCP, or None in its place."""
    try:
        return hasattr(thing, "wrapped")
    except AssertionError:  # of build123d, whose empty shapes have none
        return False


def _of_wrapper(thing: Any, pose: NDArray[np.float64], name: str, color: Any) -> Iterator[_Placed]:
    """Yield a shape of build123d or CadQuery, or the children of one."""
    if thing.wrapped is None or not hasattr(thing.wrapped, "TShape"):
        return
    name = str(getattr(thing, "label", "") or name)
    color = getattr(thing, "color", None) or color
    children = tuple(getattr(thing, "children", ()) or ())
    children = tuple(filter(_is_wrapper, children))
    if not children:
        yield from _of_shape(thing.wrapped, pose, name or type(thing).__name__.lower(), color)
        return
    pose = linalg.multiply(pose, pose_matrix(thing.wrapped.Location().Transformation()))
    for child in children:
        yield from _placed(child, pose, name, color)


def _of_assembly(thing: Any, pose: NDArray[np.float64], color: Any) -> Iterator[_Placed]:
    """Yield the shapes of an assembly of CadQuery, whose locations are relative."""
    pose = linalg.multiply(pose, pose_matrix(thing.loc.wrapped.Transformation()))
    color = thing.color or color
    if thing.obj is not None:
        yield from _placed(thing.obj, pose, str(thing.name), color)
    for child in thing.children:
        yield from _of_assembly(child, pose, color)


def _of_shape(shape: Any, pose: NDArray[np.float64], name: str, color: Any) -> Iterator[_Placed]:
    from OCP.TopLoc import TopLoc_Location

    if shape.IsNull():
        return
    pose = linalg.multiply(pose, pose_matrix(shape.Location().Transformation()))
    yield _Placed(shape.Located(TopLoc_Location()), name or "shape", pose, _components(color))


def _components(color: Any) -> Components | None:
    """Return the components of a colour as Open CASCADE holds them: linear light, and alpha."""
    if color is None:
        return None
    return components_of(color.wrapped)

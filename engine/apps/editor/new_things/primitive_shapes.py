"""Primitives as shapes of nodes: made by their arguments, changed by them, shared where equal.

In: a scene, the name of a primitive, its arguments. Out: meshes. A mesh knows the arguments that it
was made by until one of its arrays is replaced.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ....base.held_values import same
from ....model import primitives
from ....model.geometry.mesh import Mesh
from ....model.geometry.origins import Came, PrimitiveOrigin, has_own_materials, origin_of
from ....model.scene.scene import Scene

#: The primitives that the editor offers, by their titles.
PRIMITIVES: dict[str, Callable[..., Mesh]] = {
    "Box": primitives.box,
    "Sphere": primitives.uv_sphere,
    "Icosphere": primitives.icosphere,
    "Cylinder": primitives.cylinder,
    "Torus": primitives.torus,
    "Plane": primitives.plane,
}
_TITLES = {make.__name__: title for title, make in PRIMITIVES.items()}
#: Arguments that are numbers of parts; the others are lengths.
PARTS = ("segments", "subdivisions")


def title_of(mesh: Mesh) -> str | None:
    """Return the title of the primitive that a mesh is; None if it is none of `PRIMITIVES`."""
    came = _came(mesh)
    return None if came is None else _TITLES.get(came.origin.name)


def arguments_of(mesh: Mesh) -> dict[str, Any]:
    """Return the arguments that a primitive was made by, with those left out."""
    came = _came(mesh)
    if came is None:
        return {}
    return _arguments(PRIMITIVES[_TITLES[came.origin.name]], came.origin.arguments)


def new_primitive(scene: Scene, title: str, size: float = 1.0) -> Mesh:
    """Return a primitive, so many times as large as it is by default: the scene's own if equal."""
    make = PRIMITIVES[title]
    lengths = {} if size == 1.0 else _scaled_lengths(make, size)
    return _known(scene, make(**lengths))


def changed_primitives(
    scene: Scene, meshes: Sequence[Mesh], name: str, changed: Mapping[int, float]
) -> list[Mesh]:
    """Return primitives with another argument and the same materials, equal ones once.

    Parameters
    ----------
    scene : Scene
    meshes : sequence of Mesh
        Of `PRIMITIVES`.
    name : str
        Of the argument.
    changed : dict of int to float
        Its new numbers, by their places in it.

    Raises
    ------
    InvalidArgumentError
        An argument is out of its range.
    """
    made: dict[Mesh, Mesh] = {}
    for mesh in dict.fromkeys(meshes):
        made[mesh] = _known(scene, _changed(mesh, name, changed), made.values())
    return [made[mesh] for mesh in meshes]


def _changed(mesh: Mesh, name: str, changed: Mapping[int, float]) -> Mesh:
    arguments = arguments_of(mesh)
    old = arguments[name]
    parts = old if isinstance(old, list) else [old]
    new = [changed.get(place, part) for place, part in enumerate(parts)]
    arguments[name] = new if isinstance(old, list) else new[0]
    title = title_of(mesh)
    assert title is not None
    fresh = PRIMITIVES[title](**arguments)
    fresh.materials = list(mesh.materials)
    if mesh.name != fresh.name:
        fresh.name = mesh.name
    return fresh


def _came(mesh: Mesh) -> Came | None:
    came = origin_of(mesh)
    if came is None or not isinstance(came.origin, PrimitiveOrigin):
        return None
    return came if came.origin.name in _TITLES else None


def _arguments(make: Callable[..., Mesh], given: Mapping[str, Any]) -> dict[str, Any]:
    found = {}
    for name, parameter in inspect.signature(make).parameters.items():
        value, usual = given.get(name, parameter.default), parameter.default
        if isinstance(usual, tuple) and not isinstance(value, (list, tuple)):
            value = [value] * len(usual)  # a number stands for all
        found[name] = list(value) if isinstance(value, tuple) else value
    return found


def _scaled_lengths(make: Callable[..., Mesh], size: float) -> dict[str, Any]:
    """Return the lengths of a primitive's defaults times a factor."""
    lengths = {k: value for k, value in _arguments(make, {}).items() if k not in PARTS}
    return {
        name: [size * part for part in value] if isinstance(value, list) else size * value
        for name, value in lengths.items()
    }


def _known(scene: Scene, mesh: Mesh, also: Iterable[Mesh] = ()) -> Mesh:
    """Return the mesh of the scene, or of others, that equals a primitive; else the primitive."""
    for other in (*scene.data.objects.objects, *also):
        if isinstance(other, Mesh) and _are_equal(other, mesh):
            return other
    return mesh


def _are_equal(one: Mesh, other: Mesh) -> bool:
    first, second = _came(one), _came(other)
    if first is None or second is None or one.name != other.name:
        return False
    if first.origin.name != second.origin.name:
        return False
    if not same(_plain(arguments_of(one)), _plain(arguments_of(other))):
        return False
    shared = list(map(id, one.materials)) == list(map(id, other.materials))
    return shared or (has_own_materials(one, first) and has_own_materials(other, second))


def _plain(arguments: dict[str, Any]) -> dict[str, list[float]]:
    """Return arguments as lists of floats: a number stands for several equal ones."""
    return {
        name: [float(part) for part in (value if isinstance(value, list) else [value])]
        for name, value in arguments.items()
    }

"""Origins of meshes: a scene can be saved by naming them instead of writing their arrays.

In: a mesh from a loader or a primitive. Out: its origin, as long as none of its arrays is replaced;
and whether its materials and groups are unchanged.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from ...base.held_values import kept, same
from ..materials.material import TEXTURE_SLOTS, Material
from ..materials.textures import PlacedTexture, Texture
from .creases import CREASE_ANGLE

if TYPE_CHECKING:
    from .mesh import Mesh


class FileOrigin(NamedTuple):
    """The file that a mesh comes from.

    Attributes
    ----------
    path : str
        Absolute.
    format : str or None
        The format forced by the caller, if any.
    part : (str, int) or None
        The object's name, and how many objects of that name precede it; None: all, joined.
    is_missing : bool
        Whether the mesh is a placeholder for a missing file.
    crease_angle : float
        Radians, for normals that the file lacks.
    """

    path: str
    format: str | None
    part: tuple[str, int] | None
    is_missing: bool = False
    crease_angle: float = CREASE_ANGLE


class PrimitiveOrigin(NamedTuple):
    """The function of `engine3d.primitives` that made a mesh.

    Attributes
    ----------
    name : str
        The function's name.
    arguments : dict
        Numbers and lists of numbers.
    """

    name: str
    arguments: dict[str, Any]


class Came(NamedTuple):
    """An origin, with the name, materials and groups the mesh had when it was made.

    Attributes
    ----------
    origin : FileOrigin or PrimitiveOrigin
    name : str
    materials : list
        The content of each material.
    groups : dict
    """

    origin: FileOrigin | PrimitiveOrigin
    name: str
    materials: list[dict[str, Any]]
    groups: dict[str, Any]


def remember_origin(mesh: Mesh, origin: FileOrigin | PrimitiveOrigin) -> None:
    """Record the origin of a mesh, unless one is recorded already."""
    if mesh._origin is None:
        materials = [_held(material) for material in mesh.materials]
        mesh._origin = Came(origin, mesh.name, materials, dict(mesh.groups))


def noted_origin(mesh: Mesh) -> Came | None:
    """Return the origin of a mesh's arrays, even if its groups have changed."""
    return mesh._origin


def origin_of(mesh: Mesh) -> Came | None:
    """Return the origin of a mesh; None once it has changed."""
    came = mesh._origin
    if came is None or came.groups.keys() != mesh.groups.keys():
        return None
    same = all(array is mesh.groups[name] for name, array in came.groups.items())
    return came if same else None


def has_own_materials(mesh: Mesh, came: Came) -> bool:
    """Return whether the materials are unchanged since the mesh was made."""
    held = [_held(material) for material in mesh.materials]
    return same(held, came.materials)


def _held(material: Material) -> dict[str, Any]:
    """Return the content of a material, with the content of its textures."""
    held = {key: value for key, value in vars(material).items() if key != "version"}
    held["extras"] = kept(held["extras"]) if held["extras"] else {}  # can be changed in place
    for slot in TEXTURE_SLOTS:
        if (texture := held[slot]) is not None:
            held[slot] = _held_by(texture)
    return held


def _held_by(texture: Texture | PlacedTexture) -> dict[str, Any]:
    held = {key: value for key, value in vars(texture).items() if key != "version"}
    if isinstance(texture, PlacedTexture):
        held["texture"] = _held_by(texture.texture)
    return held

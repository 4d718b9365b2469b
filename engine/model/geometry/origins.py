"""Where a mesh comes from, so that a scene can be saved by naming it instead of its arrays.

In: a mesh as a loader or a primitive made it. Out: what names it, for as long as none of its arrays
is replaced; and whether its materials and groups are still those that it came with.
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
    """A mesh of a file.

    Attributes
    ----------
    path : str
        Absolute.
    format : str or None
        What the file was read as whatever it looks like.
    part : (str, int) or None
        The object's name, and how many objects of that name stand before it; None: all, joined.
    is_missing : bool
        Whether the mesh only keeps the place of one that is not there.
    crease_angle : float
        Radians, of normals that the file lacks.
    """

    path: str
    format: str | None
    part: tuple[str, int] | None
    is_missing: bool = False
    crease_angle: float = CREASE_ANGLE


class PrimitiveOrigin(NamedTuple):
    """A mesh of `engine3d.primitives`.

    Attributes
    ----------
    name : str
        Of the function.
    arguments : dict
        Numbers and lists of numbers.
    """

    name: str
    arguments: dict[str, Any]


class Came(NamedTuple):
    """An origin, and the rest of what came from there.

    Attributes
    ----------
    origin : FileOrigin or PrimitiveOrigin
    name : str
    materials : list
        What each material held.
    groups : dict
    """

    origin: FileOrigin | PrimitiveOrigin
    name: str
    materials: list[dict[str, Any]]
    groups: dict[str, Any]


def remember_origin(mesh: Mesh, origin: FileOrigin | PrimitiveOrigin) -> None:
    """Note where a mesh comes from, unless that is known."""
    if mesh._origin is None:
        materials = [_held(material) for material in mesh.materials]
        mesh._origin = Came(origin, mesh.name, materials, dict(mesh.groups))


def noted_origin(mesh: Mesh) -> Came | None:
    """Return where the arrays of a mesh come from, whatever its groups are by now."""
    return mesh._origin


def origin_of(mesh: Mesh) -> Came | None:
    """Return where a mesh comes from; None if it is another by now."""
    came = mesh._origin
    if came is None or came.groups.keys() != mesh.groups.keys():
        return None
    same = all(array is mesh.groups[name] for name, array in came.groups.items())
    return came if same else None


def has_own_materials(mesh: Mesh, came: Came) -> bool:
    """Whether the materials are still what they were when the mesh came."""
    held = [_held(material) for material in mesh.materials]
    return same(held, came.materials)


def _held(material: Material) -> dict[str, Any]:
    """Return what a material holds, with the contents of its textures."""
    held = {key: value for key, value in vars(material).items() if key != "version"}
    held["extras"] = kept(held["extras"]) if held["extras"] else {}  # may be changed in place
    for slot in TEXTURE_SLOTS:
        if (texture := held[slot]) is not None:
            held[slot] = _held_by(texture)
    return held


def _held_by(texture: Texture | PlacedTexture) -> dict[str, Any]:
    held = {key: value for key, value in vars(texture).items() if key != "version"}
    if isinstance(texture, PlacedTexture):
        held["texture"] = _held_by(texture.texture)
    return held
